// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/estimator_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/evaluation/verified_body.hpp"

namespace asterism {
namespace {

/// A trial's determined moments with their bounds.
struct Bounded {
  std::vector<std::size_t> moments;
  std::vector<Mat6> bounds;
  std::size_t worst_point = 0;
  std::array<double, kRunQuantities> rms{};  // of the bound over the moments
};

Bounded bounded(const Cell& cell, const LayoutTrial& trial, const AccuracyOptions& noise) {
  Bounded found;
  for (std::size_t m = 0; m < trial.moments.size(); ++m) {
    const PoseExperiment& moment = trial.moments[m];
    std::vector<Target> exact(moment.targets().begin(), moment.targets().end());
    for (Target& target : exact) target.covariance.reset();
    StereoRig rig = cell.rig;
    rig.covariance.resize(0, 0);
    const auto bound = predict_pose_accuracy(exact, moment.seen(), moment.truth(), rig, noise);
    if (!bound) continue;
    found.moments.push_back(m);
    found.bounds.push_back(bound->covariance);
  }
  const auto mean_square = [&](std::size_t point) {
    double sum = 0;
    for (std::size_t i = 0; i < found.moments.size(); ++i) {
      sum += covariance_of_point(trial.moments[found.moments[i]].truth(), found.bounds[i],
                                 trial.points[point].in_body_mm)
                 .trace();
    }
    return sum / static_cast<double>(found.moments.size());
  };
  if (found.moments.empty()) return found;
  const std::size_t first = trial.points.size() > VerifiedBody::kFirstNamed ? VerifiedBody::kFirstNamed : 0;
  found.worst_point = first;
  for (std::size_t i = first; i < trial.points.size(); ++i) {
    if (mean_square(i) > mean_square(found.worst_point)) found.worst_point = i;
  }
  double turning = 0;
  for (const Mat6& bound : found.bounds) turning += bound.topLeftCorner<3, 3>().trace();
  found.rms = {deg_from_rad(std::sqrt(turning / static_cast<double>(found.bounds.size()))),
               std::sqrt(mean_square(VerifiedBody::kCentroid)), std::sqrt(mean_square(VerifiedBody::kOrigin)),
               std::sqrt(mean_square(found.worst_point))};
  return found;
}

std::optional<RunErrors> errors_of(const LayoutTrial& trial, const Bounded& of, std::size_t moment,
                                   std::size_t run, Estimator estimator, std::uint64_t seed) {
  const PoseExperiment& experiment = trial.moments[moment];
  std::vector<double> inputs = inputs_of_run(experiment, seed, run, moment);
  for (const PoseExperiment::Inputs& range : experiment.inputs()) {
    if (range.source == ErrorSource::Detection) continue;
    const auto begin = inputs.begin() + static_cast<std::ptrdiff_t>(range.first);
    std::fill(begin, begin + static_cast<std::ptrdiff_t>(range.count), 0.0);
  }
  const auto error = experiment.error(inputs, estimator, 0, {false, false, false});
  if (!error) return std::nullopt;
  const auto at = [&](std::size_t point) {
    return experiment.at_point(*error, trial.points[point].in_body_mm).norm();
  };
  return RunErrors{deg_from_rad(error->head<3>().norm()), at(VerifiedBody::kCentroid),
                   at(VerifiedBody::kOrigin), at(of.worst_point)};
}

EstimatorRow row_of(const LayoutTrial& trial, const Bounded& of, Estimator estimator,
                    const EstimatorDraws& draws) {
  std::vector<std::optional<RunErrors>> all(draws.runs * of.moments.size());
  parallel_for(draws.runs, [&](std::size_t run) {
    for (std::size_t i = 0; i < of.moments.size(); ++i)
      all[run * of.moments.size() + i] = errors_of(trial, of, of.moments[i], run, estimator, draws.seed);
  });
  EstimatorRow row{trial.name, estimator, {}, trial.points[of.worst_point].name, 0, 0};
  for (const auto& errors : all) {
    ++(errors ? row.poses : row.failed);
    for (std::size_t i = 0; errors && i < kRunQuantities; ++i) {
      row.errors[i].mean += (*errors)[i];
      row.errors[i].rms += (*errors)[i] * (*errors)[i];
      row.errors[i].max = std::max(row.errors[i].max, (*errors)[i]);
    }
  }
  for (std::size_t i = 0; i < kRunQuantities; ++i) {
    EstimatorErrors& errors = row.errors[i];
    errors.bound = of.rms[i];
    if (row.poses == 0) continue;
    errors.mean /= static_cast<double>(row.poses);
    errors.rms = std::sqrt(errors.rms / static_cast<double>(row.poses));
  }
  return row;
}

}  // namespace

std::vector<EstimatorRow> compare_estimators(const Cell& cell, std::span<const LayoutTrial> trials,
                                             std::span<const Estimator> estimators,
                                             const AccuracyOptions& noise, const EstimatorDraws& draws) {
  std::vector<EstimatorRow> rows;
  for (const LayoutTrial& trial : trials) {
    const Bounded of = bounded(cell, trial, noise);
    if (of.moments.empty()) continue;
    for (const Estimator estimator : estimators) rows.push_back(row_of(trial, of, estimator, draws));
  }
  return rows;
}

}  // namespace asterism
