// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asterism/layout/layout_model.hpp"
#include "asterism/layout/shadows.hpp"
#include "asterism/optimization/problem.hpp"

namespace asterism {

/// Where to put the targets of a cell's layout task, as an optimisation problem. Genes are x, y, z (mm, in
/// the body's frame) of each target. Niches are the numbers of targets where `targets` is an objective.
/// What solids hide is looked up in a table (Shadows) that errs on the safe side; evaluate_exactly asks every
/// line of sight, in several times the time. Where no solid can hide anything both are the same.
class LayoutProblem : public OptimizationProblem {
 public:
  /// Throws InputError when the cell has no layout task, its body is not there, the surface cannot hold
  /// `fewest` targets at the spacing, or in some pose no place of the surface is seen by both cameras; the
  /// message says which pose and why.
  LayoutProblem(const Cell& cell, const DesignerOptions& options);

  [[nodiscard]] std::string identity() const override;
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override;
  [[nodiscard]] std::vector<ConstraintInfo> constraints() const override;
  [[nodiscard]] Genes sample(RandomStream& random) const override;
  [[nodiscard]] std::vector<Genes> seeds() const override;
  void vary(std::span<const double> mother, std::span<const double> father, Genes& daughter, Genes& son,
            RandomStream& random) const override;
  void evaluate(std::span<const double> genes, std::span<double> objectives,
                std::span<double> violations) const override;
  void evaluate_exactly(std::span<const double> genes, std::span<double> objectives,
                        std::span<double> violations) const;
  [[nodiscard]] std::size_t niche_of(std::span<const double> genes) const override;

  /// With normals and diameters.
  [[nodiscard]] std::vector<Target> targets_of(std::span<const double> genes) const {
    return model_->targets_at(positions_of(genes));
  }
  [[nodiscard]] const LayoutModel& model() const { return *model_; }
  [[nodiscard]] const Shadows& shadows() const { return *shadows_; }
  [[nodiscard]] const std::vector<GreedyLayout>& greedy() const { return greedy_; }
  [[nodiscard]] const std::vector<Place>& greedy_places() const { return greedy_places_; }
  /// Of what was lowered or left out to make the task possible, and of objectives that do not conflict.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void tell(const LayoutValues& values, std::span<double> objectives, std::span<double> violations) const;

  std::unique_ptr<const LayoutModel> model_;
  std::unique_ptr<const Shadows> shadows_;
  std::vector<std::string> warnings_;
  std::vector<Place> greedy_places_;
  std::vector<GreedyLayout> greedy_;
  Variation variation_;
  QuantitySet wanted_{};
  double identifiability_cap_mm_ = 0;
};

}  // namespace asterism
