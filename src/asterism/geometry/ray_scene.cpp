// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "asterism/core/result.hpp"
#include "asterism/geometry/embree_scene.hpp"

namespace asterism {
namespace {

/// Embree reads a ray by fours; written one by one it would wait for each of them.
RTCRay ray_between(const Vec3& from, const Vec3& to) {
  static_assert(offsetof(RTCRay, dir_x) == 16 && offsetof(RTCRay, tfar) == 32);
  RTCRay ray;
  const Eigen::Vector3f origin = from.cast<float>(), way = (to - from).cast<float>();
  _mm_store_ps(&ray.org_x, _mm_setr_ps(origin.x(), origin.y(), origin.z(), 0));  // tnear
  _mm_store_ps(&ray.dir_x, _mm_setr_ps(way.x(), way.y(), way.z(), 0));           // time
  ray.tfar = 1;
  ray.mask = ~0U;
  ray.flags = 0;
  return ray;
}

bool is_blocked(RTCScene scene, RTCIntersectContext& context, const Vec3& from, const Vec3& to) {
  RTCRay ray = ray_between(from, to);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0;
}

constexpr std::size_t kPacket = 16;

/// Up to sixteen ways that begin at the places `which` of `from`; those of them that are blocked.
template <class Blocked>
void ask_packet(RTCScene scene, RTCIntersectContext& context, std::span<const Vec3> from,
                std::span<const std::size_t> which, const Vec3& to, const Blocked& blocked) {
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

}  // namespace

struct RayScene::Tree {
  RTCScene scene = nullptr;
  std::vector<std::size_t> surface_of;  // by Embree's number of a geometry

  explicit Tree(std::span<const TriangleMesh> surfaces) : scene(rtcNewScene(embree_device())) {
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
  const FlushDenormals flush;
  return is_blocked(tree_->scene, context, from, to);
}

void RayScene::blocked(std::span<const Vec3> from, const Vec3& to, std::span<std::uint8_t> out) const {
  require(from.size() == out.size(), "there is an answer for each way");
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const FlushDenormals flush;
  for (std::size_t i = 0; i < from.size(); ++i) {
    out[i] = is_blocked(tree_->scene, context, from[i], to) ? 1 : 0;
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
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const FlushDenormals flush;
  if (marks[0] == 0 && is_blocked(tree_->scene, context, from[0], to)) mark(0);
  std::array<std::size_t, kPacket> which{};
  std::size_t waiting = 0;
  for (std::size_t i = 1; i < from.size() && marked <= most; ++i) {
    if (marks[i] == 0) which[waiting++] = i;
    if (waiting < kPacket && i + 1 < from.size()) continue;
    if (waiting > 0) ask_packet(tree_->scene, context, from, std::span(which).first(waiting), to, mark);
    waiting = 0;
  }
  return marked;
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
