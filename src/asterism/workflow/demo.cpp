// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/demo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "asterism/core/stopwatch.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/report/tracking_report.hpp"
#include "asterism/workflow/design_layout.hpp"
#include "asterism/workflow/scan_story_report.hpp"

namespace asterism {
namespace {

Vec3 target_centroid(const Body& body) {
  Vec3 sum = Vec3::Zero();
  for (const Target& target : body.targets) sum += target.position;
  return sum / static_cast<double>(body.targets.size());
}

std::vector<PoseRecord> measured_poses(const Recording& recording, const TrackedRun& run) {
  std::vector<PoseRecord> records;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    for (const BodyPose& pose : run.frames[i].poses) {
      records.push_back(record_of(recording.frames[i].frame, recording.frames[i].time_s, pose, run.bodies));
    }
  }
  return records;
}

/// Each body's errors at the centroid of its targets.
void evaluate(const Recording& recording, const std::vector<PoseRecord>& truth, DemoResult& result) {
  const std::vector<PoseRecord> measured = measured_poses(recording, result.tracked);
  for (const Body& body : result.tracked.bodies) {
    PoseErrorOptions options;
    options.body = body.name;
    options.at_mm = target_centroid(body);
    result.at_mm.push_back(options.at_mm);
    for (PoseErrors& errors : pose_errors(measured, truth, options))
      result.errors.push_back(std::move(errors));
  }
}

void add_rows(const PoseErrors& errors, std::vector<SummaryRow>& rows) {
  rows.push_back({"Frames with a pose, " + errors.body,
                  fmt::format("{} of {}", errors.found(), errors.truth_frames), "",
                  errors.lost.empty() ? "" : "the others are LOST or AMBIGUOUS: not shown as if measured",
                  errors.lost.empty() ? Verdict::Good : Verdict::Attention});
  rows.push_back({"Wrong poses, " + errors.body, fmt::format("{}", errors.wrong.size()), "",
                  "farther than 2 mm or 0.5° from the truth",
                  errors.wrong.empty() ? Verdict::Good : Verdict::Bad});
  rows.push_back({"Translation error, " + errors.body, fmt::format("{:.4f}", errors.translation_mm.rms),
                  "mm RMS",
                  fmt::format("at the targets' centroid; 95 % below {:.4f} mm", errors.translation_mm.p95),
                  Verdict::Plain});
  rows.push_back({"Rotation error, " + errors.body, fmt::format("{:.5f}", errors.rotation_deg.rms), "° RMS",
                  fmt::format("95 % below {:.5f}°", errors.rotation_deg.p95), Verdict::Plain});
  if (!errors.honesty) return;
  const double ratio = errors.honesty->mean_nees / 6;
  rows.push_back(
      {"NEES/6, " + errors.body, fmt::format("{:.2f}", ratio), "",
       fmt::format("1 = the stated covariance is honest; {:.0f} % of errors inside their 95 % ellipsoid",
                   100 * errors.honesty->in_95_percent),
       ratio < 1.5 ? Verdict::Good : Verdict::Attention});
}

std::vector<std::vector<std::optional<RigidMotion>>> truth_by_frame(const Recording& recording,
                                                                    const std::vector<PoseRecord>& truth,
                                                                    const std::vector<Body>& bodies) {
  std::vector<std::vector<std::optional<RigidMotion>>> rows;
  std::map<std::pair<int, std::string>, RigidMotion> known;
  for (const PoseRecord& record : truth) {
    if (record.tracker_from_body) known[{record.frame, record.body}] = *record.tracker_from_body;
  }
  for (const FrameEntry& entry : recording.frames) {
    auto& row = rows.emplace_back();
    for (const Body& body : bodies) {
      const auto found = known.find({entry.frame, body.name});
      row.push_back(found == known.end() ? std::optional<RigidMotion>{} : found->second);
    }
  }
  return rows;
}

void report(const DemoJob& job, const Recording& recording, const std::vector<PoseRecord>& truth,
            TrackerOptions options, DemoResult& result) {
  TrackingReport page;
  page.title = "Demo: " + result.cell;
  page.subtitle =
      fmt::format("{} stereo frames simulated to images (seed {}), tracked, and held against their truth",
                  result.simulated.frames, job.seed);
  for (const PoseErrors& errors : result.errors) add_rows(errors, page.summary);
  page.summary.push_back(
      {"Lost images", fmt::format("{}", result.simulated.lost), "", "dropped on purpose", Verdict::Plain});
  page.summary.push_back({"Tracking",
                          fmt::format("{:.1f}", 1e3 * result.tracked.seconds.tracking /
                                                    static_cast<double>(result.simulated.frames)),
                          "ms a frame", "two images in memory to poses", Verdict::Plain});
  page.remarks = result.tracked.warnings;
  page.rig = *recording.rig;
  page.bodies = result.tracked.bodies;
  for (const Vec3& at : result.at_mm) page.error_points.push_back({"target centroid", at});
  page.frames = result.tracked.frames;
  page.truth = truth_by_frame(recording, truth, page.bodies);
  page.options_json = json_of_options(describing(options)).dump(2);
  result.tracking_page = job.out / "track/report.html";
  write_report(result.tracking_page, page);
}

/// Where the targets should go: a short search, for the front and what each layout gives up.
void design(const Cell& cell, const DemoJob& job, const Progress& progress, DemoResult& result) {
  DesignJob search;
  search.out = job.out / "layout";
  search.checkpoint_seconds = 1e9;
  search.options.optimizer.population = job.quick ? 24 : 48;
  search.options.optimizer.generations = job.quick ? 5 : 40;
  search.options.optimizer.seed = job.seed;
  const LayoutProblem problem(cell, search.options);
  const auto generations = static_cast<std::size_t>(search.options.optimizer.generations);
  const DesignedLayouts designed =
      search_layouts(cell, problem, search, [&, done = std::size_t{0}](const Optimizer&) mutable {
        progress("searching layouts", ++done, generations);
        return true;
      });
  result.layouts = designed.result.front.size();
  result.layout_page = search.out / "report.html";
}

/// Along the motion: what will be seen, how good it is, what becomes of it under faults.
void verify(const Cell& cell, const DemoJob& job, const Progress& progress, DemoResult& result,
            HeadlineFigures& headline) {
  VerifyJob verification;
  verification.out = job.out / "verify";
  verification.seed = job.seed;
  if (job.quick) {
    verification.options.repeats = 2;
    verification.options.runs = 200;
    verification.options.budget_blocks = 2;
    verification.options.faults = verification.options.fusion = verification.options.speed = false;
  }
  const VerifiedCell verified = verify_cell(cell, verification, progress);
  result.verdict = verified.verdict;
  const auto& coverage = verified.watched.coverage;
  if (!coverage.empty()) headline.least_coverage = *std::min_element(coverage.begin(), coverage.end());
  result.cell_page = verification.out / "report.html";
}

/// Plan, scan, fuse, and once more for what is missing; told beside the paper's headline figures.
void scan(const Cell& cell, const DemoJob& job, const Progress& progress, DemoResult& result,
          HeadlineFigures& headline) {
  result.scans = tell_scan_story(cell, {job.out, job.quick, job.seed}, progress);
  headline.errors = result.errors;
  headline.rings = plan_on_rings(cell, {job.out, job.quick, job.seed}, progress);
  ScanReport page = story_report(cell, result.scans, headline);
  page.links = {{"where the targets should go", "layout/report.html"},
                {"the cell in motion", "verify/report.html"},
                {"the dynamic scan, frame by frame", "track/report.html"}};
  result.summary = page.summary;
  result.report = job.out / "report.html";
  write_scan_report(result.report, page);
}

}  // namespace

