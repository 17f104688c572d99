// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/scanning/carrying.hpp"
#include "asterism/workflow/scan_source.hpp"

namespace asterism {

/// From where each scan was seen, for scans told in a frame whose origin is not the scanner (published ones
/// often are): a scanner is set before the points, along the axis that most of them face, on the side that
/// is turned away from the middle of all scans. Nothing for the others.
struct ScanViews {
  std::vector<std::optional<RigidMotion>> scanner_from_frame;
  double stand_off_mm = 0;  // of the scanners that were set; 0 = none was
  std::vector<std::string> remarks;
};
/// `frames`: where each scan's frame is on the part, where that is known.
[[nodiscard]] ScanViews views_of(const std::vector<ScanSurvey>& surveys,
                                 const std::vector<std::optional<RigidMotion>>& workpiece_from_frame);

/// The piece as that scanner sees it, normals towards it.
[[nodiscard]] Scan seen_from(const RigidMotion& scanner_from_frame, Scan piece);

}  // namespace asterism
