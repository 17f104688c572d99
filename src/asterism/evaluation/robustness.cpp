// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/robustness.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "asterism/core/parallel.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/statistics/summary.hpp"
#include "asterism/tracking/knocked_targets.hpp"

namespace asterism {
namespace {

// A target counts as seen when so much of it is, and so bright: what simulation asks of a centre.
constexpr double kWhole = 0.98;
constexpr double kBright = 0.1;
constexpr std::size_t kBatch = 16;  // runs between two words of progress

struct RunOutcome {
  Outcome measured, filtered;
  std::size_t named = 0, named_wrong = 0;
  std::size_t found = 0, undecided = 0, accused_wrong = 0;
  double shift_chi_square = 0;
  std::vector<double> detectable_mm, detectable_at_once_mm;
};

/// Holds what is said of the body's shape against what was done to it.
void judge(const ShapeCheck& check, const FaultRun& run, const Vec3& displaced_mm, RunOutcome& outcome) {
  outcome.detectable_mm = check.detectable_mm;
  outcome.detectable_at_once_mm = check.detectable_at_once_mm;
  for (const KnockedTarget& knocked : check.knocked) {
    const bool rival = run.knocked && std::find(knocked.rivals.begin(), knocked.rivals.end(), *run.knocked) !=
                                          knocked.rivals.end();
    if (run.knocked && knocked.target == *run.knocked) {
      ++(knocked.rivals.empty() ? outcome.found : outcome.undecided);
      const Vec3 off = knocked.shift_mm - displaced_mm;
      outcome.shift_chi_square = off.dot(knocked.covariance.inverse() * off);
    } else {
      ++(rival ? outcome.undecided : outcome.accused_wrong);
    }
  }
}

RunOutcome outcome_of(const FaultRun& run, const std::vector<Body>& learnt, std::size_t body,
                      std::span<const Vec3> points, const RobustnessOptions& options,
                      const TrackerOptions& tracking) {
  const Simulator simulator(run.cell, run.simulation);
  Tracker tracker(run.cell.rig, learnt, tracking);
  RunOutcome outcome;
  std::vector<TrackedFrame> frames;
  for (int i = 0; i < run.frames; ++i) {
    const SimulatedFrame frame = simulator.frame(run.first_frame + i);
    const bool images = run.simulation.level == SimulationLevel::Images;
    frames.push_back(images ? tracker.process(frame.image) : tracker.process(frame.centres));
    const TrackedFrame& tracked = frames.back();
    const Shown shown = shown_in(frame, body);
    count_frame(tracked.poses[body], shown, points, options, outcome.measured);
    count_frame(tracked.filtered[body], shown, points, options, outcome.filtered);
    const std::vector<int>& rejected = tracked.poses[body].rejected;
    if (rejected.empty()) continue;
    const bool right = run.knocked && rejected.size() == 1 && rejected.front() == *run.knocked;
    ++(right ? outcome.named : outcome.named_wrong);
  }
  Vec3 displaced = run.shift_mm;
  if (run.knocked) {
    const auto target = static_cast<std::size_t>(*run.knocked);
    displaced += run.cell.movers[body].body.targets[target].position - learnt[body].targets[target].position;
  }
  judge(check_shape(body, frames, learnt, run.cell.rig, {}, tracking.views), run, displaced, outcome);
  return outcome;
}

void add_to(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

double median_of(const std::vector<double>& values) { return values.empty() ? 0 : quantile_of(values, 0.5); }

/// Runs of the same fault stand side by side.
std::vector<FaultOutcome> rows_of(const std::vector<FaultRun>& runs,
                                  const std::vector<RunOutcome>& outcomes) {
  std::vector<FaultOutcome> rows;
  std::tuple<std::size_t, std::size_t, std::size_t> worst;
  std::vector<double> detectable, at_once;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (rows.empty() || rows.back().fault != runs[i].fault) {
      rows.push_back({});
      rows.back().fault = runs[i].fault;
      worst = {};
      detectable.clear();
      at_once.clear();
    }
    FaultOutcome& row = rows.back();
    const Outcome& measured = outcomes[i].measured;
    const std::tuple badness{measured.wrong, measured.too_sure, measured.lost + measured.flagged};
    if (badness > worst) {
      worst = badness;
      row.worst = runs[i].variant;
    }
    ++row.runs;
    row.measured += measured;
    row.filtered += outcomes[i].filtered;
    row.named += outcomes[i].named;
    row.named_wrong += outcomes[i].named_wrong;
    row.knocks += runs[i].knocked ? 1 : 0;
    row.found += outcomes[i].found;
    row.undecided += outcomes[i].undecided;
    row.accused_wrong += outcomes[i].accused_wrong;
    if (outcomes[i].found > 0) row.shift_chi_square += outcomes[i].shift_chi_square;
    add_to(detectable, outcomes[i].detectable_mm);
    add_to(at_once, outcomes[i].detectable_at_once_mm);
    row.detectable_mm = median_of(detectable);
    row.detectable_at_once_mm = median_of(at_once);
  }
  return rows;
}

}  // namespace

bool is_seen(const TargetTruth& target) {
  return target.in_image && target.visible >= kWhole && target.brightness >= kBright;
}

Shown shown_in(const SimulatedFrame& frame, std::size_t body) {
  std::map<int, int> cameras;
  for (const TargetTruth& target : frame.truth.targets) {
    if (target.body == static_cast<int>(body) && is_seen(target)) ++cameras[target.target];
  }
  const auto both =
      std::count_if(cameras.begin(), cameras.end(), [](const auto& at) { return at.second == 2; });
  return {frame.truth.tracker_from_body[body], both >= 4};
}

void count_frame(const BodyPose& pose, const Shown& shown, std::span<const Vec3> points,
                 const RobustnessOptions& options, Outcome& outcome) {
  static const double kTooSure = chi_square_quantile(1 - 1e-6, 6);
  static const double kInside = chi_square_quantile(0.95, 6);
  ++outcome.frames;
  if (!pose.estimate) {
    const bool ambiguous = pose.status == PoseStatus::Ambiguous;
    ++(ambiguous ? outcome.flagged : outcome.lost);
    outcome.blind += ambiguous || shown.enough ? 0 : 1;
    return;
  }
  const RigidMotion& truth = shown.tracker_from_body;
  const RigidMotion& found = pose.estimate->tracker_from_body;
  double worst_mm = 0;
  for (const Vec3& point : points) worst_mm = std::max(worst_mm, (found * point - truth * point).norm());
  const Vec6 off = difference(truth, found);
  const auto weighted = solve_positive(pose.estimate->covariance, off);
  const double nees = weighted ? off.dot(*weighted) : 0.0;
  const bool wrong = worst_mm > options.wrong_mm ||
                     deg_from_rad(rotation_angle(found.rotation, truth.rotation)) > options.wrong_deg;
  ++outcome.poses;
  if (pose.status != PoseStatus::Predicted) {
    ++outcome.seen;
    outcome.square_mm += worst_mm * worst_mm;
    outcome.max_mm = std::max(outcome.max_mm, worst_mm);
  }
  outcome.nees += nees;
  outcome.inside_95 += nees < kInside ? 1 : 0;
  if (nees > kTooSure) {
    ++(wrong ? outcome.wrong : outcome.too_sure);
  } else if (pose.status == PoseStatus::Predicted) {
    ++outcome.flagged;
  } else {
    ++(wrong ? outcome.rough : outcome.kept);
  }
}

Outcome& Outcome::operator+=(const Outcome& other) {
  frames += other.frames;
  kept += other.kept;
  rough += other.rough;
  flagged += other.flagged;
  lost += other.lost;
  blind += other.blind;
  too_sure += other.too_sure;
  wrong += other.wrong;
  poses += other.poses;
  seen += other.seen;
  square_mm += other.square_mm;
  max_mm = std::max(max_mm, other.max_mm);
  nees += other.nees;
  inside_95 += other.inside_95;
  return *this;
}

double Outcome::rms_mm() const { return seen > 0 ? std::sqrt(square_mm / static_cast<double>(seen)) : 0; }
double Outcome::nees_share() const { return poses > 0 ? nees / (6.0 * static_cast<double>(poses)) : 0; }
double Outcome::inside_95_share() const {
  return poses > 0 ? static_cast<double>(inside_95) / static_cast<double>(poses) : 0;
}

std::size_t RobustnessTable::wrong() const {
  std::size_t sum = 0;
  for (const FaultOutcome& row : rows) sum += row.measured.wrong + row.filtered.wrong;
  return sum;
}

std::size_t RobustnessTable::too_sure() const {
  std::size_t sum = 0;
  for (const FaultOutcome& row : rows) sum += row.measured.too_sure + row.filtered.too_sure;
  return sum;
}

RobustnessTable robustness_of(const Cell& cell, const RobustnessOptions& options,
                              const TrackerOptions& tracker, const Progress& progress) {
  check_cell(cell, cell.name);
  const std::vector<FaultRun> runs = fault_runs(cell, options);
  const std::vector<Body> learnt = bodies_as_learnt(cell);
  const std::size_t body = verified_body(cell);
  const std::vector<Vec3> points = points_in_question(cell);
  std::vector<RunOutcome> outcomes(runs.size());
  for (std::size_t first = 0; first < runs.size(); first += kBatch) {
    progress("trying faults", first, runs.size());
    parallel_for(std::min(kBatch, runs.size() - first), [&](std::size_t i) {
      outcomes[first + i] = outcome_of(runs[first + i], learnt, body, points, options, tracker);
    });
  }
  progress("trying faults", runs.size(), runs.size());
  return {rows_of(runs, outcomes), options};
}

}  // namespace asterism
