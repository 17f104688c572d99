// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/time_offset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/tracking/read_out_residuals.hpp"

namespace asterism {

void describe(TimeOffsetOptions& options, OptionVisitor& visit) {
  visit.number("max_offset_s", options.max_offset_s, {1e-3, 10},
               "the latency is searched for up to so much to either side");
  visit.number("largest_gap_s", options.largest_gap_s, {1e-4, 10},
               "between tracked poses, for the pose between them to be told");
  visit.number("correlation_s", options.correlation_s, {0, 1e4},
               "time for which the readings' correlated noise keeps its value");
  visit.number("gate_probability", options.gate_probability, {1e-12, 0.1}, "of refusing a reading that fits");
}

std::string_view text_of(OffsetFailure reason) {
  switch (reason) {
    case OffsetFailure::TooFew:
      return "too few readings lie between tracked poses";
    case OffsetFailure::NotMoving:
      return "the platform does not move enough while both speak for its latency to be told";
    case OffsetFailure::BeyondSearch:
      return "the readings fit best beyond the largest offset that was searched";
    case OffsetFailure::Periodic:
      return "the motion repeats itself, so another offset fits as well";
  }
  return "";
}

namespace {

using Vec7 = Eigen::Matrix<double, 7, 1>;
using Mat7 = Eigen::Matrix<double, 7, 7>;
using Residuals = std::vector<ReadOutResidual>;
constexpr std::size_t kFewest = 10;         // readings
constexpr std::size_t kGridReadings = 100;  // more would only make the search slower
constexpr double kGridStep_s = 0.02;        // well below a quarter of any platform's period
constexpr double kMedianOfSix = 5.348;      // of χ² with six degrees
constexpr std::size_t kOtherTries = 6;      // of offsets that might fit as well
constexpr double kAsWell = 20;              // χ² by which another may fit worse
constexpr double kAboveNoise = 10;          // the information of τ over what noise alone would seem to tell

struct Run {
  const PoseCurve& curve;
  std::span<const PlatformReading> readings;
  double largest_gap_s;
  double gate;  // of χ² with six degrees
};

Residuals pairs_of(const Run& run, const ReadOutLink& link) {
  return residuals_of(run.curve, run.readings, link, run.largest_gap_s);
}

double median_square(const Residuals& pairs) {
  std::vector<double> squares;
  for (const ReadOutResidual& pair : pairs) squares.push_back(pair.square);
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle;
}

/// What a squared residual may be: as χ² has it, or as most of the residuals are.
double limit_of(const Run& run, const Residuals& pairs) {
  return run.gate * std::max(1.0, median_square(pairs) / kMedianOfSix);
}

Mat67 jacobian(const Run& run, const ReadOutLink& link, const ReadOutResidual& pair) {
  return jacobian_of(pair, run.readings[pair.reading], link);
}

/// One step of Gauss–Newton; of the frame alone when the latency is held. False: not determined.
bool improve(const Run& run, const Residuals& pairs, bool hold_latency, ReadOutLink& link,
             double& latency_step_s) {
  const double limit = limit_of(run, pairs);
  Mat7 normal = Mat7::Zero();
  Vec7 right = Vec7::Zero();
  for (const ReadOutResidual& pair : pairs) {
    if (pair.square > limit) continue;
    const Mat67 j = jacobian(run, link, pair);
    normal += j.transpose() * pair.weight * j;
    right += j.transpose() * pair.weight * pair.residual;
  }
  if (hold_latency) {
    normal.row(6).setZero();
    normal.col(6).setZero();
    normal(6, 6) = 1;
    right(6) = 0;
  }
  const auto step = solve_positive(MatX(normal), VecX(-right));
  if (!step) return false;
  link.tracker_from_base = perturbed(link.tracker_from_base, step->head<6>());
  latency_step_s = (*step)(6);
  link.latency_s += latency_step_s;
  return true;
}

/// The best frame for one latency: that of the reading most others agree with, then improved.
std::optional<ReadOutLink> start_at(const Run& run, double latency_s, double& cost) {
  constexpr std::size_t kTries = 5;
  Residuals pairs = pairs_of(run, {latency_s, {}});
  if (pairs.size() < kFewest) return std::nullopt;
  std::optional<ReadOutLink> best;
  for (std::size_t i = 0; i < kTries; ++i) {
    const ReadOutResidual& pair = pairs[(2 * i + 1) * pairs.size() / (2 * kTries)];
    const ReadOutLink link{
        latency_s, pair.between.tracker_from_body * run.readings[pair.reading].base_from_body.inverse()};
    const double median = median_square(pairs_of(run, link));
    if (best && median >= cost) continue;
    best = link;
    cost = median;
  }
  double none = 0;
  if (improve(run, pairs_of(run, *best), true, *best, none)) cost = median_square(pairs_of(run, *best));
  return best;
}

/// Stops where it leaves what was searched.
std::optional<ReadOutLink> refined(const Run& run, ReadOutLink link, double farthest_s) {
  constexpr int kMostSteps = 50;
  constexpr double kSmall_s = 1e-8;
  double step_s = 1;
  for (int i = 0; i < kMostSteps && std::abs(step_s) > kSmall_s; ++i) {
    if (std::abs(link.latency_s) > farthest_s) return link;
    const Residuals pairs = pairs_of(run, link);
    if (pairs.size() < kFewest || !improve(run, pairs, false, link, step_s)) return std::nullopt;
  }
  return link;
}

/// Where the cost on the grid is lower than beside, the lowest first.
std::vector<ReadOutLink> starts_of(const Run& run, const TimeOffsetOptions& options) {
  const int side = std::max(1, static_cast<int>(std::ceil(options.max_offset_s / kGridStep_s)));
  std::vector<std::optional<ReadOutLink>> links;
  std::vector<double> costs;
  for (int i = -side; i <= side; ++i) {
    double cost = std::numeric_limits<double>::infinity();
    links.push_back(start_at(run, options.max_offset_s * i / side, cost));
    costs.push_back(cost);
  }
  std::vector<std::size_t> lowest;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool before = i == 0 || costs[i] <= costs[i - 1];
    const bool behind = i + 1 == links.size() || costs[i] < costs[i + 1];
    if (links[i] && before && behind) lowest.push_back(i);
  }
  std::stable_sort(lowest.begin(), lowest.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  std::vector<ReadOutLink> starts;
  for (const std::size_t i : lowest) starts.push_back(*links[i]);
  return starts;
}

/// Each residual at most at its limit: of what does not fit it does not matter how far off it is.
double mean_square(const Residuals& pairs, double limit) {
  double sum = 0;
  for (const ReadOutResidual& pair : pairs) sum += std::min(pair.square, limit);
  return sum / static_cast<double>(pairs.size());
}

/// The covariance of Σ Jᵀ W r: what each reading and each pose adds through all the residuals it is part of.
Mat7 covariance_of_sum(const Run& run, const ReadOutLink& link, const Residuals& pairs, double limit,
                       double correlation_s) {
  const Mat3 turn = link.tracker_from_base.rotation.toRotationMatrix();
  std::vector<Mat67> by_pose(run.curve.times_s.size(), Mat67::Zero());
  Mat7 sum = Mat7::Zero();
  Mat67 before = Mat67::Zero();  // of the readings before, as far as their noise is still the same
  double last_s = 0;
  for (const ReadOutResidual& pair : pairs) {
    if (pair.square > limit) continue;
    const Mat67 lever = pair.weight * jacobian(run, link, pair);
    for (std::size_t i = 0; i < 4; ++i) by_pose[pair.between.first + i] += pair.between.share[i] * lever;
    const PlatformReading& reading = run.readings[pair.reading];
    Mat67 in_base;
    in_base << turn.transpose() * lever.topRows<3>(), turn.transpose() * lever.bottomRows<3>();
    sum += in_base.transpose() * reading.covariance * in_base;
    if (correlation_s > 0) {
      before *= std::exp(-(reading.time_s - last_s) / correlation_s);
      const Mat7 both = in_base.transpose() * reading.correlated * before;
      sum += both + both.transpose();
      before += in_base;
      last_s = reading.time_s;
    }
  }
  for (std::size_t i = 0; i < by_pose.size(); ++i) {
    sum += by_pose[i].transpose() * run.curve.noise[i] * by_pose[i];
  }
  return sum;
}

Result<TimeOffset, OffsetFailure> with_doubt(const Run& run, const ReadOutLink& link,
                                             const TimeOffsetOptions& options) {
  const Residuals pairs = pairs_of(run, link);
  const double limit = limit_of(run, pairs);
  TimeOffset offset{link.latency_s, 0, link.tracker_from_base, Mat6::Zero(), 0, 0, 0};
  Mat7 normal = Mat7::Zero();
  double by_noise = 0;  // what the velocity's own noise adds to the information of τ
  for (const ReadOutResidual& pair : pairs) {
    if (pair.square > limit) {
      ++offset.refused;
      continue;
    }
    ++offset.readings;
    offset.misfit += pair.square;
    const Mat67 j = jacobian(run, link, pair);
    normal += j.transpose() * pair.weight * j;
    for (std::size_t i = 0; i < 4; ++i) {
      const Mat6& noise = run.curve.noise[pair.between.first + i];
      by_noise += pair.between.slope[i] * pair.between.slope[i] * pair.weight.cwiseProduct(noise).sum();
    }
  }
  offset.misfit /= 6.0 * offset.readings - 7;
  const auto inverse = inverse_positive(MatX(normal));
  if (!inverse || 1 / (*inverse)(6, 6) < kAboveNoise * by_noise) return because(OffsetFailure::NotMoving);
  const Mat7 covariance = std::max(1.0, offset.misfit) * *inverse *
                          covariance_of_sum(run, link, pairs, limit, options.correlation_s) * *inverse;
  offset.sigma_s = std::sqrt(covariance(6, 6));
  offset.covariance = covariance.topLeftCorner<6, 6>();
  if (offset.sigma_s > options.max_offset_s) return because(OffsetFailure::NotMoving);
  return offset;
}

}  // namespace

Result<TimeOffset, OffsetFailure> estimate_time_offset(std::span<const TimedPose> tracked,
                                                       std::span<const PlatformReading> readings,
                                                       const TimeOffsetOptions& options) {
  const PoseCurve curve = curve_of(tracked);
  const double gate = chi_square_quantile(1 - options.gate_probability, 6);
  const Run run{curve, readings, options.largest_gap_s, gate};
  std::vector<PlatformReading> some;
  const std::size_t every = std::max<std::size_t>(1, readings.size() / kGridReadings);
  for (std::size_t k = 0; k < readings.size(); k += every) some.push_back(readings[k]);
  const std::vector<ReadOutLink> starts = starts_of({curve, some, options.largest_gap_s, gate}, options);
  if (starts.empty()) return because(OffsetFailure::TooFew);

  // At rest the search would stray: whether there is anything to find is asked first.
  if (const auto moves = with_doubt(run, starts[0], options); !moves) return moves;
  const auto best = refined(run, starts[0], options.max_offset_s);
  if (!best) return because(OffsetFailure::NotMoving);
  if (std::abs(best->latency_s) > options.max_offset_s) return because(OffsetFailure::BeyondSearch);
  const auto offset = with_doubt(run, *best, options);
  if (!offset) return offset;

  const Residuals pairs = pairs_of(run, *best);
  const double limit = limit_of(run, pairs);
  for (std::size_t i = 1; i < std::min(starts.size(), kOtherTries); ++i) {
    const auto other = refined(run, starts[i], options.max_offset_s);
    if (!other || std::abs(other->latency_s) > options.max_offset_s) continue;
    if (std::abs(other->latency_s - best->latency_s) < kGridStep_s) continue;
    const double worse = (mean_square(pairs_of(run, *other), limit) - mean_square(pairs, limit)) *
                         static_cast<double>(pairs.size());
    if (worse < kAsWell * std::max(1.0, offset->misfit)) return because(OffsetFailure::Periodic);
  }
  return offset;
}

}  // namespace asterism
