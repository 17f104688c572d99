// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/verify_cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "asterism/core/output_file.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/workflow/verify_layouts.hpp"

namespace asterism {
namespace {

/// Seconds of each stage.
class Stopwatch {
 public:
  explicit Stopwatch(VerifiedCell& verified) : verified_(verified) {}
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    verified_.seconds.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  VerifiedCell& verified_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::vector<double> times_of(const Timing& timing) {
  std::vector<double> times(static_cast<std::size_t>(timing.frames));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / timing.rate_hz;
  return times;
}

std::vector<RigidMotion> poses_of(const WatchedCell& watched, std::size_t mover) {
  std::vector<RigidMotion> poses;
  for (const auto& at : watched.poses) poses.push_back(at[mover]);
  return poses;
}

/// "too oblique 240, hidden 80": of all sights that fail.
std::string reasons_of(const WatchedBody& body) {
  std::array<int, kSightFailures> counts{};
  for (const auto& pose : body.causes) {
    for (const auto& target : pose) {
      for (const SightCause& cause : target) {
        if (cause.fails) ++counts[static_cast<std::size_t>(*cause.fails)];
      }
    }
  }
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < kSightFailures; ++i) {
    if (counts[i] > 0)
      reasons.push_back(fmt::format("{} {}", text_of(static_cast<SightFailure>(i)), counts[i]));
  }
  return reasons.empty() ? "all targets are seen, but they leave a motion free"
                         : fmt::format("{}", fmt::join(reasons, ", "));
}

void watch(const Cell& cell, const Occlusion& occlusion, const VerifyOptions& options,
           VerifiedCell& verified) {
  verified.watched = watch_cell(cell, times_of(cell.timing), options.visibility, occlusion);
  verified.solids = occlusion.names();
}

/// All sources, moment by moment: first order, with what they make on average as a part of the mean square.
void predict_all(const Cell& cell, const AccuracyOptions& noise, VerifiedCell& verified) {
  const std::size_t mover = verified.body.mover;
  const MotionVisibility& visibility = verified.watched.bodies[mover].visibility;
  std::vector<std::optional<Mat6>> squares(verified.watched.times_s.size());
  parallel_for(squares.size(), [&](std::size_t i) {
    if (!verified.noise_only.poses[i]) return;
    const PoseExperiment experiment(cell, mover, verified.watched.times_s[i], visibility.seen[i], noise);
    try {
      const ErrorBudget budget = first_order_budget(experiment, Vec3::Zero());
      squares[i] = budget.covariance + budget.bias * budget.bias.transpose();
    } catch (const MeasurementError&) {
      return;  // determined, but the estimator finds no pose there
    }
  });
  verified.predicted = with_covariances(verified.noise_only, poses_of(verified.watched, mover), squares);
}

void predict(const Cell& cell, const AccuracyOptions& noise, VerifiedCell& verified) {
  const std::size_t mover = verified.body.mover;
  const Belief exact = exact_belief(cell);
  verified.noise_only =
      predict_along(exact.bodies[mover].targets, exact.rig, poses_of(verified.watched, mover),
                    verified.watched.bodies[mover].visibility, verified.body.points, noise);
  predict_all(cell, noise, verified);
  if (const auto worst = worst_moment(verified.predicted)) {
    verified.worst = *worst;
    return;
  }
  throw MeasurementError(fmt::format(
      "the tracker sees nothing: the pose of {} is determined in none of {} frames ({})", verified.body_name,
      verified.watched.times_s.size(), reasons_of(verified.watched.bodies[mover])));
}

/// Faults and losses are robustness; here is how good what is measured is.
Cell without_losses(Cell cell) {
  cell.faults.clear();
  cell.noise.target_loss = 0;
  cell.sensor.lost_frames = 0;
  return cell;
}

void simulate(const Cell& cell, const VerifyJob& job, const Progress& progress, VerifiedCell& verified) {
  const bool images = job.options.level == CentreLevel::Images;
  const Cell sound = without_losses(cell);
  const Disturber disturber(sound, job.seed);
  SimulatedRunOptions options;
  options.simulation.level = images ? SimulationLevel::Images : SimulationLevel::Centres;
  options.simulation.sigma_px = cell.noise.sigma_px;
  options.tracker = job.options.tracker;
  verified.repeats = images ? 1 : static_cast<std::size_t>(job.options.repeats);
  std::vector<std::vector<SimulatedPose>> exact, disturbed;
  for (std::size_t repeat = 0; repeat < verified.repeats; ++repeat) {
    options.simulation.seed = job.seed + repeat;
    const std::vector<Belief> beliefs = {exact_belief(sound), disturber.belief(repeat)};
    auto both = simulate_and_track(sound, beliefs, verified.body.mover, options,
                                   [&](auto stage, auto done, auto total) {
                                     progress(stage, repeat * total + done, verified.repeats * total);
                                   });
    exact.push_back(std::move(both[0]));
    disturbed.push_back(std::move(both[1]));
  }
  const MotionVisibility& visibility = verified.watched.bodies[verified.body.mover].visibility;
  verified.noise_agreement = compare_roads(verified.noise_only, exact, visibility);
  verified.agreement = compare_roads(verified.predicted, disturbed, visibility);
  verified.poses = disturbed.front();
  verified.simulated.resize(verified.body.points.size());
  const std::size_t first = verified.body.has_named() ? VerifiedBody::kFirstNamed : 0;
  for (const auto& repeat : disturbed) {
    const auto counts = status_counts(repeat);
    for (std::size_t i = 0; i < counts.size(); ++i) verified.status[i] += counts[i];
    for (const SimulatedPose& pose : repeat) {
      for (std::size_t i = 0; pose.error && i < verified.body.points.size(); ++i) {
        const double error_mm = error_at(pose, verified.body.points[i].in_body_mm).norm();
        VerifiedCell::Simulated& at = verified.simulated[i];
        at.square_mm2 += error_mm * error_mm;
        at.largest_mm = std::max(at.largest_mm, error_mm);
        at.beyond += error_mm > verified.tolerance_mm;
        ++at.poses;
      }
    }
  }
  CellVerdict& verdict = verified.verdict;
  for (std::size_t i = first; i < verified.simulated.size(); ++i) {
    verdict.largest_mm = std::max(verdict.largest_mm, verified.simulated[i].largest_mm);
    verdict.beyond = std::max(verdict.beyond, verified.simulated[i].share_beyond());
  }
}

void budget(const Cell& cell, const VerifyJob& job, const AccuracyOptions& noise, VerifiedCell& verified) {
  const WorstMoment& worst = verified.worst;
  const PoseExperiment experiment(cell, verified.body.mover, verified.watched.times_s[worst.frame],
                                  verified.watched.bodies[verified.body.mover].visibility.seen[worst.frame],
                                  noise);
  verified.budget = error_budget(experiment, verified.body.points[worst.point].in_body_mm,
                                 {job.seed, job.options.budget_blocks});
}

void map_part(const Cell& cell, VerifiedCell& verified) {
  if (!cell.workpiece || !cell.workpiece->surface || cell.workpiece->body != verified.body_name) return;
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : cell.workpiece->surface->vertices)
    vertices.push_back(cell.workpiece->carrier_from_solid * vertex);
  verified.map = error_map(vertices, verified.predicted, poses_of(verified.watched, verified.body.mover));
}

void read_out(const Cell& cell, const VerifyJob& job, VerifiedCell& verified) {
  if (!cell.platform || cell.platform->body != verified.body_name) return;
  std::vector<Vec3> points;
  for (const WorkPoint& point : verified.body.points) points.push_back(point.in_body_mm);
  verified.read_out = read_out_errors(cell, points, job.seed);
}

/// How fast it may turn, by exposure and frame rate.
void hurry(const Cell& cell, const VerifyJob& job, const Progress& progress, VerifiedCell& verified) {
  if (!job.options.speed) return;
  SpeedTradeOptions options;
  options.seed = job.seed;
  options.image_frames = 0;
  try {
    verified.speed = speed_trade_of(cell, options, job.options.tracker, progress);
  } catch (const InputError& error) {
    verified.remarks.push_back(fmt::format("no trade of speed and exposure: {}", error.what()));
  }
}

/// What is asked when something goes wrong.
void upset(const Cell& cell, const VerifyJob& job, const Progress& progress, VerifiedCell& verified) {
  if (job.options.faults) {
    RobustnessOptions options = job.options.robustness;
    options.seed = job.seed;
    verified.robustness = robustness_of(cell, options, job.options.tracker, progress);
  }
  if (!job.options.fusion || !cell.platform || cell.platform->body != verified.body_name) return;
  FusionOptions options;
  options.seed = job.seed;
  options.tracker = job.options.tracker;
  const std::size_t first = verified.body.has_named() ? VerifiedBody::kFirstNamed : 0;
  try {
    verified.fusion = fusion_of(cell, std::span(verified.body.points).subspan(first), options, progress);
  } catch (const InputError& error) {
    verified.remarks.push_back(fmt::format("no fusion with the read-out: {}", error.what()));
  } catch (const MeasurementError& error) {
    verified.remarks.push_back(fmt::format("no fusion with the read-out: {}", error.what()));
  }
}

void judge(VerifiedCell& verified) {
  CellVerdict& verdict = verified.verdict;
  const std::string& point = verified.body.points[verified.worst.point].name;
  verdict.below_95_mm = verified.budget.below_95_mm;
  const bool bound = verdict.below_95_mm <= verified.tolerance_mm;
  const bool seen = verdict.beyond <= kMayLieBeyond;
  verdict.pass = bound && seen && verified.agreement.wrong == 0;
  verdict.words = fmt::format(
      "{}: at {} the error stays below {:.3f} mm with 95 % probability at the worst moment ({:.2f} s); of "
      "the "
      "simulated errors {:.2g} % are beyond the tolerance of {:.3f} mm, the largest is {:.3f} mm",
      verdict.pass ? "PASS" : "FAIL", point, verdict.below_95_mm,
      verified.watched.times_s[verified.worst.frame], 100 * verdict.beyond, verified.tolerance_mm,
      verdict.largest_mm);
  if (verified.agreement.wrong > 0)
    verdict.words += fmt::format("; {} poses were wrong", verified.agreement.wrong);
  if (verified.predicted.undetermined > 0) {
    verdict.words += fmt::format("; {} of {} frames have no determined pose and are not judged",
                                 verified.predicted.undetermined, verified.watched.times_s.size());
  }
}

void write(const Cell& cell, const VerifyJob& job, const VerifiedCell& verified) {
  write_file(job.out / "errors.csv", errors_csv(verified));
  write_file(job.out / "sights.csv", sights_csv(cell, verified));
  write_cell_report(job.out / "report.html", report_of(cell, verified, job.options));
  write_file(job.out / "summary.json", summary_of(verified, job.options).dump(2) + "\n");
}

}  // namespace

