// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/schemes.hpp"

#include <fmt/format.h>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/optimization/crowding.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"

namespace asterism {

std::array<double, 2> objectives_of(std::span<const Vec3> targets) {
  const LayoutMetrics metrics = measure_layout(targets);
  return {metrics.mean_distance_to_origin_mm, -metrics.pair_distance_sum_mm};
}

std::vector<Scheme> rank_schemes(std::vector<Scheme> schemes) {
  std::vector<double> objectives;
  for (Scheme& scheme : schemes) {
    const auto [f1, f2] = objectives_of(scheme.targets);
    scheme.f1_mm = f1;
    scheme.coverage_mm = -f2;
    objectives.insert(objectives.end(), {f1, f2});
  }
  const std::vector<int> ranks = non_dominated_ranks(objectives, 2);
  for (int rank = 0; rank < static_cast<int>(schemes.size()); ++rank) {
    std::vector<int> front;
    for (std::size_t s = 0; s < schemes.size(); ++s) {
      schemes[s].rank = ranks[s];
      if (ranks[s] == rank) front.push_back(static_cast<int>(s));
    }
    if (front.empty()) continue;
    std::vector<double> crowding(front.size());
    crowding_distances(objectives, 2, front, crowding);
    for (std::size_t i = 0; i < front.size(); ++i) {
      schemes[static_cast<std::size_t>(front[i])].crowding = crowding[i];
    }
  }
  return schemes;
}

std::vector<Scheme> schemes_of_table9() {
  std::vector<Scheme> schemes;
  for (const PublishedLayout& layout : paper_table9()) {
    schemes.push_back({fmt::format("S{}", schemes.size() + 1), layout.targets, 0, 0, 0, 0});
  }
  return rank_schemes(std::move(schemes));
}

}  // namespace asterism
