// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/layout_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

enum Purpose : std::uint32_t { kGreedyPlaces = 11, kPoissonSeeds };

constexpr double kNoErrorMm = 1e6;    // stands for an error that has no value; such layouts are infeasible
constexpr int kPoissonSeedsEach = 2;  // for each number of targets
constexpr double kCut = 0.3;          // share of children by a cut through space

// Of the table of shadows: a second or two to make, which a search of 25,000 layouts hardly feels.
constexpr std::size_t kPlacePoses = 3200000, kFewestPlaces = 500, kMostPlaces = 16000;

bool fits(std::span<const Vec3> layout, const LayoutRules& rules) {
  const auto count = static_cast<int>(layout.size());
  if (count < rules.fewest || count > rules.most) return false;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if ((nearest_place(rules.surface, layout[i]).position_mm - layout[i]).norm() > 1e-6) return false;
    if (kept_out(rules.surface, layout[i], rules.clearance_mm)) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if ((layout[i] - layout[j]).norm() < rules.spacing_mm) return false;
    }
  }
  return true;
}

/// No layout can show more targets than it has, so fewer need not be tried.
std::optional<std::string> raise_fewest(LayoutModel& model) {
  const auto needed = static_cast<int>(std::ceil(model.bound_on(Q::Visible)));
  if (needed <= model.rules.fewest) return std::nullopt;
  if (needed > model.rules.most) {
    throw InputError("layout task",
                     fmt::format("{} targets must be visible, but `most` is {}: allow more targets, or lower "
                                 "`losses` or the bound on `visible`",
                                 needed, model.rules.most));
  }
  const int asked = model.rules.fewest;
  model.rules.fewest = needed;
  return fmt::format(
      "layouts of fewer than {} targets, down to the {} allowed, cannot show {} and are not tried", needed,
      asked, needed);
}

Mat6 broad_prior() {
  Vec6 weights;
  weights << Vec3::Constant(1.0), Vec3::Constant(1e-6);  // 1 rad, 1 m
  return weights.asDiagonal();
}

}  // namespace

LayoutProblem::LayoutProblem(const Cell& cell, const DesignerOptions& options) {
  auto model = std::make_unique<LayoutModel>(cell, options);
  warnings_ = warnings_about(model->objectives);
  for (const auto& warning : {raise_fewest(*model), check_room(*model), check_sight(*model)}) {
    if (warning) warnings_.push_back(*warning);
  }
  RandomStream random(0, 0, kGreedyPlaces);
  greedy_places_ = poisson_disc(model->rules.surface, model->rules.spacing_mm, model->rules.clearance_mm,
                                static_cast<std::size_t>(options.places), random);
  greedy_ = greedy_layouts(information_of(*model, greedy_places_), broad_prior(),
                           static_cast<std::size_t>(model->rules.most));

  bool identifiability_is_objective = false;
  for (const Q quantity : model->objectives) {
    wanted_[static_cast<std::size_t>(quantity)] = true;
    identifiability_is_objective = identifiability_is_objective || quantity == Q::Identifiability;
  }
  for (const LayoutConstraint& constraint : model->constraints) {
    wanted_[static_cast<std::size_t>(constraint.quantity)] = true;
  }
  identifiability_cap_mm_ = model->bound_on(Q::Identifiability);
  if (identifiability_is_objective) {
    identifiability_cap_mm_ = std::max(identifiability_cap_mm_, options.identifiability_cap_mm);
  }
  VariationOptions variation;
  variation.mutations = 1;
  variation_ = Variation(variation);
  shadows_ = std::make_unique<Shadows>(
      model->rules.surface, model->task.diameter_mm, model->occlusion, model->carrier, model->cell_poses,
      std::clamp(kPlacePoses / static_cast<std::size_t>(model->task.poses), kFewestPlaces, kMostPlaces));
  model_ = std::move(model);
}

std::vector<ObjectiveInfo> LayoutProblem::objectives() const {
  std::vector<ObjectiveInfo> objectives;
  for (const Q quantity : model_->objectives) {
    const LayoutQuantityInfo& info = info_of(quantity);
    objectives.push_back({(info.more_is_better ? "-" : "") + info.name, info.unit});
  }
  return objectives;
}

std::vector<ConstraintInfo> LayoutProblem::constraints() const {
  std::vector<ConstraintInfo> constraints;
  for (const LayoutConstraint& constraint : model_->constraints) {
    const LayoutQuantityInfo& info = info_of(constraint.quantity);
    constraints.push_back(
        {fmt::format("{} {} {}", info.name, info.more_is_better ? ">=" : "<=", constraint.bound), info.unit,
         info.scale});
  }
  constraints.push_back({"errors that have a value", "errors", 1.0});
  return constraints;
}

