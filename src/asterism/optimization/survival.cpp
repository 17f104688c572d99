// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/survival.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "asterism/core/result.hpp"
#include "asterism/optimization/hypervolume.hpp"

namespace asterism {
namespace {

// Thinning a surface takes quadratic time; beyond this size crowding, which then has enough neighbours to
// judge by, must do.
constexpr std::size_t kLargestSurface = 2000;

Survival resolved(Survival survival, std::size_t m) {
  if (survival == Survival::HypervolumeContribution && (m < 2 || m > 3))
    throw InputError(
        fmt::format("survival: hypervolume contributions are known for two and three objectives, not for {}; "
                    "take automatic, reference points or crowding",
                    m));
  if (survival != Survival::Automatic) return survival;
  if (m == 1) return Survival::Crowding;
  return m <= 3 ? Survival::HypervolumeContribution : Survival::ReferencePoints;
}

}  // namespace

std::span<const Survivor> SurvivorSelection::operator()(const Contenders& contenders, std::size_t wanted) {
  require(contenders.m > 0 && contenders.objectives.size() % contenders.m == 0,
          "objectives are count × m numbers");
  const std::size_t count = contenders.objectives.size() / contenders.m;
  require(contenders.violations.empty() || contenders.violations.size() == count,
          "each contender has its violation");
  require(contenders.niches.empty() || contenders.niches.size() == count, "each contender has its niche");
  survivors_.clear();
  share_places(contenders, std::min(wanted, count));
  for (const Niche& niche : niches_)
    select_in_niche(contenders, std::span(members_).subspan(niche.first, niche.last - niche.first),
                    niche.places);
  return survivors_;
}

/// Lists the niches by name and hands out the places: smallest niches first, each an equal share of what is
/// left, so that what one cannot fill goes to the larger ones.
void SurvivorSelection::share_places(const Contenders& contenders, std::size_t wanted) {
  const std::size_t count = contenders.objectives.size() / contenders.m;
  members_.resize(count);
  std::iota(members_.begin(), members_.end(), 0U);
  niches_.clear();
  if (contenders.niches.empty()) {
    niches_.push_back({0, 0, count, wanted});
    return;
  }
  std::ranges::stable_sort(members_, {}, [&](std::uint32_t i) { return contenders.niches[i]; });
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t name = contenders.niches[members_[i]];
    if (niches_.empty() || niches_.back().name != name) niches_.push_back({name, i, i, 0});
    ++niches_.back().last;
  }
  std::ranges::sort(niches_, {}, [](const Niche& n) { return std::pair(n.last - n.first, n.name); });
  std::size_t left = wanted;
  for (std::size_t i = 0; i < niches_.size(); ++i) {
    niches_[i].places = std::min(niches_[i].last - niches_[i].first, left / (niches_.size() - i));
    left -= niches_[i].places;
  }
  std::ranges::sort(niches_, {}, &Niche::name);
}

void SurvivorSelection::select_in_niche(const Contenders& contenders, std::span<const std::uint32_t> niche,
                                        std::size_t places) {
  feasible_.clear();
  infeasible_.clear();
  for (const std::uint32_t i : niche)
    (contenders.violations.empty() || contenders.violations[i] <= 0 ? feasible_ : infeasible_).push_back(i);

  const std::size_t m = contenders.m;
  const std::size_t first = survivors_.size();
  if (feasible_.size() * m == contenders.objectives.size()) {
    select_feasible(contenders.objectives, m, places);
  } else {
    feasible_objectives_.clear();
    for (const std::uint32_t i : feasible_)
      for (std::size_t k = 0; k < m; ++k) feasible_objectives_.push_back(contenders.objectives[i * m + k]);
    select_feasible(feasible_objectives_, m, std::min(places, feasible_.size()));
    for (Survivor& survivor : std::span(survivors_).subspan(first))
      survivor.index = feasible_[survivor.index];
  }

  places -= survivors_.size() - first;
  if (places == 0) return;
  const auto violation = [&](std::uint32_t i) { return contenders.violations[i]; };
  std::ranges::sort(infeasible_, {}, [&](std::uint32_t i) { return std::pair(violation(i), i); });
  int rank = feasible_.empty() ? 0 : static_cast<int>(sort_.fronts().count());
  for (std::size_t i = 0; i < places; ++i) {
    if (i > 0 && violation(infeasible_[i]) != violation(infeasible_[i - 1])) ++rank;
    survivors_.push_back({infeasible_[i], rank, 0});
  }
}

