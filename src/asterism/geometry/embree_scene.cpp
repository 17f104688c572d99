// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/embree_scene.hpp"

#include "asterism/core/result.hpp"

namespace asterism {

RTCDevice embree_device() {
  static const RTCDevice the_device = rtcNewDevice("set_affinity=0");
  require(the_device != nullptr, "Embree makes a device");
  return the_device;
}

void add_surface(RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* places = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Vec3& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) *places++ = static_cast<float>(vertex(axis));
  }
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) *corners++ = corner;
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace asterism
