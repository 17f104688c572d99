// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {

// The columns in which every table tells a pose and how well it is known.

/// x_mm, y_mm, z_mm, qw, qx, qy, qz. Made unit length; refused when off by more than 0.001.
[[nodiscard]] RigidMotion motion_of(const CsvTable& table, std::size_t row);
[[nodiscard]] std::string pose_cells(const RigidMotion& motion);

/// sigma_x_mm … sigma_z_mm, sigma_rx_deg … sigma_rz_deg as a diagonal covariance; empty when one is missing.
[[nodiscard]] std::optional<Mat6> covariance_of(const CsvTable& table, std::size_t row);
[[nodiscard]] std::string sigma_cells(const Mat6& covariance);

}  // namespace asterism
