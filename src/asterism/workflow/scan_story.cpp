// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_story.hpp"

#include <chrono>

#include "asterism/core/result.hpp"
#include "asterism/core/stopwatch.hpp"
#include "asterism/io/plan_file.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/scanning/planner.hpp"
#include "asterism/workflow/scan_run.hpp"
#include "asterism/workflow/simulate_recording.hpp"
#include "asterism/workflow/track_recording.hpp"

namespace asterism {
namespace {

PlanOptions plan_options(const ScanStoryJob& job, bool turned) {
  PlanOptions options;
  options.samples = job.quick ? 4000 : 8000;
  options.candidates = job.quick ? 2000 : 4000;
  options.candidates_more = job.quick ? 1000 : 2000;
  options.rounds = job.quick ? 2 : 3;
  options.platform_steps = turned ? 3 : 1;
  options.cover.exact_s = job.quick ? 2 : 8;
  return options;
}

/// The plan carried out: OUT holds what tracker and scanner recorded, OUT/track the poses.
void carry_out(const Cell& cell, const ScanPlan& plan, int first_scan, const std::filesystem::path& out,
               std::uint64_t seed, const Progress& progress) {
  ScanRunOptions run;
  run.first_scan = first_scan;
  run.view_s = cell.scanner->sweep_s;  // one sweep a view,
  run.pace = 6;                        // and no waiting on the way
  SimulateJob simulate;
  simulate.out = out;
  simulate.options.level = SimulationLevel::Centres;
  simulate.options.sigma_px = cell.noise.sigma_px;
  simulate.options.seed = seed;
  (void)simulate_recording(scan_run(cell, plan, run), simulate, progress);
  TrackJob track;
  track.out = out / "track";
  track.covariance = true;
  (void)track_recording(open_recording(out), track, progress);
}

FusedScans fuse(const std::vector<std::filesystem::path>& folders, const ScanStoryJob& job,
                const Progress& progress) {
  FuseScansJob fuse;
  fuse.scans = folders;
  fuse.out = job.out / "cloud.ply";
  fuse.seed = job.seed;
  fuse.options.samples = job.quick ? 4000 : 8000;
  return fuse_scans(fuse, progress);
}

}  // namespace

std::vector<ScanRound> tell_scan_story(const Cell& cell, const ScanStoryJob& job, const Progress& progress) {
  std::vector<ScanRound> rounds;
  std::vector<std::filesystem::path> folders;
  EarlierCloud earlier;
  int scans = 0;
  for (const bool turned : {false, true}) {
    ScanRound round;
    round.name = turned ? "platform turned" : "platform at rest";
    auto start = std::chrono::steady_clock::now();
    round.plan = plan_scans(cell, plan_options(job, turned), job.seed, earlier, progress);
    round.planning_s = seconds_since(start);
    if (round.plan.views.empty()) break;  // nothing is missing that could be measured
    write_plan(job.out / (turned ? "rescan.json" : "plan.json"), round.plan);

    start = std::chrono::steady_clock::now();
    folders.push_back(job.out / (turned ? "rescan" : "scan"));
    // One seed for both: the scanner's own error of place is drawn once a seed, and it is one scanner.
    carry_out(cell, round.plan, scans + 1, folders.back(), job.seed, progress);
    scans += static_cast<int>(round.plan.views.size());
    round.scanning_s = seconds_since(start);

    start = std::chrono::steady_clock::now();
    round.fused = fuse(folders, job, progress);
    round.fusing_s = seconds_since(start);
    earlier.cloud = round.fused.cloud;
    rounds.push_back(std::move(round));
  }
  return rounds;
}

std::optional<ScanPlan> plan_on_rings(const Cell& cell, const ScanStoryJob& job, const Progress& progress) {
  PlanOptions options = plan_options(job, true);
  options.method = PlanMethod::Rings;
  try {
    return plan_scans(cell, options, job.seed, {}, progress);
  } catch (const MeasurementError&) {
    return std::nullopt;
  }
}

}  // namespace asterism
