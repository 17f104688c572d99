// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/layout/surface.hpp"

namespace asterism {

/// Places drawn at random so that no two are nearer than `spacing_mm`, at most `most` (dart throwing until
/// 200 darts in a row miss).
[[nodiscard]] std::vector<Place> poisson_disc(const DeployableSurface& surface, double spacing_mm,
                                              double clearance_mm, std::size_t most, RandomStream& random);

/// Information on the pose (ω, δ) that a target at a place gives: one 6 × 6 a pose, zero where it is not
/// seen.
using PlaceInformation = std::vector<Mat6>;

/// A layout of n places chosen one after the other, each the one that adds most to
///   f(S) = mean over poses of ln det(I₀ + Σ_{i ∈ S} Iᵢ) − ln det I₀,
/// which is monotone and submodular; so f is at least 1 − 1/e of the best of all choices of n places
/// (Nemhauser, Wolsey & Fisher 1978).
struct GreedyLayout {
  std::vector<std::size_t> places;
  double gain = 0;         // f, nats a pose
  double upper_bound = 0;  // no choice of n of these places gives more: f(S) + the n largest gains left
  double guaranteed = 0;   // gain as a share of the best is at least this: max(1 − 1/e, gain / upper_bound)
};

/// Greedy layouts of 1 … `most` places; [n − 1] has n. `prior` is I₀ (positive definite).
[[nodiscard]] std::vector<GreedyLayout> greedy_layouts(std::span<const PlaceInformation> places,
                                                       const Mat6& prior, std::size_t most);

}  // namespace asterism
