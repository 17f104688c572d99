// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/demo.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "asterism/io/cell_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/report/tracking_report.hpp"

namespace asterism {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

/// Along the motion: what will be seen, how good it is, what becomes of it under faults.
void verify(const Cell& cell, const DemoJob& job, const Progress& progress, DemoResult& result) {
  VerifyJob verification;
  verification.out = job.out;
  verification.seed = job.seed;
  if (job.quick) {
    verification.options.repeats = 2;
    verification.options.runs = 200;
    verification.options.budget_blocks = 2;
    verification.options.faults = verification.options.fusion = verification.options.speed = false;
  }
  result.verdict = verify_cell(cell, verification, progress).verdict;
  result.report = job.out / "report.html";
}

}  // namespace

DemoResult run_demo(const DemoJob& job, const Progress& progress) {
  Cell cell = cell_of("engine_casing");
  if (job.quick) cell.timing.frames /= 5;
  DemoResult result;
  result.cell = cell.name;

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

  start = std::chrono::steady_clock::now();
  verify(cell, job, progress, result);
  result.verifying_s = seconds_since(start);
  return result;
}

}  // namespace asterism