Genes LayoutProblem::sample(RandomStream& random) const {
  const LayoutRules& rules = model_->rules;
  const auto choices = static_cast<std::uint32_t>(rules.most - rules.fewest + 1);
  const std::size_t count = static_cast<std::size_t>(rules.fewest) + random.below(choices);
  std::vector<Vec3> layout;
  for (const Place& place :
       poisson_disc(rules.surface, rules.spacing_mm, rules.clearance_mm, count, random)) {
    layout.push_back(place.position_mm);
  }
  repair(layout, rules, random);
  return genes_of(layout);
}

std::vector<Genes> LayoutProblem::seeds() const {
  const LayoutRules& rules = model_->rules;
  std::vector<std::vector<Vec3>> layouts;
  const std::vector<Vec3> present = positions_of(model_->present);
  if (fits(present, rules)) layouts.push_back(present);
  if (model_->options.published_seeds) {
    for (const auto* table : {&paper_table1(), &paper_table9()}) {
      for (const PublishedLayout& published : *table) {
        if (fits(published.targets, rules)) layouts.push_back(published.targets);
      }
    }
  }
  for (const GreedyLayout& greedy : greedy_) {
    if (static_cast<int>(greedy.places.size()) < rules.fewest) continue;
    std::vector<Vec3> layout;
    for (const std::size_t place : greedy.places) layout.push_back(greedy_places_[place].position_mm);
    layouts.push_back(layout);
  }
  for (int count = rules.fewest; count <= rules.most; ++count) {
    for (int again = 0; again < kPoissonSeedsEach; ++again) {
      RandomStream random(static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(again),
                          kPoissonSeeds);
      std::vector<Vec3> layout;
      // As wide apart as so many are likely to stand.
      for (double spacing = 8 * rules.spacing_mm; static_cast<int>(layout.size()) < count; spacing *= 0.8) {
        layout.clear();
        const double at_least = std::max(spacing, rules.spacing_mm);
        for (const Place& place : poisson_disc(rules.surface, at_least, rules.clearance_mm,
                                               static_cast<std::size_t>(count), random)) {
          layout.push_back(place.position_mm);
        }
        if (at_least > spacing) break;
      }
      repair(layout, rules, random);
      layouts.push_back(layout);
    }
  }
  std::vector<Genes> seeds;
  for (std::vector<Vec3>& layout : layouts) {
    put_in_order(layout);
    Genes genes = genes_of(layout);
    if (std::find(seeds.begin(), seeds.end(), genes) == seeds.end()) seeds.push_back(std::move(genes));
  }
  return seeds;
}

void LayoutProblem::vary(std::span<const double> mother, std::span<const double> father, Genes& daughter,
                         Genes& son, RandomStream& random) const {
  const std::vector<Vec3> her = positions_of(mother);
  const std::vector<Vec3> his = positions_of(father);
  std::vector<Vec3> girl, boy;
  if (random.uniform() < kCut) {
    cut_and_join(her, his, girl, boy, random);
  } else {
    cross_matched(her, his, model_->bounds, variation_, girl, boy, random);
  }
  for (std::vector<Vec3>* child : {&girl, &boy}) {
    mutate(*child, model_->rules, model_->bounds, variation_, LayoutMutation{}, random);
    repair(*child, model_->rules, random);
  }
  daughter = genes_of(girl);
  son = genes_of(boy);
}

void LayoutProblem::evaluate(std::span<const double> genes, std::span<double> objectives,
                             std::span<double> violations) const {
  const std::vector<Target> targets = model_->targets_at(positions_of(genes));
  const LayoutModel& m = *model_;
  MotionVisibility seen =
      shadows_->unhidden_of(visible_targets(targets, m.motion, m.volume, m.options.visibility), targets);
  tell(m.values(targets, std::move(seen), wanted_, identifiability_cap_mm_), objectives, violations);
}

void LayoutProblem::evaluate_exactly(std::span<const double> genes, std::span<double> objectives,
                                     std::span<double> violations) const {
  const std::vector<Target> targets = model_->targets_at(positions_of(genes));
  tell(model_->values(targets, wanted_, identifiability_cap_mm_), objectives, violations);
}

void LayoutProblem::tell(const LayoutValues& values, std::span<double> objectives,
                         std::span<double> violations) const {
  double without_value = 0;
  for (std::size_t i = 0; i < model_->objectives.size(); ++i) {
    const Q quantity = model_->objectives[i];
    const auto& value = values[quantity];
    if (!value) without_value += 1;
    objectives[i] = value ? (info_of(quantity).more_is_better ? -*value : *value) : kNoErrorMm;
  }
  for (std::size_t i = 0; i < model_->constraints.size(); ++i) {
    const LayoutConstraint& constraint = model_->constraints[i];
    const auto& value = values[constraint.quantity];
    if (!value) without_value += 1;
    violations[i] = value ? violation_of(constraint, *value) : 0.0;
  }
  violations[model_->constraints.size()] = without_value;
}

std::size_t LayoutProblem::niche_of(std::span<const double> genes) const {
  const auto& asked = model_->objectives;
  return std::find(asked.begin(), asked.end(), Q::Targets) != asked.end() ? genes.size() / 3 : 0;
}

}  // namespace asterism
