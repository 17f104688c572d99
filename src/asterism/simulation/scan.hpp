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
  std::vector<Vec3f> true_in_workpiece;  // mm: where the light truly fell; NaN for an outlier
  std::size_t grazing = 0, shadowed = 0, beyond_range = 0;  // rays that met the part and gave no point
};

/// What the cell's scanner measures of its workpiece during one pass, by casting rays: a plane of light from
/// the projector sweeps the field line by line, each line at its own moment, scanner and part both where
/// their motions put them then. A place is measured where projector and camera both see it, within range and
/// incidence; fixtures and obstacles give shadow, not points. Noise grows with depth and incidence
/// (range_noise); some points are outliers along the line of sight. The scanner sits where
/// `body_from_scanner` says, off by its own error, drawn once a seed. Throws InputError for a cell without
/// scanner or workpiece. The same points on any number of threads.
[[nodiscard]] SimulatedScan simulate_scan(const Stage& stage, const ScanPass& pass, std::uint64_t seed);

}  // namespace asterism
