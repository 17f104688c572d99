// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/congruence_margin.hpp"
#include "asterism/tracking/identification_assignment.hpp"
#include "asterism/tracking/identification_search.hpp"

namespace asterism {
namespace {

std::vector<int> targets_of(std::span<const Correspondence> labels) {
  std::vector<int> targets;
  for (const auto& label : labels) targets.push_back(label.pattern);
  return targets;
}

/// The margin below which noise as large as this frame's could favour a wrong labelling: above it, the best
/// wrong one is expected to be `decisive` worse in χ².
double margin_needed(const Labelling& labelling, const PointScene& scene, double decisive) {
  double variance = 0;
  for (const auto& label : labelling.labels) {
    variance += scene.points[static_cast<std::size_t>(label.scene)].covariance.trace() / 3.0;
  }
  const auto count = static_cast<double>(labelling.labels.size());
  const double scale = std::max(1.0, labelling.fit.chi_square / (3.0 * count - 6.0));
  return std::sqrt(decisive * scale * variance) / count;
}

/// Does the prior rule out every wrong labelling that the layout alone does not?
bool is_settled_by_priors(const Labelling& labelling, double needed_mm, const PointScene& scene,
                          const BodyCatalogue& catalogue, const IdentificationOptions& options,
                          std::span<const std::optional<PriorPose>> priors) {
  if (!labelling.near_prior || labelling.prior_gain < options.decisive_chi_square) return false;
  const auto body = static_cast<std::size_t>(labelling.body);
  const std::vector<int> right = targets_of(labelling.labels);
  std::vector<Vec3> seen;
  for (const int target : right)
    seen.push_back(catalogue.targets(body)[static_cast<std::size_t>(target)].position);
  for (std::size_t other = 0; other < catalogue.bodies().size(); ++other) {
    std::vector<Vec3> pattern;
    for (const auto& target : catalogue.targets(other)) pattern.push_back(target.position);
    const auto wrong = wrong_labellings_within(
        seen, pattern, other == body ? std::span<const int>(right) : std::span<const int>(), needed_mm);
    if (!wrong.complete) return false;
    for (const auto& rival : wrong.found) {
      std::vector<Correspondence> labels = labelling.labels;
      for (std::size_t i = 0; i < labels.size(); ++i) labels[i].pattern = rival.label[i];
      const auto fit = fit_labels(labels, catalogue.targets(other), scene.points);
      if (fit && prior_gain(*fit, priors[other]) > labelling.prior_gain - options.decisive_chi_square)
        return false;
    }
  }
  return true;
}

/// What is told of a choice; refitted when contested labels were left out.
std::optional<BodyLabels> report(const Choice& choice, const LabellingSearch& search, const PointScene& scene,
                                 const BodyCatalogue& catalogue, const IdentificationOptions& options,
                                 std::span<const std::optional<PriorPose>> priors) {
  const Labelling& whole = search.labellings[choice.labelling];
  if (!is_evident(whole, catalogue, options)) return std::nullopt;
  const auto body = static_cast<std::size_t>(whole.body);
  const auto prior = priors.empty() ? std::optional<PriorPose>() : priors[body];
  BodyLabels told{whole.body, choice.status, {}, {}, 0, 0};
  if (!search.complete[body] || !whole.decided) told.status = LabelStatus::Ambiguous;

  Labelling kept = whole;
  if (told.status == LabelStatus::Ok && choice.certain.size() < whole.labels.size()) {
    const auto certain =
        labelling_of(whole.body, choice.certain, choice.certain.size(), scene, catalogue, options, prior);
    if (certain && is_evident(*certain, catalogue, options)) {
      kept = *certain;
    } else {
      told.status = LabelStatus::Ambiguous;
    }
  }
  for (const auto& label : kept.labels) told.points.push_back({label.scene, label.pattern});
  told.tracker_from_body = kept.fit.tracker_from_body;
  told.rms_mm = kept.fit.rms_mm;
  told.margin_mm = catalogue.margin_mm(body, targets_of(kept.labels));
  const double needed_mm = margin_needed(kept, scene, options.decisive_chi_square);
  if (told.status == LabelStatus::Ok && told.margin_mm < needed_mm &&
      !is_settled_by_priors(kept, needed_mm, scene, catalogue, options, priors)) {
    told.status = LabelStatus::Ambiguous;
  }
  if (choice.rival_rms_mm && told.status == LabelStatus::Ambiguous) {
    told.margin_mm = std::min(told.margin_mm, std::max(0.0, *choice.rival_rms_mm - told.rms_mm));
  }
  return told;
}

}  // namespace

void describe(IdentificationOptions& options, OptionVisitor& visit) {
  visit.number("sigma_floor_mm", options.sigma_floor_mm, {0, 100},
               "added in quadrature to each point: what of points and bodies nobody stated");
  visit.number("default_sigma_mm", options.default_sigma_mm, {1e-6, 100},
               "per axis, of points whose covariance is not known");
  visit.number("gate_sigma", options.gate_sigma, {1, 20},
               "how far pair distances may differ, in standard deviations");
  visit.number("fit_sigma", options.fit_sigma, {1, 20},
               "how rare a rigid fit may be, in standard deviations");
  visit.number("decisive_chi_square", options.decisive_chi_square, {0, 1e4},
               "how much better than any other a labelling must be, as -2 ln of the odds");
  visit.number("max_accidental", options.max_accidental, {0, 1},
               "how many accidental fits as good may be expected in a frame");
  visit.number("max_rotation_sigma_deg", options.max_rotation_sigma_deg, {0.001, 90},
               "labels that leave the attitude less certain than this fix no pose");
  visit.integer("min_targets", options.min_targets, {3, 1000},
                "fewest labelled targets without a prior pose");
  visit.integer("max_points", options.max_points, {3, 1000000},
                "with more points than this, only bodies with a prior pose are sought");
  visit.number("margin_cap_mm", options.margin_cap_mm, {0, 1e6}, "margins above this are given as this");
}

std::vector<BodyLabels> identify(std::span<const Point> points, const BodyCatalogue& catalogue,
                                 const IdentificationOptions& options,
                                 std::span<const std::optional<PriorPose>> priors) {
  require(priors.empty() || priors.size() == catalogue.bodies().size(),
          "priors are given for every body or none");
  const PointScene scene = scene_of(points, options);
  if (scene.points.size() < 3) return {};
  const LabellingSearch search = find_labellings(scene, catalogue, options, priors);
  const auto choices =
      choose_disjoint(search.labellings, scene.claims, catalogue.bodies().size(), options.decisive_chi_square,
                      static_cast<std::size_t>(options.min_targets));
  std::vector<BodyLabels> found;
  for (const Choice& choice : choices) {
    auto told = report(choice, search, scene, catalogue, options, priors);
    if (told) found.push_back(std::move(*told));
  }
  return found;
}

}  // namespace asterism
