// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"

// The parts of check_cell that have a file of their own. Each throws InputError.

namespace asterism {

/// The platform's body stays within its stroke and rates: a Sweep by each of its swings, other motion by
/// looking at it densely, as Rz(yaw) Ry(pitch) Rx(roll) and the pivot's shift from its pose at time 0.
void check_platform_motion(const Cell& cell, const std::string& where);

/// Solids have a surface of sensible size and stand on a body that is there; no target that moves with one
/// is inside it.
void check_solids(const Cell& cell, const std::string& where);

/// The scanner's distances and angles are in order, it is carried by a body that is there; passes are
/// numbered, last a while and do not overlap.
void check_scanner(const Cell& cell, const std::string& where);

/// What is asked of a plan of views: options within their limits, regions that are solids, each named once.
void check_scan_task(const Cell& cell, const std::string& where);

/// An arm has joints that turn some way about an axis, links of some thickness, and a scanner to carry.
void check_robot(const Cell& cell, const std::string& where);

/// Complains in the words of `what`: "it moves with".
void check_carrier(const std::string& body, const Cell& cell, const std::string& where, const char* what);

}  // namespace asterism
