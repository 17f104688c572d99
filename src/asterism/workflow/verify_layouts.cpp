// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/verify_layouts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "asterism/core/result.hpp"
#include "asterism/evaluation/layout_trial.hpp"
#include "asterism/layout/layout_model.hpp"

namespace asterism {
namespace {

/// Evenly over the motion, the first and the last frame among them.
std::vector<double> moments_of(std::span<const double> times_s, int wanted) {
  std::vector<double> moments;
  const std::size_t count = std::min(times_s.size(), static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < count; ++i)
    moments.push_back(times_s[count == 1 ? 0 : i * (times_s.size() - 1) / (count - 1)]);
  return moments;
}

/// The present layout and those to be compared with it, completed by what the surface says of normals.
std::vector<NamedLayout> layouts_of(const Cell& cell, const Body& body, const VerifyJob& job) {
  std::vector<NamedLayout> layouts = {{"as it stands", body.targets}};
  if (job.layouts.empty()) return layouts;
  if (!cell.layout || cell.layout->body != body.name) {
    throw InputError(cell.name,
                     fmt::format("layouts of `{}` can be compared only where [layout] is about it, "
                                 "since it tells how targets face",
                                 body.name));
  }
  const LayoutModel model(cell, {});
  for (const NamedLayout& layout : job.layouts)
    layouts.push_back({layout.name, model.completed(layout.targets)});
  return layouts;
}

}  // namespace

DisturbedLayouts disturb_layouts(const Cell& cell, const VerifiedBody& body, std::span<const double> times_s,
                                 const VerifyJob& job, const Occlusion& occlusion, const Progress& progress) {
  const std::vector<NamedLayout> layouts = layouts_of(cell, cell.movers[body.mover].body, job);
  const std::vector<double> moments = moments_of(times_s, job.options.moments);
  const TrialView view{moments, job.options.visibility, accuracy_options_of(cell, job.options.level)};
  DisturbanceOptions options;
  options.runs = static_cast<std::size_t>(job.options.runs);
  options.seed = job.seed;
  options.target_loss = cell.noise.target_loss;
  DisturbedLayouts disturbed;
  for (const NamedLayout& layout : layouts) {
    disturbed.runs.push_back(
        disturb(trial_of(cell, body, layout.name, layout.targets, occlusion, view), options));
    progress("disturbance runs", disturbed.runs.size(), layouts.size());
  }
  for (const auto& [quantity, at_rest] : {std::pair(RunQuantity::RotationDeg, true),
                                          {RunQuantity::CentroidMm, true},
                                          {RunQuantity::WorstPointMm, false}}) {
    disturbed.comparisons.push_back(compare_layouts(disturbed.runs, quantity, at_rest));
  }
  return disturbed;
}

}  // namespace asterism
