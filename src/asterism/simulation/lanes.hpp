// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include "asterism/core/lanes.hpp"

namespace asterism {

constexpr int kFloatLanes = sizeof(FloatLanes) / sizeof(float);

[[nodiscard]] ASTERISM_INLINE FloatLanes lanes_from(const float* values) {
  FloatLanes lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

/// 1 / √x by Newton from the well-known start: exact to single precision after three steps.
[[nodiscard]] ASTERISM_INLINE FloatLanes inverse_root(const FloatLanes& x) {
  IntLanes bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = 0x5f3759df - (bits >> 1);
  FloatLanes root;
  std::memcpy(&root, &bits, sizeof root);
#pragma GCC unroll 3
  for (int step = 0; step < 3; ++step) root = root * (1.5F - 0.5F * x * root * root);
  return root;
}

}  // namespace asterism
