// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// Places in the order of a curve through a cube (Morton's): neighbours along it are neighbours in space. The
/// cube begins at `lowest`; its edge is cut into 1024, places outside belong to its rim, and those of one
/// cell keep their order.
[[nodiscard]] std::vector<std::uint32_t> order_along_curve(std::span<const Vec3> places, const Vec3& lowest,
                                                           double edge_mm);

}  // namespace asterism
