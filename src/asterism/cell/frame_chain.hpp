// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/cell/cell.hpp"

namespace asterism {

/// The measurement frames of the paper (Eqs. 19–22, Fig. 11) at one moment: O_c `tracker`, O_p `platform`,
/// O_g `workpiece`, O_s `scanner`, O_1 `target_centroid`. What the cell does not have is left out.
///
///   workpiece_from_scanner = (tracker_from_platform · platform_from_workpiece)⁻¹ · tracker_from_scanner
struct FrameChain {
  std::optional<RigidMotion> tracker_from_platform;          // T_cp, measured by the platform's targets
  std::optional<RigidMotion> platform_from_target_centroid;  // fixed: from the layout (Eqs. 14–17)
  std::optional<RigidMotion> platform_from_workpiece;        // fixed: from alignment
  std::optional<RigidMotion> tracker_from_scanner;           // T_cs, measured by the scanner's targets
  std::optional<RigidMotion> workpiece_from_scanner;         // what carries a scan into the part's frame
};
[[nodiscard]] FrameChain frame_chain_at(const Cell& cell, double time_s);

}  // namespace asterism
