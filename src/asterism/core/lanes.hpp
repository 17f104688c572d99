// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

/// A struct that holds lanes and is made outside clones must be alignas(kLanesAlignment): without AVX the
/// compiler aligns these vectors to 16 bytes only, with AVX it counts on 32.
constexpr std::size_t kLanesAlignment = 32;
using DoubleLanes = double __attribute__((vector_size(32)));
using FloatLanes = float __attribute__((vector_size(32)));
using IntLanes = int __attribute__((vector_size(32)));
/// What comparing lanes gives: all bits set where it holds.
using MaskLanes = std::int64_t __attribute__((vector_size(32)));
constexpr std::size_t kDoubleLanes = sizeof(DoubleLanes) / sizeof(double);

}  // namespace asterism
