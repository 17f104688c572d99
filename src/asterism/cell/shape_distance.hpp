// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/shape.hpp"

namespace asterism {

/// Distance of a point from a solid, mm; negative inside.
[[nodiscard]] double distance_from(const Shape& shape, const Vec3& in_shape);

}  // namespace asterism
