// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/shape.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

bool extends(const Box& box) { return box.size_mm.allFinite() && box.size_mm.minCoeff() > 0; }
bool extends(const Capsule& capsule) {
  return capsule.from_mm.allFinite() && capsule.to_mm.allFinite() && capsule.radius_mm > 0 &&
         std::isfinite(capsule.radius_mm);
}
bool extends(const Frustum& cone) {
  return cone.height_mm > 0 && std::min(cone.bottom_radius_mm, cone.top_radius_mm) >= 0 &&
         std::max(cone.bottom_radius_mm, cone.top_radius_mm) > 0;
}

}  // namespace

bool has_extent(const Shape& shape) {
  return std::visit([](const auto& one) { return extends(one); }, shape);
}

}  // namespace asterism
