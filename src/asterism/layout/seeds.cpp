// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/seeds.hpp"

#include <algorithm>
#include <numbers>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// ln det of each pose's information; the prior alone at first.
double log_determinant(const Mat6& information) {
  const auto value = log_determinant_positive(information);
  require(value.has_value(), "a pose's information with a prior is positive definite");
  return *value;
}

struct Growth {
  std::vector<Mat6> information;  // by pose
  double sum = 0;                 // Σ ln det

  [[nodiscard]] double with(const PlaceInformation& place) const {
    double grown = 0;
    for (std::size_t k = 0; k < information.size(); ++k) grown += log_determinant(information[k] + place[k]);
    return grown;
  }
  void take(const PlaceInformation& place) {
    for (std::size_t k = 0; k < information.size(); ++k) information[k] += place[k];
    sum = 0;
    for (const Mat6& one : information) sum += log_determinant(one);
  }
};

}  // namespace

std::vector<Place> poisson_disc(const DeployableSurface& surface, double spacing_mm, double clearance_mm,
                                std::size_t most, RandomStream& random) {
  std::vector<Place> places;
  for (int misses = 0; misses < 200 && places.size() < most;) {
    const auto place = random_place(surface, clearance_mm, random);
    if (!place) break;
    const bool free = std::none_of(places.begin(), places.end(), [&](const Place& other) {
      return (other.position_mm - place->position_mm).norm() < spacing_mm;
    });
    if (free) places.push_back(*place);
    misses = free ? 0 : misses + 1;
  }
  return places;
}

std::vector<GreedyLayout> greedy_layouts(std::span<const PlaceInformation> places, const Mat6& prior,
                                         std::size_t most) {
  std::vector<GreedyLayout> layouts;
  if (places.empty()) return layouts;
  const std::size_t poses = places.front().size();
  const auto per_pose = static_cast<double>(std::max<std::size_t>(poses, 1));
  Growth growth{std::vector<Mat6>(poses, prior), 0};
  growth.sum = static_cast<double>(poses) * log_determinant(prior);
  const double start = growth.sum;

  std::vector<bool> taken(places.size());
  std::vector<std::size_t> chosen;
  for (std::size_t n = 1; n <= std::min(most, places.size()) + 1; ++n) {
    std::vector<double> gains(places.size());
    parallel_for(places.size(),
                 [&](std::size_t i) { gains[i] = taken[i] ? 0.0 : growth.with(places[i]) - growth.sum; });
    if (n > 1) {  // these gains are what is left beside the layout before
      std::vector<double> left = gains;
      std::sort(left.rbegin(), left.rend());
      GreedyLayout& before = layouts.back();
      before.upper_bound = before.gain;
      for (std::size_t i = 0; i + 1 < n && i < left.size(); ++i) before.upper_bound += left[i] / per_pose;
      const double share = before.upper_bound > 0 ? before.gain / before.upper_bound : 1.0;
      before.guaranteed = std::max(1 - 1 / std::numbers::e, share);
    }
    if (n > std::min(most, places.size())) break;
    std::size_t best = places.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!taken[i] && (best == places.size() || gains[i] > gains[best])) best = i;
    }
    taken[best] = true;
    chosen.push_back(best);
    growth.take(places[best]);
    layouts.push_back({chosen, (growth.sum - start) / per_pose, 0, 0});
  }
  return layouts;
}

}  // namespace asterism
