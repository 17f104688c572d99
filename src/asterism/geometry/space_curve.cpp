// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/space_curve.hpp"

#include <algorithm>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kLastCell = 1023;

/// Every third bit of a number of ten bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x030000FFU;
  bits = (bits | bits << 8) & 0x0300F00FU;
  bits = (bits | bits << 4) & 0x030C30C3U;
  return (bits | bits << 2) & 0x09249249U;
}

}  // namespace

std::vector<std::uint32_t> order_along_curve(std::span<const Vec3> places, const Vec3& lowest,
                                             double edge_mm) {
  require(edge_mm > 0, "a cube has an edge");
  std::vector<std::uint64_t> keys(places.size());  // the cell along the curve, then the place's number
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = kLastCell * (places[i](axis) - lowest(axis)) / edge_mm;
      // Written so that what is not a number comes to 0.
      code |= spread(cell > 0 ? static_cast<std::uint64_t>(std::min(cell, kLastCell)) : 0U) << axis;
    }
    keys[i] = code << 32 | i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(places.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
  return order;
}

}  // namespace asterism
