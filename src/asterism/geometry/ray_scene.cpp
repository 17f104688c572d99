// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

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

/// One device for the whole program; trees are built by the thread that asks for them.
RTCDevice device() {
  static const RTCDevice the_device = rtcNewDevice("threads=1,set_affinity=0");
  require(the_device != nullptr, "Embree makes a device");
  return the_device;
}

RTCRay ray_between(const Vec3& from, const Vec3& to) {
  RTCRay ray{};
  const Vec3 way = to - from;
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(way.x());
  ray.dir_y = static_cast<float>(way.y());
  ray.dir_z = static_cast<float>(way.z());
  ray.tnear = 0;
  ray.tfar = 1;
  ray.mask = ~0U;
  return ray;
}

void add_surface(RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
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

}  // namespace

struct RayScene::Tree {
  RTCScene scene = nullptr;
  std::vector<std::size_t> surface_of;  // by Embree's number of a geometry

  explicit Tree(std::span<const TriangleMesh> surfaces) : scene(rtcNewScene(device())) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (surfaces[i].empty()) continue;
      add_surface(scene, surfaces[i]);
      surface_of.push_back(i);
    }
    const FlushDenormals flush;
    rtcCommitScene(scene);
  }
  ~Tree() { rtcReleaseScene(scene); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
};

RayScene::RayScene(std::span<const TriangleMesh> surfaces) : tree_(std::make_shared<Tree>(surfaces)) {
  for (const TriangleMesh& surface : surfaces) triangles_ += surface.triangles.size();
}

bool RayScene::blocked(const Vec3& from, const Vec3& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = ray_between(from, to);
  const FlushDenormals flush;
  rtcOccluded1(tree_->scene, &context, &ray);
  return ray.tfar < 0;
}

void RayScene::blocked(std::span<const Vec3> from, const Vec3& to, std::span<std::uint8_t> out) const {
  require(from.size() == out.size(), "there is an answer for each way");
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const FlushDenormals flush;
  for (std::size_t i = 0; i < from.size(); ++i) {
    RTCRay ray = ray_between(from[i], to);
    rtcOccluded1(tree_->scene, &context, &ray);
    out[i] = ray.tfar < 0 ? 1 : 0;
  }
}

std::optional<RayHit> RayScene::first_hit(const Vec3& from, const Vec3& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit asked{};
  asked.ray = ray_between(from, to);
  asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  const FlushDenormals flush;
  rtcIntersect1(tree_->scene, &context, &asked);
  if (asked.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{tree_->surface_of[asked.hit.geomID], asked.hit.primID, static_cast<double>(asked.ray.tfar),
                Vec3(asked.hit.Ng_x, asked.hit.Ng_y, asked.hit.Ng_z).normalized()};
}

bool blocked_exactly(const TriangleMesh& surface, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3 ab = surface.corner(t, 1) - surface.corner(t, 0);
    const Vec3 ac = surface.corner(t, 2) - surface.corner(t, 0);
    const Vec3 p = way.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0) continue;
    const Vec3 s = from - surface.corner(t, 0);
    const double u = s.dot(p) / determinant;
    if (!(u >= 0 && u <= 1)) continue;
    const Vec3 q = s.cross(ab);
    const double v = way.dot(q) / determinant;
    if (!(v >= 0 && u + v <= 1)) continue;
    const double share = ac.dot(q) / determinant;
    if (share >= 0 && share <= 1) return true;
  }
  return false;
}

}  // namespace asterism
