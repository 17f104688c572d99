// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/cell/scan_task.hpp"
#include "asterism/measurement/scan.hpp"
#include "asterism/simulation/stage.hpp"

namespace asterism {

/// A scan with what is true of each of its points.
struct SimulatedScan {
  Scan scan;
  std::vector<Vec3f> true_in_workpiece;  // mm: where the light truly fell
  std::vector<std::uint8_t> outlier;     // 1: the point is off along its line of sight by more than noise
  // Rays that met the part and gave no point:
  std::size_t grazing = 0;       // too oblique, or lost by chance since nearly so
  std::size_t shadowed = 0;      // something stands in the light's way or in the camera's view
  std::size_t beyond_range = 0;  // nearer or farther than the scanner measures, or beside its field
};

/// What the cell's scanner measures of its workpiece during one pass, by casting rays: a plane of light from
/// the projector sweeps the field line by line, each line at its own moment, scanner and part both where
/// their motions put them then; sweep follows sweep while the pass lasts. A place is measured where projector
/// and camera both see it, within range, field and incidence; fixtures and obstacles give shadow, not points,
/// and what the scanner itself carries does not stand in its way. From the good incidence θg to the largest
/// θm points are lost with the probability ((θ − θg)/(θm − θg))². Noise is range_noise's, along x, y and z;
/// outliers lie off along the line of sight, evenly up to outlier_mm to either side. No normals: scanners
/// mostly give none.
///
/// The scanner sits at true_body_from_scanner. Throws InputError for a cell without scanner or workpiece. The
/// same points on any number of threads.
[[nodiscard]] SimulatedScan simulate_scan(const Stage& stage, const ScanPass& pass, std::uint64_t seed);

/// Where the scanner truly sits on its body: `body_from_scanner` is what hand–eye calibration found, and off
/// by place_sigma_mm and place_sigma_deg along and about each axis, drawn once a seed.
[[nodiscard]] RigidMotion true_body_from_scanner(const Scanner& scanner, std::uint64_t seed);

}  // namespace asterism
