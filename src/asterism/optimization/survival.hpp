// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/optimization/crowding.hpp"
#include "asterism/optimization/front_thinning.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"
#include "asterism/optimization/reference_points.hpp"
#include "asterism/optimization/surface_thinning.hpp"

namespace asterism {

/// How the front that does not fit wholly is thinned.
enum class Survival {
  Automatic,                // by hypervolume for two and three objectives, by reference points from four on
  Crowding,                 // largest crowding distance (Deb et al. 2002, the paper's)
  HypervolumeContribution,  // the smallest contribution goes first, one after another
  ReferencePoints,          // NSGA-III (Deb & Jain 2014)
};

/// Parents and children together; flat arrays in one order.
struct Contenders {
  std::span<const double> objectives;        // count × m, row-major, finite
  std::size_t m = 0;                         // objectives, all minimised
  std::span<const double> violations = {};   // total normalised violation, 0 = feasible; empty: all feasible
  std::span<const std::size_t> niches = {};  // who competes with whom; empty: everybody
};

/// One that lives on, and what a tournament needs: the lower rank wins, then the larger spread.
struct Survivor {
  std::uint32_t index;  // among the contenders
  int rank;             // 0 = first front of its niche; infeasible ones rank behind, by violation
  double spread;        // crowding distance or hypervolume contribution, 0 with reference points
};

/// Chooses who lives on: feasible ones front by front, the first front that does not fit thinned as
/// `Survival` says, then infeasible ones by violation. Each niche gets an equal share of the places; what a
/// niche cannot fill goes to the others. Its memory is reused from call to call.
class SurvivorSelection {
 public:
  explicit SurvivorSelection(Survival survival = Survival::Automatic) : survival_(survival) {}

  /// The `wanted` (or all, if fewer) survivors: niche after niche, rank after rank, then in lexicographic
  /// order of their objectives. Valid until the next call.
  std::span<const Survivor> operator()(const Contenders& contenders, std::size_t wanted);

 private:
  void share_places(const Contenders& contenders, std::size_t wanted);
  void select_in_niche(const Contenders& contenders, std::span<const std::uint32_t> niche,
                       std::size_t places);
  void select_feasible(std::span<const double> objectives, std::size_t m, std::size_t places);
  void thin_by_reference_points(std::span<const double> objectives, std::size_t m, std::size_t rank,
                                std::size_t places, std::size_t wanted);
  void thin_by_crowding(std::span<const double> objectives, std::size_t m,
                        std::span<const std::uint32_t> front, int rank, std::size_t places);
  void thin_by_hypervolume(std::span<const double> objectives, std::size_t m,
                           std::span<const std::uint32_t> front, int rank, std::size_t places);
  void thin_surface(std::span<const double> objectives, std::span<const std::uint32_t> front, int rank,
                    std::size_t places);

  Survival survival_;
  std::vector<Survivor> survivors_;
  struct Niche {
    std::size_t name, first, last, places;
  };
  std::vector<Niche> niches_;
  std::vector<std::uint32_t> members_;  // of all niches, niche after niche
  std::vector<std::uint32_t> feasible_, infeasible_;
  std::vector<double> feasible_objectives_;
  std::vector<double> x_, y_, surface_;
  std::vector<std::uint32_t> by_distance_;
  NonDominatedSort sort_;
  CrowdingDistance crowding_;
  FrontThinning thinning_;
  SurfaceThinning surface_thinning_;
  ReferencePointNiching niching_;
};

}  // namespace asterism