void describe(VerifyOptions& options, OptionVisitor& visit) {
  visit.choice_of("level", options.level, {"centres", "images"},
                  "what the tracker is given: centres with the stated noise, or images");
  visit.integer("repeats", options.repeats, {1, 1000}, "of the motion, at the level of centres");
  visit.integer("runs", options.runs, {3, 10000000}, "disturbance runs of each layout");
  visit.integer("moments", options.moments, {1, 1000}, "of the motion at which each run measures");
  visit.integer("budget_blocks", options.budget_blocks, {2, 1000},
                "of 10000 draws that check the error budget");
  visit.flag("faults", options.faults, "see what becomes of the pose under faults");
  visit.flag("fusion", options.fusion, "see what the platform's read-out gains while both cameras are blind");
  visit.flag("speed", options.speed, "see error over turning rate, exposure and frame rate");
  const auto section = [&](std::string_view name, auto& part) {
    SectionVisitor visitor(name, visit);
    describe(part, visitor);
  };
  section("robustness", options.robustness);
  section("visibility", options.visibility);
  section("occlusion", options.occlusion);
  section("tracker", options.tracker);
}

VerifiedCell verify_cell(const Cell& cell, const VerifyJob& job, const Progress& progress) {
  check_cell(cell, cell.name);
  VerifiedCell verified;
  Stopwatch watch_time(verified);
  verified.cell = cell.name;
  verified.body = verification_of(cell);
  verified.body_name = cell.movers[verified.body.mover].body.name;
  verified.tolerance_mm = cell.verification.tolerance_mm;
  verified.nominal_mm = cell.verification.nominal_mm;
  const AccuracyOptions noise = accuracy_options_of(cell, job.options.level);
  const Occlusion occlusion(cell, job.options.occlusion);
  watch(cell, occlusion, job.options, verified);
  watch_time.lap("visibility");
  predict(cell, noise, verified);
  watch_time.lap("prediction");
  simulate(cell, job, progress, verified);
  read_out(cell, job, verified);
  watch_time.lap("simulation and tracking");
  DisturbedLayouts disturbed =
      disturb_layouts(cell, verified.body, verified.watched.times_s, job, occlusion, progress);
  verified.runs = std::move(disturbed.runs);
  verified.comparisons = std::move(disturbed.comparisons);
  watch_time.lap("disturbance runs");
  budget(cell, job, noise, verified);
  watch_time.lap("error budget");
  map_part(cell, verified);
  judge(verified);
  watch_time.lap("error map");
  upset(cell, job, progress, verified);
  watch_time.lap("faults and fusion");
  hurry(cell, job, progress, verified);
  watch_time.lap("speed");
  if (!job.out.empty()) write(cell, job, verified);
  return verified;
}

}  // namespace asterism
