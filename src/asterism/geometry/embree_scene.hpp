// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include "asterism/geometry/triangle_mesh.hpp"

// What the files of this room that use Embree share; no header of another room includes it.

namespace asterism {

/// Embree asks for flush-to-zero; the caller's own arithmetic gets its mode back.
class FlushDenormals {
 public:
  FlushDenormals() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_;
};

/// One device for the whole program. Its number of threads is left alone: Embree would hold every parallel
/// loop of the process to it.
[[nodiscard]] RTCDevice embree_device();

/// Adds a surface that has triangles to a scene that is not yet committed; single precision.
void add_surface(RTCScene scene, const TriangleMesh& mesh);

}  // namespace asterism
