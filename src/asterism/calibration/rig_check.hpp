// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// A known length seen once.
struct LengthObservation {
  std::string name;
  double time_s = 0;
  double known_mm = 0;
  Vec3 a, b;                        // its ends in the tracker's frame, mm
  Mat3 a_covariance, b_covariance;  // mm²
};

/// How far the two sight lines of a target were from meeting, once.
struct EpipolarObservation {
  double time_s = 0;
  Vec2 left_px;
  double error_px = 0;  // signed
};

struct RigCheckOptions {
  double max_scale_ppm = 100;     // of a rig that is still good
  double max_epipolar_px = 0.15;  // systematic part, anywhere in the image
};
void describe(RigCheckOptions& options, OptionVisitor& visit);

struct LengthSummary {
  std::string name;
  int count = 0;
  double known_mm = 0, bias_mm = 0, rms_mm = 0, worst_mm = 0;
  double rms_of_sigma = 0;  // errors over their stated sigmas; about 1 when those are honest
};

/// One of 3 × 3 regions of the left image.
struct RegionSummary {
  int column = 0, row = 0, count = 0;
  double mean_px = 0, sigma_px = 0;  // of the epipolar error's mean
};

enum class RigVerdict { Good, Doubtful, Bad };

struct RigCheck {
  std::vector<LengthSummary> lengths;
  double scale_ppm = 0, scale_sigma_ppm = 0;  // measured over known − 1, from all lengths
  double bias_mm = 0, length_rms_mm = 0;
  double depth_ppm_per_m = 0, depth_sigma_ppm_per_m = 0;  // how the scale changes with distance
  double epipolar_mean_px = 0, epipolar_rms_px = 0;
  double drift_px = 0, drift_sigma_px = 0;  // change of the epipolar error from first to last moment
  std::vector<RegionSummary> regions;
  RigVerdict verdict = RigVerdict::Good;
  std::vector<std::string> reasons;  // the verdict in words
};

/// Is this rig still good? Sigmas come from the scatter, not from what was promised. Doubtful = a limit is
/// passed, but not by three sigmas, or there is too little to tell; Bad = passed by more.
/// Throws MeasurementError when there is no length at all.
[[nodiscard]] RigCheck check_rig(const std::vector<LengthObservation>& lengths,
                                 const std::vector<EpipolarObservation>& epipolar, int width_px,
                                 int height_px, const RigCheckOptions& options);

}  // namespace asterism
