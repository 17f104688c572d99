// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

constexpr std::size_t kPacket = 16;
constexpr double kRoundingMm = 0.01;  // more than single precision moves anything in a cell

/// Up to sixteen ways that begin at the places `which` of `from`; those of them that are blocked.
template <class Blocked>
void ask_packet(RTCScene scene, std::span<const Vec3> from, std::span<const std::size_t> which,
                const Vec3& to, const Blocked& blocked) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) RTCRay16 rays;
  alignas(64) std::array<int, kPacket> valid;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool asked = i < which.size();
    const RTCRay ray = ray_between(from[which[asked ? i : 0]], to);
    valid[i] = asked ? -1 : 0;
    rays.org_x[i] = ray.org_x;
    rays.org_y[i] = ray.org_y;
    rays.org_z[i] = ray.org_z;
    rays.dir_x[i] = ray.dir_x;
    rays.dir_y[i] = ray.dir_y;
    rays.dir_z[i] = ray.dir_z;
    rays.tnear[i] = 0;
    rays.tfar[i] = 1;
    rays.time[i] = 0;
    rays.mask[i] = ~0U;
    rays.flags[i] = 0;
  }
  rtcOccluded16(valid.data(), scene, &context, &rays);
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (rays.tfar[i] < 0) blocked(which[i]);
  }
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
  lowest_.setConstant(std::numeric_limits<double>::infinity());
  highest_ = -lowest_;
  for (const TriangleMesh& surface : surfaces) {
    triangles_ += surface.triangles.size();
    if (surface.empty()) continue;
    for (const Vec3& vertex : surface.vertices) {
      lowest_ = lowest_.cwiseMin(vertex);
      highest_ = highest_.cwiseMax(vertex);
    }
  }
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

std::size_t RayScene::block_bundle(std::span<const Vec3> from, const Vec3& to, std::size_t most,
                                   std::span<std::uint8_t> marks) const {
  require(from.size() == marks.size(), "there is a mark for each way");
  std::size_t marked = 0;
  for (const std::uint8_t mark : marks) marked += mark;
  if (from.empty() || marked > most) return marked;
  const auto mark = [&](std::size_t way) {
    marks[way] = 1;
    ++marked;
  };
  if (marks[0] == 0 && blocked(from[0], to)) mark(0);

  const FlushDenormals flush;
  std::array<std::size_t, kPacket> which{};
  std::size_t waiting = 0;
  for (std::size_t i = 1; i < from.size() && marked <= most; ++i) {
    if (marks[i] == 0) which[waiting++] = i;
    if (waiting < kPacket && i + 1 < from.size()) continue;
    if (waiting > 0) ask_packet(tree_->scene, from, std::span(which).first(waiting), to, mark);
    waiting = 0;
  }
  return marked;
}

bool RayScene::out_of_reach(const Vec3& from, const Vec3& to, double beside_mm) const {
  if (empty()) return true;
  const double beside = beside_mm + kRoundingMm;
  double enters = 0, leaves = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = lowest_(axis) - beside - from(axis), high = highest_(axis) + beside - from(axis);
    const double way = to(axis) - from(axis);
    if (way == 0) {
      if (low > 0 || high < 0) return true;
      continue;
    }
    const double a = low / way, b = high / way;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters > leaves;
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
