// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/error_budget.hpp"

#include <cmath>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

constexpr double kStep = 0.05;          // of a sigma, to either side
constexpr int kTries = 100;             // draws without a pose before one gives up
constexpr double kDistanceCover = 0.9;  // its upper end is the 95 % quantile

Vec6 error_of(const PoseExperiment& experiment, const std::vector<double>& inputs,
              const MeansInForce& means) {
  const auto error = experiment.error(inputs, Estimator::MaximumLikelihood, 0, means);
  if (error) return *error;
  throw MeasurementError("the pose cannot be estimated from what is seen at this moment");
}

/// ∂(pose error) / ∂(each input), 6 × inputs.
MatX sensitivities(const PoseExperiment& experiment) {
  const std::size_t count = experiment.input_count();
  MatX by(6, static_cast<Eigen::Index>(count));
  parallel_for(count, [&](std::size_t i) {
    std::vector<double> inputs(count, 0.0);
    inputs[i] = kStep;
    const Vec6 above = error_of(experiment, inputs, {});
    inputs[i] = -kStep;
    by.col(static_cast<Eigen::Index>(i)) = (above - error_of(experiment, inputs, {})) / (2 * kStep);
  });
  return by;
}

/// Pose errors that each effect with a mean makes on average.
std::array<Vec6, kErrorSources> biases(const PoseExperiment& experiment) {
  const std::vector<double> none(experiment.input_count(), 0.0);
  const Vec6 base = error_of(experiment, none, {false, false, false});
  std::array<Vec6, kErrorSources> biases;
  biases.fill(Vec6::Zero());
  const auto set = [&](ErrorSource source, const MeansInForce& alone) {
    biases[static_cast<std::size_t>(source)] = error_of(experiment, none, alone) - base;
  };
  set(ErrorSource::Smear, {true, false, false});
  set(ErrorSource::Latency, {false, true, false});
  set(ErrorSource::Thermal, {false, false, true});
  return biases;
}

Mat36 point_by_pose(const PoseExperiment& experiment, const Vec3& in_body) {
  Mat36 by;
  by << -skew(experiment.truth().rotation * in_body), Mat3::Identity();
  return by;
}

Vec6 drawn_error(const PoseExperiment& experiment, RandomStream& random) {
  std::vector<double> inputs(experiment.input_count());
  for (int i = 0; i < kTries; ++i) {
    for (double& input : inputs) input = random.normal();
    const auto error = experiment.error(inputs);
    if (error) return *error;
  }
  throw MeasurementError("the pose can hardly ever be estimated from what is seen at this moment");
}

void draw(const PoseExperiment& experiment, const Vec3& in_body, const BudgetOptions& options,
          ErrorBudget& budget) {
  MonteCarloOptions drawing;
  drawing.seed = options.seed;
  drawing.most_blocks = options.most_blocks;
  budget.drawn = monte_carlo(
      [&](RandomStream& random) {
        return budget.widest.dot(experiment.at_point(drawn_error(experiment, random), in_body));
      },
      drawing);
  budget.check = check_first_order(budget.first, budget.drawn);
  drawing.coverage = kDistanceCover;
  budget.distance = monte_carlo(
      [&](RandomStream& random) {
        return experiment.at_point(drawn_error(experiment, random), in_body).norm();
      },
      drawing);
  budget.below_95_mm = budget.distance.interval.high;
}

}  // namespace

ErrorBudget first_order_budget(const PoseExperiment& experiment, const Vec3& in_body) {
  const MatX by = sensitivities(experiment);
  const std::array<Vec6, kErrorSources> bias = biases(experiment);
  const Mat36 to_point = point_by_pose(experiment, in_body);
  ErrorBudget budget;
  Mat3 at_point = Mat3::Zero();
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    const PoseExperiment::Inputs& range = experiment.inputs()[i];
    const MatX own =
        by.middleCols(static_cast<Eigen::Index>(range.first), static_cast<Eigen::Index>(range.count));
    const Mat6 covariance = own * own.transpose();
    const Mat3 there = to_point * covariance * to_point.transpose();
    budget.covariance += covariance;
    budget.bias += bias[i];
    at_point += there;
    budget.shares.push_back({range.source, std::sqrt(there.trace()), to_point * bias[i], 0});
  }
  const Vec3 whole_bias = to_point * budget.bias;
  const double square = at_point.trace() + whole_bias.squaredNorm();
  for (BudgetShare& share : budget.shares)
    share.share = (share.sigma_mm * share.sigma_mm + share.bias_mm.dot(whole_bias)) / square;
  budget.rms_mm = std::sqrt(square);
  budget.widest = symmetric_eigen(at_point).vectors.col(2);
  budget.first = {budget.widest.dot(whole_bias), std::sqrt(budget.widest.dot(at_point * budget.widest))};
  return budget;
}

ErrorBudget error_budget(const PoseExperiment& experiment, const Vec3& in_body,
                         const BudgetOptions& options) {
  ErrorBudget budget = first_order_budget(experiment, in_body);
  draw(experiment, in_body, options, budget);
  return budget;
}

}  // namespace asterism
