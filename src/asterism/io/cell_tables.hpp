// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "asterism/cell/cell.hpp"
#include "asterism/io/cell_section.hpp"

// The tables of a cell file, one reader each; [layout] and [tracker.volume] are in cell_layout.hpp. For .cpp
// files only.

namespace asterism {

/// What poses may refer to: the rig, and where the bodies given before are at rest.
struct Places {
  StereoRig rig;
  std::vector<std::pair<std::string, RigidMotion>> rest;
};

[[nodiscard]] StereoRig rig_of_section(const CellSection& section);

/// In the tracker's frame, in that of a body `in` rest, or `seen_at_mm` by the cameras.
[[nodiscard]] RigidMotion pose_of(const CellSection& section, const Places& places);
/// The `pose` of what `body` carries, in that body's frame; of what none carries (an empty name) as pose_of
/// has it. The identity when it is not told.
[[nodiscard]] RigidMotion pose_on(const std::string& body, const CellSection& section, const Places& places);

[[nodiscard]] Motion motion_of(const CellSection& section, const std::string& body, const Places& places);
/// Adds where the body is at rest to `places`.
[[nodiscard]] Mover mover_of(const CellSection& section, Places& places);

[[nodiscard]] Obstacle obstacle_of(const CellSection& section, const Places& places);
/// Carried by `platform` unless its `body` says otherwise.
[[nodiscard]] Solid workpiece_of(const CellSection& section, const std::string& platform,
                                 const Places& places);
[[nodiscard]] Solid fixture_of(const CellSection& section, const Places& places);

[[nodiscard]] Platform platform_of(const CellSection& section);
[[nodiscard]] Scanner scanner_of(const CellSection& section);
[[nodiscard]] ScanPass scan_pass_of(const CellSection& section);
[[nodiscard]] TargetFault fault_of(const CellSection& section);
[[nodiscard]] Lamp lamp_of(const CellSection& section);
[[nodiscard]] Verification verification_of(const CellSection& section);
[[nodiscard]] std::vector<WorkPoint> points_of(const CellSection& section);

}  // namespace asterism
