// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

// Errors of a pose from disturbed targets: the paper's 50 disturbance simulations (Tables 13 and 14,
// Figures 21 to 24). Rotation in deg, translation in mm at the targets' centroid.

namespace asterism {

struct PoseErrorSample {
  std::vector<double> rotation_deg, translation_mm;
};

/// Least-squares pose (Eq. 18) of targets each disturbed by isotropic noise.
[[nodiscard]] PoseErrorSample disturb_isotropic(std::span<const Vec3> targets, double sigma_mm,
                                                std::size_t runs, std::uint64_t seed,
                                                std::uint64_t experiment);

/// The same end to end: the targets' images in the two cameras of papers_cell.hpp disturbed by `sigma_px`,
/// triangulated, and the pose fitted. Throws MeasurementError when a target is outside the images.
[[nodiscard]] PoseErrorSample disturb_images(std::span<const Vec3> targets, double sigma_px, std::size_t runs,
                                             std::uint64_t seed, std::uint64_t experiment);

/// RMS rotation error to first order, deg: σ √tr A⁻¹ with A = Σ (|r|² I − r rᵀ).
[[nodiscard]] double rms_rotation_deg(std::span<const Vec3> targets, double sigma_mm);

/// What one experiment of several runs gives on average, and how much that varies between experiments.
struct Expected {
  double mean = 0, deviation = 0;
};
struct ExpectedErrors {
  Expected mean_rotation_deg, max_rotation_deg, mean_translation_mm, max_translation_mm;
};

enum class Disturbance { Isotropic, Images };

/// Over `experiments` experiments of `runs` runs each; `sigma` in mm or px.
[[nodiscard]] ExpectedErrors expect_errors(std::span<const Vec3> targets, Disturbance disturbance,
                                           double sigma, std::size_t runs, std::size_t experiments,
                                           std::uint64_t seed);

}  // namespace asterism
