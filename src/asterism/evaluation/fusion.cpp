// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/fusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/parallel.hpp"
#include "asterism/evaluation/fusion_runs.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/simulation/read_out.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {

void describe(FusionOptions& options, OptionVisitor& visit) {
  visit.number("occlusion_s", options.occlusion_s, {0.01, 60}, "how long both cameras are blind");
  visit.flag("suit_filter", options.suit_filter,
             "let the filter's wander be that of the motion, not the tracker's");
  visit.integer("runs", options.runs, {1, 100000}, "of noise");
}

namespace {

constexpr double kAfter_s = 0.5;  // looked at once there is sight again
const double kNoPose = std::numeric_limits<double>::quiet_NaN();
using Road = std::vector<BodyPose> FusionRun::*;
using Runs = std::vector<FusionRuns>;

bool is_measured(const BodyPose& pose) {
  return pose.status == PoseStatus::Ok || pose.status == PoseStatus::Partial;
}

double error_mm(const BodyPose& pose, const RigidMotion& truth, const Vec3& in_body) {
  return (pose.estimate->tracker_from_body * in_body - truth * in_body).norm();
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? kNoPose : std::sqrt(sum / static_cast<double>(values.size()));
}

/// The frames of one occlusion in the middle of the motion, or none when there is no room before and after.
std::optional<BlindFrames> blind_frames(const Cell& cell, double begin_s, double occlusion_s) {
  const double rate = cell.timing.rate_hz;
  const auto from = static_cast<std::ptrdiff_t>(std::ceil(begin_s * rate - 1e-9));
  const auto count = std::max<std::ptrdiff_t>(1, std::llround(occlusion_s * rate));
  const auto after = std::llround(std::ceil(kAfter_s * rate));
  if (from < 10 || from + count + after > cell.timing.frames) return std::nullopt;
  return BlindFrames{static_cast<std::size_t>(from), static_cast<std::size_t>(from + count)};
}

/// All runs of one occlusion on one road, at one point.
class RoadSum {
 public:
  RoadSum(const FusionBench& bench, const BlindFrames& blind, const Vec3& in_body, double rate_hz)
      : bench_(bench),
        blind_(blind),
        in_body_(in_body),
        after_(blind.to + static_cast<std::size_t>(std::ceil(kAfter_s * rate_hz))) {}

  void add(const std::vector<BodyPose>& poses) {
    for (std::size_t i = blind_.from; i < blind_.to; ++i) add_blind(poses[i], bench_.truth()[i]);
    std::optional<double> back_s;
    for (std::size_t i = blind_.to; i < std::min(after_, poses.size()); ++i) {
      if (poses[i].estimate) after_mm_.push_back(error_mm(poses[i], bench_.truth()[i], in_body_));
      if (is_measured(poses[i]) && !back_s) back_s = bench_.times_s()[i] - bench_.times_s()[blind_.to];
    }
    back_s_.push_back(back_s.value_or(kAfter_s));
  }

  [[nodiscard]] FusionRoad road() const {
    FusionRoad road;
    road.frames = blind_mm_.size() + lost_;
    road.lost = lost_;
    road.rms_mm = rms(blind_mm_);
    road.p95_mm = blind_mm_.empty() ? kNoPose : quantile_of(blind_mm_, 0.95);
    road.stated_mm = rms(stated_mm_);
    road.nees = nees_.empty() ? kNoPose : mean_of(nees_);
    const double gate = chi_square_quantile(0.95, 6);
    const auto inside = std::count_if(nees_.begin(), nees_.end(), [&](double n) { return n <= gate; });
    road.in_95_percent =
        nees_.empty() ? kNoPose : static_cast<double>(inside) / static_cast<double>(nees_.size());
    road.after_rms_mm = rms(after_mm_);
    road.back_s = mean_of(back_s_);
    return road;
  }

 private:
  void add_blind(const BodyPose& pose, const RigidMotion& truth) {
    if (!pose.estimate) {
      ++lost_;
      return;
    }
    const RigidMotion& told = pose.estimate->tracker_from_body;
    blind_mm_.push_back(error_mm(pose, truth, in_body_));
    stated_mm_.push_back(std::sqrt(covariance_of_point(told, pose.estimate->covariance, in_body_).trace()));
    const Vec6 error = difference(truth, told);
    if (const auto weighted = solve_positive(pose.estimate->covariance, error)) {
      nees_.push_back(error.dot(*weighted));
    }
  }

