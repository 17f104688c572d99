// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/layout/paper_layouts.hpp"
#include "asterism/optimization/real_problem.hpp"

namespace asterism::bench {

/// The paper's problem of Section 4.2: four targets, x and y within ±700 mm, z within 580 to 620 mm; least
/// mean distance to the origin against the largest sum of pair distances. The schemes of Table 9 are known.
class FourTargets final : public RealProblem {
 public:
  FourTargets() : RealProblem(four_times({-700, -700, 580}), four_times({700, 700, 620})) {}

  [[nodiscard]] std::string identity() const override { return "four targets"; }
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override {
    return {{"mean distance to the origin", "mm"}, {"minus the sum of pair distances", "mm"}};
  }
  [[nodiscard]] std::vector<Genes> seeds() const override {
    std::vector<Genes> seeds;
    for (const PublishedLayout& layout : paper_table9()) {
      seeds.emplace_back();
      for (const Vec3& target : layout.targets)
        seeds.back().insert(seeds.back().end(), target.begin(), target.end());
    }
    return seeds;
  }
  void evaluate(std::span<const double> genes, std::span<double> objectives,
                std::span<double>) const override {
    objectives[0] = objectives[1] = 0;
    for (std::size_t i = 0; i < genes.size(); i += 3) {
      const Vec3 here(genes[i], genes[i + 1], genes[i + 2]);
      objectives[0] += here.norm() / 4;
      for (std::size_t j = i + 3; j < genes.size(); j += 3)
        objectives[1] -= (here - Vec3(genes[j], genes[j + 1], genes[j + 2])).norm();
    }
  }

 private:
  static std::vector<double> four_times(const std::vector<double>& bound) {
    std::vector<double> bounds;
    for (int i = 0; i < 4; ++i) bounds.insert(bounds.end(), bound.begin(), bound.end());
    return bounds;
  }
};

}  // namespace asterism::bench
