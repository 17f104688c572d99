// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/chain_errors.hpp"

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/evaluation/layout_trial.hpp"
#include "asterism/evaluation/read_out_errors.hpp"
#include "asterism/evaluation/simulated_accuracy.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/reproduction/chain_cell.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

PoseExperiment experiment_of(const PublishedLayout& layout) {
  Cell cell = chain_cell(chain_targets(layout.targets));
  cell.noise = {};
  const VerifiedBody body = verification_of(cell);
  TrialView view;
  view.visibility.max_incidence_deg = kChainAcceptanceDeg;
  view.noise.sigma_px = kChainSigmaPx;
  return trial_of(cell, body, layout.name, cell.movers.front().body.targets, Occlusion(cell), view).at_rest;
}

/// Detection alone: rig and targets are exact, and nothing moves.
PoseErrorSample sample_of(const PoseExperiment& experiment, const Vec3& centroid, Estimator estimator,
                          std::size_t runs, std::uint64_t seed, std::uint64_t first) {
  PoseErrorSample sample;
  for (std::size_t run = 0; run < runs; ++run) {
    const auto error = experiment.error(inputs_of_run(experiment, seed, first + run, 0), estimator, 0,
                                        {false, false, false});
    if (!error) throw MeasurementError("a disturbed pose at rest came to nothing");
    sample.rotation_deg.push_back(deg_from_rad(error->head<3>().norm()));
    sample.translation_mm.push_back(experiment.at_point(*error, centroid).norm());
  }
  return sample;
}

Expected expected_of(const std::vector<double>& values) {
  const Summary summary = summarize(values);
  return {summary.mean, summary.deviation};
}

ExpectedErrors expect_of(const PublishedLayout& layout, Estimator estimator, std::size_t experiments,
                         std::uint64_t seed) {
  constexpr std::size_t kRuns = 50;
  const PoseExperiment experiment = experiment_of(layout);
  const Vec3 centroid = centroid_of(layout.targets);
  std::vector<Summary> rotation(experiments), translation(experiments);
  parallel_for(experiments, [&](std::size_t e) {
    const PoseErrorSample sample = sample_of(experiment, centroid, estimator, kRuns, seed, e * kRuns);
    rotation[e] = summarize(sample.rotation_deg);
    translation[e] = summarize(sample.translation_mm);
  });
  const auto over = [](const std::vector<Summary>& of, double Summary::*value) {
    std::vector<double> values;
    for (const Summary& one : of) values.push_back(one.*value);
    return expected_of(values);
  };
  return {over(rotation, &Summary::mean), over(rotation, &Summary::highest),
          over(translation, &Summary::mean), over(translation, &Summary::highest)};
}

}  // namespace

std::vector<ExpectedErrors> expect_chain_errors(Estimator estimator, std::size_t experiments,
                                                std::uint64_t seed) {
  std::vector<ExpectedErrors> expected;
  for (const PublishedLayout& layout : paper_table1())
    expected.push_back(expect_of(layout, estimator, experiments, seed));
  return expected;
}

std::vector<PoseErrorSample> chain_sample(Estimator estimator, std::size_t runs, std::uint64_t seed) {
  std::vector<PoseErrorSample> samples;
  for (const PublishedLayout& layout : paper_table1()) {
    samples.push_back(
        sample_of(experiment_of(layout), centroid_of(layout.targets), estimator, runs, seed, 0));
  }
  return samples;
}

ChainTrace chain_trace(std::uint64_t seed) {
  Cell cell = chain_cell(chain_targets(paper_table1().front().targets));
  ChainTrace trace;
  const ReadOutErrors read_out = read_out_errors(cell, {}, seed);
  trace.read_out_deg = read_out.rotation_deg;
  trace.read_out_mm = read_out.translation_mm;
  SimulatedRunOptions options;
  options.simulation.level = SimulationLevel::Centres;
  options.simulation.sigma_px = kChainSigmaPx;
  options.simulation.seed = seed;
  const Belief belief = exact_belief(cell);
  const std::size_t platform = 0;
  const auto run = simulate_and_track(cell, std::span(&belief, 1), platform, options, no_progress).front();
  const Vec3 centroid = centroid_of(paper_table1().front().targets);
  for (std::size_t i = 0; i < run.size(); ++i) {
    trace.times_s.push_back(static_cast<double>(i) / cell.timing.rate_hz);
    if (!run[i].error) {
      ++trace.without_pose;
      continue;
    }
    trace.with_times_s.push_back(trace.times_s.back());
    trace.with_deg.push_back(deg_from_rad(run[i].error->head<3>().norm()));
    trace.with_mm.push_back(error_at(run[i], centroid).norm());
  }
  return trace;
}

}  // namespace asterism