/// Indices written are those of `objectives`.
void SurvivorSelection::select_feasible(std::span<const double> objectives, std::size_t m,
                                        std::size_t places) {
  const Fronts& fronts = sort_(objectives, m);
  const Survival survival = resolved(survival_, m);
  for (std::size_t k = 0, left = places; k < fronts.count() && left > 0; ++k) {
    const auto front = fronts.front(k);
    const std::size_t kept = std::min(left, front.size());
    const bool too_large = m == 3 && front.size() > kLargestSurface;
    if (survival == Survival::ReferencePoints)
      thin_by_reference_points(objectives, m, k, kept, places);
    else if (survival == Survival::HypervolumeContribution && !too_large)
      thin_by_hypervolume(objectives, m, front, static_cast<int>(k), kept);
    else
      thin_by_crowding(objectives, m, front, static_cast<int>(k), kept);
    left -= kept;
  }
}

/// Who survives is all that reference points tell: tournaments within a rank are draws.
void SurvivorSelection::thin_by_reference_points(std::span<const double> objectives, std::size_t m,
                                                 std::size_t rank, std::size_t places, std::size_t wanted) {
  const auto front = sort_.fronts().front(rank);
  const auto add = [&](std::uint32_t i) { survivors_.push_back({i, static_cast<int>(rank), 0}); };
  if (places == front.size())
    std::ranges::for_each(front, add);
  else
    for (const std::uint32_t at : niching_(objectives, m, sort_.fronts(), rank, places, wanted))
      add(front[at]);
}

void SurvivorSelection::thin_by_crowding(std::span<const double> objectives, std::size_t m,
                                         std::span<const std::uint32_t> front, int rank, std::size_t places) {
  const auto distance = crowding_(objectives, m, front);
  by_distance_.resize(front.size());
  std::iota(by_distance_.begin(), by_distance_.end(), 0U);
  if (places < front.size()) {
    std::ranges::nth_element(by_distance_, by_distance_.begin() + static_cast<std::ptrdiff_t>(places), {},
                             [&](std::uint32_t at) { return std::pair(-distance[at], at); });
    by_distance_.resize(places);
    std::ranges::sort(by_distance_);
  }
  for (const std::uint32_t at : by_distance_) survivors_.push_back({front[at], rank, distance[at]});
}

void SurvivorSelection::thin_by_hypervolume(std::span<const double> objectives, std::size_t m,
                                            std::span<const std::uint32_t> front, int rank,
                                            std::size_t places) {
  if (m == 3) return thin_surface(objectives, front, rank, places);
  x_.resize(front.size());
  y_.resize(front.size());
  for (std::size_t i = 0; i < front.size(); ++i) {
    x_[i] = objectives[front[i] * m];
    y_[i] = objectives[front[i] * m + 1];
  }
  const auto kept = thinning_(x_, y_, places);
  for (std::size_t i = 0; i < kept.size(); ++i)
    survivors_.push_back({front[kept[i]], rank, thinning_.contributions()[i]});
}

/// Volumes reach a tenth of the front's extent beyond its worst values.
void SurvivorSelection::thin_surface(std::span<const double> objectives, std::span<const std::uint32_t> front,
                                     int rank, std::size_t places) {
  surface_.clear();
  std::array<double, 3> least, most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (const std::uint32_t i : front)
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = objectives[3 * i + k];
      surface_.push_back(value);
      least[k] = std::min(least[k], value);
      most[k] = std::max(most[k], value);
    }
  std::array<double, 3> reference;
  for (std::size_t k = 0; k < 3; ++k)
    reference[k] = most[k] + (most[k] > least[k] ? 0.1 * (most[k] - least[k]) : 1.0);

  const auto kept = surface_thinning_(surface_, places, reference);
  for (std::size_t i = 0; i < places; ++i)  // positions ascend, so nothing is overwritten before it moves
    std::copy_n(surface_.begin() + 3 * static_cast<std::ptrdiff_t>(kept[i]), 3,
                surface_.begin() + 3 * static_cast<std::ptrdiff_t>(i));
  const auto shares = hypervolume_contributions(std::span(surface_).first(3 * places), 3, reference);
  for (std::size_t i = 0; i < places; ++i) survivors_.push_back({front[kept[i]], rank, shares[i]});
}

}  // namespace asterism
