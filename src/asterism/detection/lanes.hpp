// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Vectors of 32 bytes in the compilers' own notation, and functions compiled for two processors.

// ASTERISM_CLONES: compile a function also for x86-64-v3 (AVX2) and choose at run time. Without contraction
// to fused multiply-add both give the same bits. Sanitizers and clang get the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(ASTERISM_NO_CLONES)
#define ASTERISM_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ASTERISM_CLONES
#endif
#define ASTERISM_INLINE inline __attribute__((always_inline))

namespace asterism {

using FloatLanes = float __attribute__((vector_size(32)));
using IntLanes = int __attribute__((vector_size(32)));
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