DemoResult run_demo(const DemoJob& job, const Progress& progress) {
  const Cell whole = cell_of("engine_casing");
  Cell cell = whole;
  if (job.quick) cell.timing.frames /= 5;
  DemoResult result;
  result.cell = cell.name;
  design(cell, job, progress, result);

  auto start = std::chrono::steady_clock::now();
  SimulateJob simulate{job.out / "recording", {}};
  simulate.options.seed = job.seed;
  result.simulated = simulate_recording(cell, simulate, progress);
  result.simulating_s = seconds_since(start);

  start = std::chrono::steady_clock::now();
  const Recording recording = open_recording(simulate.out);
  TrackJob track;
  track.out = job.out / "track";
  track.covariance = true;
  result.tracked = track_recording(recording, track, progress);
  result.tracking_s = seconds_since(start);

  const std::vector<PoseRecord> truth = read_poses(simulate.out / "truth_poses.csv");
  evaluate(recording, truth, result);
  report(job, recording, truth, track.options, result);

  HeadlineFigures headline;
  start = std::chrono::steady_clock::now();
  verify(cell, job, progress, result, headline);
  result.verifying_s = seconds_since(start);

  start = std::chrono::steady_clock::now();
  scan(whole, job, progress, result, headline);
  result.scanning_s = seconds_since(start);
  return result;
}

}  // namespace asterism
