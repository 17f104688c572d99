// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "asterism/core/lanes.hpp"

// Vectors of 32 bytes for grey levels.

namespace asterism {

using WordLanes = std::uint64_t __attribute__((vector_size(32)));
using ByteLanes = std::uint8_t __attribute__((vector_size(32)));
using ShortLanes = std::uint16_t __attribute__((vector_size(32)));

template <class Grey>
struct LanesOf;
template <>
struct LanesOf<std::uint8_t> {
  using Type = ByteLanes;
};
template <>
struct LanesOf<std::uint16_t> {
  using Type = ShortLanes;
};
template <class Grey>
using GreyLanes = typename LanesOf<Grey>::Type;

}  // namespace asterism
