// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/disturbance_runs.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/evaluation/verified_body.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPurpose = 0x72756e00;  // and the source of errors
constexpr std::uint32_t kLoss = 0x6c6f7374;
constexpr std::uint64_t kMoments = 1024;  // more than anybody asks for
constexpr std::uint64_t kAtRest = kMoments - 1;

/// What differs from moment to moment; the rest stays for a whole run.
bool is_of_moment(ErrorSource source) {
  return source == ErrorSource::Detection || source == ErrorSource::Smear;
}

TargetMask lost_targets(const PoseExperiment& experiment, const DisturbanceOptions& options,
                        std::uint64_t run, std::uint64_t moment) {
  if (!(options.target_loss > 0)) return 0;
  RandomStream random(options.seed, run * kMoments + moment, kLoss);
  TargetMask lost = 0;
  for (std::size_t i = 0; i < experiment.targets().size(); ++i) {
    if (random.uniform() < options.target_loss) lost |= TargetMask{1} << i;
  }
  return lost;
}

std::optional<RunErrors> errors_at(const PoseExperiment& experiment, const LayoutTrial& trial,
                                   const DisturbanceOptions& options, std::uint64_t run,
                                   std::uint64_t moment) {
  const std::vector<double> inputs = inputs_of_run(experiment, options.seed, run, moment);
  const auto error =
      experiment.error(inputs, options.estimator, lost_targets(experiment, options, run, moment));
  if (!error) return std::nullopt;
  const auto at = [&](std::size_t point) {
    return experiment.at_point(*error, trial.points[point].in_body_mm).norm();
  };
  RunErrors errors{deg_from_rad(error->head<3>().norm()), at(VerifiedBody::kCentroid),
                   at(VerifiedBody::kOrigin), 0};
  const std::size_t first = trial.points.size() > VerifiedBody::kFirstNamed ? VerifiedBody::kFirstNamed : 0;
  for (std::size_t i = first; i < trial.points.size(); ++i) errors[3] = std::max(errors[3], at(i));
  return errors;
}

}  // namespace

std::string_view text_of(RunQuantity quantity) {
  static constexpr std::array<std::string_view, kRunQuantities> kWords = {
      "rotation", "translation at the target centroid", "translation at the body's origin",
      "translation at the worst point"};
  return kWords[static_cast<std::size_t>(quantity)];
}

std::vector<double> inputs_of_run(const PoseExperiment& experiment, std::uint64_t seed, std::uint64_t run,
                                  std::uint64_t moment) {
  std::vector<double> inputs(experiment.input_count());
  for (const PoseExperiment::Inputs& range : experiment.inputs()) {
    const std::uint64_t index = is_of_moment(range.source) ? run * kMoments + moment : run;
    RandomStream random(seed, index, kPurpose + static_cast<std::uint32_t>(range.source));
    for (std::size_t i = 0; i < range.count; ++i) inputs[range.first + i] = random.normal();
  }
  return inputs;
}

LayoutRuns disturb(const LayoutTrial& trial, const DisturbanceOptions& options) {
  require(trial.moments.size() < kAtRest, "a run has fewer than 1023 moments");
  LayoutRuns runs{trial.name, {}, {}, options.runs * trial.moments.size(), 0};
  runs.at_rest.resize(options.runs);
  runs.moving.resize(options.runs);
  std::vector<std::size_t> without(options.runs, 0);
  parallel_for(options.runs, [&](std::size_t run) {
    runs.at_rest[run] = errors_at(trial.at_rest, trial, options, run, kAtRest);
    RunErrors squares{};
    for (std::size_t moment = 0; moment < trial.moments.size(); ++moment) {
      const auto errors = errors_at(trial.moments[moment], trial, options, run, moment);
      without[run] += errors ? 0 : 1;
      if (!errors) continue;
      for (std::size_t i = 0; i < kRunQuantities; ++i) squares[i] += (*errors)[i] * (*errors)[i];
    }
    const std::size_t found = trial.moments.size() - without[run];
    if (found == 0) return;
    for (double& square : squares) square = std::sqrt(square / static_cast<double>(found));
    runs.moving[run] = squares;
  });
  for (const std::size_t lost : without) runs.without_pose += lost;
  return runs;
}

}  // namespace asterism