  const FusionBench& bench_;
  BlindFrames blind_;
  Vec3 in_body_;
  std::size_t after_;
  std::size_t lost_ = 0;
  std::vector<double> blind_mm_, stated_mm_, nees_, after_mm_, back_s_;
};

FusionRoad road_of(const FusionBench& bench, const Runs& runs, std::size_t occlusion,
                   const BlindFrames& blind, Road road, const Vec3& in_body, double rate_hz) {
  RoadSum sum(bench, blind, in_body, rate_hz);
  for (const FusionRuns& run : runs) sum.add(run.by_occlusion[occlusion].*road);
  return sum.road();
}

/// RMS and 95 % band over the runs, frame by frame.
void add_curves(const FusionBench& bench, const Runs& runs, std::size_t occlusion, Road road,
                const Vec3& in_body, FusionRoad& sum) {
  for (std::size_t i = 0; i < bench.times_s().size(); ++i) {
    std::vector<double> errors;
    for (const FusionRuns& run : runs) {
      const BodyPose& pose = (run.by_occlusion[occlusion].*road)[i];
      if (pose.estimate) errors.push_back(error_mm(pose, bench.truth()[i], in_body));
    }
    sum.by_frame_mm.push_back(rms(errors));
    sum.low_mm.push_back(errors.empty() ? kNoPose : quantile_of(errors, 0.025));
    sum.high_mm.push_back(errors.empty() ? kNoPose : quantile_of(errors, 0.975));
  }
}

FusionOffset offset_of(const Cell& cell, const Runs& runs) {
  FusionOffset sum;
  sum.true_s = cell.platform->read_out.latency_s;
  const RigidMotion base = tracker_from_base(cell);
  double square = 0;
  for (const FusionRuns& run : runs) {
    const auto& offset = run.offset;
    if (!offset) {
      sum.untold.emplace_back(text_of(offset.error()));
      continue;
    }
    ++sum.told;
    sum.mean_s += offset->latency_s;
    sum.sigma_s += offset->sigma_s;
    square += std::pow((offset->latency_s - sum.true_s) / offset->sigma_s, 2);
    const Vec6 error = difference(base, offset->tracker_from_base);
    if (const auto weighted = solve_positive(offset->covariance, error)) {
      sum.base_nees += error.dot(*weighted) / 6;
    }
  }
  if (sum.told == 0) return sum;
  sum.mean_s /= sum.told;
  sum.sigma_s /= sum.told;
  sum.base_nees /= sum.told;
  sum.rms_in_sigma = std::sqrt(square / sum.told);
  return sum;
}

/// The occlusions that the motion has room for: first the one that is drawn.
std::vector<std::pair<double, BlindFrames>> occlusions_of(const Cell& cell, const FusionOptions& options) {
  const double begin_s = 0.5 * ((cell.timing.frames - 1) / cell.timing.rate_hz - options.occlusion_s);
  const auto drawn = blind_frames(cell, begin_s, options.occlusion_s);
  if (!drawn) {
    throw InputError(cell.name,
                     fmt::format("its {} frames at {} Hz leave no room for an occlusion of {} s with ten "
                                 "frames before and {} s after it; let `timing` be longer",
                                 cell.timing.frames, cell.timing.rate_hz, options.occlusion_s, kAfter_s));
  }
  std::vector<std::pair<double, BlindFrames>> occlusions = {{options.occlusion_s, *drawn}};
  for (const double occlusion_s : options.others_s) {
    const auto blind = blind_frames(cell, begin_s, occlusion_s);
    if (blind && occlusion_s != options.occlusion_s) occlusions.emplace_back(occlusion_s, *blind);
  }
  return occlusions;
}

std::size_t worst_point(const FusionBench& bench, const Runs& runs, const BlindFrames& blind,
                        std::span<const WorkPoint> points, double rate_hz) {
  std::size_t worst = 0;
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here =
        road_of(bench, runs, 0, blind, &FusionRun::with_read_out, points[i].in_body_mm, rate_hz).rms_mm;
    if (!(here > largest)) continue;
    largest = here;
    worst = i;
  }
  return worst;
}

void refuse_if_nothing_was_seen(const Cell& cell, const Runs& runs, const BlindFrames& blind) {
  for (const FusionRuns& run : runs) {
    for (std::size_t i = 0; i < blind.from; ++i) {
      if (is_measured(run.by_occlusion.front().alone[i])) return;
    }
  }
  throw MeasurementError(cell.name + ": the tracker has no pose of the platform before the occlusion");
}

}  // namespace

FusionStudy fusion_of(const Cell& cell, std::span<const WorkPoint> points, const FusionOptions& options,
                      const Progress& progress) {
  require(!points.empty(), "an error is told at a point");
  const FusionBench bench(cell, options);
  const auto occlusions = occlusions_of(cell, options);
  std::vector<BlindFrames> blind;
  for (const auto& [occlusion_s, frames] : occlusions) blind.push_back(frames);
  Runs runs(static_cast<std::size_t>(options.runs));
  progress("blinding the cameras", 0, runs.size());
  parallel_for(runs.size(), [&](std::size_t i) { runs[i] = bench.run(static_cast<int>(i), blind); });
  progress("blinding the cameras", runs.size(), runs.size());
  refuse_if_nothing_was_seen(cell, runs, blind.front());

  FusionStudy study;
  study.body = cell.platform->body;
  study.read_out = cell.platform->read_out;
  study.filter = bench.filter();
  study.runs = options.runs;
  study.times_s = bench.times_s();
  const double rate_hz = cell.timing.rate_hz;
  const WorkPoint& point = points[worst_point(bench, runs, blind.front(), points, rate_hz)];
  study.point = point.name;
  study.in_body_mm = point.in_body_mm;
  for (std::size_t i = 0; i < occlusions.size(); ++i) {
    const auto road = [&](Road which) {
      return road_of(bench, runs, i, blind[i], which, point.in_body_mm, rate_hz);
    };
    study.spells.push_back({occlusions[i].first, bench.times_s()[blind[i].from], road(&FusionRun::alone),
                            road(&FusionRun::with_read_out)});
  }
  study.drawn = study.spells.front();
  add_curves(bench, runs, 0, &FusionRun::alone, point.in_body_mm, study.drawn.alone);
  add_curves(bench, runs, 0, &FusionRun::with_read_out, point.in_body_mm, study.drawn.with_read_out);
  std::sort(study.spells.begin(), study.spells.end(),
            [](const FusionSpell& a, const FusionSpell& b) { return a.occlusion_s < b.occlusion_s; });
  study.offset = offset_of(cell, runs);
  return study;
}

}  // namespace asterism
