// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Points spread evenly over the unit disc (sunflower).
Vec2 spread_point(int i, int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double radius = std::sqrt((i + 0.5) / count);
  return {radius * std::cos(i * golden), radius * std::sin(i * golden)};
}

}  // namespace

/// Where the rays of a target begin, in its carrier's frame. What has no normal or no diameter is a point,
/// which stands proud towards the camera when there is no normal either.
struct Occlusion::Face {
  Vec3 middle, normal;
  double radius_mm;
  std::vector<Vec3> starts;
};

void describe(OcclusionOptions& options, OptionVisitor& visit) {
  visit.integer("rays", options.rays, {1, 4096}, "lines of sight asked, spread evenly over a target's disc");
  visit.number("least_share", options.least_share, {0, 1}, "of the disc that must be free to count as seen");
  visit.number("proud_mm", options.proud_mm, {0, 100},
               "how far a target's face stands before the surface that carries it");
}

Occlusion::Occlusion(const Cell& cell, const OcclusionOptions& options) : rig_(cell.rig), options_(options) {
  OcclusionOptions copy = options;
  LimitsCheck limits;
  describe(copy, limits);
  std::vector<Occluder> occluders = occluders_of(cell);
  std::vector<int> carriers;
  for (const Occluder& occluder : occluders) {
    names_.push_back(occluder.name);
    if (occluder.surface.empty()) continue;
    if (std::find(carriers.begin(), carriers.end(), occluder.carrier) == carriers.end()) {
      carriers.push_back(occluder.carrier);
    }
  }
  for (const int carrier : carriers) {
    std::vector<std::size_t> members;
    std::vector<Slabs> slabs;
    std::vector<TriangleMesh> surfaces;
    for (std::size_t i = 0; i < occluders.size(); ++i) {
      if (occluders[i].carrier != carrier || occluders[i].surface.empty()) continue;
      members.push_back(i);
      slabs.push_back(slabs_of(occluders[i].surface));
      surfaces.push_back(std::move(occluders[i].surface));
    }
    groups_.push_back({carrier, members, slabs, RayScene(surfaces)});
  }
}

Occlusion::Face Occlusion::face_of(const Target& target, const Vec3& normal) const {
  Face face{target.position + options_.proud_mm * normal, normal, target.imaged_radius_mm(), {}};
  if (face.radius_mm == 0) {
    face.starts = {face.middle};
    return face;
  }
  const Vec3 across = face.radius_mm * normal.unitOrthogonal();
  const Vec3 along = normal.cross(across);
  for (int i = 0; i < options_.rays; ++i) {
    const Vec2 at = spread_point(i, options_.rays);
    face.starts.emplace_back(face.middle + at.x() * across + at.y() * along);
  }
  return face;
}

Occlusion::Face Occlusion::face_before(const Target& target, const Vec3& eye_in_carrier) const {
  return face_of(target,
                 target.normal ? *target.normal : Vec3((eye_in_carrier - target.position).normalized()));
}

/// A camera and all groups as they stand before one carrier's targets.
struct Occlusion::View {
  struct Before {
    const Group* group;
    bool moves_with_targets;
    RigidMotion group_from_carrier;
    Vec3 eye;  // in the group's frame

    [[nodiscard]] Vec3 in_group(const Vec3& in_carrier) const {
      return moves_with_targets ? in_carrier : Vec3(group_from_carrier * in_carrier);
    }
    /// The first solid that its slabs do not show to be out of the way; none when all are.
    [[nodiscard]] std::optional<std::size_t> in_reach(const Face& face) const {
      const Vec3 middle = in_group(face.middle);
      const Vec3 normal = moves_with_targets ? face.normal : Vec3(group_from_carrier.rotation * face.normal);
      for (std::size_t i = 0; i < group->slabs.size(); ++i) {
        if (!out_of_reach(group->slabs[i], middle, normal, face.radius_mm, eye)) return group->members[i];
      }
      return std::nullopt;
    }
  };
  Vec3 eye;  // in the carrier's frame
  std::vector<Before> groups;
};

Occlusion::View Occlusion::view(std::size_t carrier, std::span<const RigidMotion> tracker_from_mover,
                                Side side) const {
  require(carrier < tracker_from_mover.size(), "each mover of the cell has a pose");
  const Vec3 eye = rig_.camera_from_tracker(side).inverse().translation;
  View view{tracker_from_mover[carrier].inverse() * eye, {}};
  for (const Group& group : groups_) {
    const RigidMotion group_from_tracker =
        group.carrier < 0 ? RigidMotion{}
                          : tracker_from_mover[static_cast<std::size_t>(group.carrier)].inverse();
    view.groups.push_back({&group, group.carrier == static_cast<int>(carrier),
                           group_from_tracker * tracker_from_mover[carrier], group_from_tracker * eye});
  }
  return view;
}

/// How many of a face's rays are blocked; where it is more than `most`, it may be more than is told.
std::size_t Occlusion::blocked(const Face& face, const View& view, std::size_t most) const {
  std::vector<std::uint8_t> marks(face.starts.size());
  std::vector<Vec3> moved;
  std::size_t marked = 0;
  for (const View::Before& before : view.groups) {
    const RayScene& tree = before.group->tree;
    if (!before.in_reach(face)) continue;
    if (before.moves_with_targets) {
      marked = tree.block_bundle(face.starts, before.eye, most, marks);
    } else {
      moved.clear();
      for (const Vec3& start : face.starts) moved.push_back(before.in_group(start));
      marked = tree.block_bundle(moved, before.eye, most, marks);
    }
    if (marked > most) break;
  }
  return marked;
}

/// So many of a target's rays may end at something.
std::size_t Occlusion::most_blocked(const Face& face) const {
  const auto rays = static_cast<double>(face.starts.size());
  return static_cast<std::size_t>(std::floor((1.0 - options_.least_share) * rays + 1e-9));
}

double Occlusion::free_share(const Target& target, std::size_t carrier,
                             std::span<const RigidMotion> tracker_from_mover, Side side) const {
  const View from = view(carrier, tracker_from_mover, side);
  const Face face = face_before(target, from.eye);
  const std::size_t all = face.starts.size();
  return 1.0 - static_cast<double>(blocked(face, from, all)) / static_cast<double>(all);
}

std::optional<std::size_t> Occlusion::hidden_by(const Target& target, std::size_t carrier,
                                                std::span<const RigidMotion> tracker_from_mover,
                                                Side side) const {
  const View from = view(carrier, tracker_from_mover, side);
  const Face face = face_before(target, from.eye);
  const std::size_t most = most_blocked(face);
  if (blocked(face, from, most) <= most) return std::nullopt;
  // Rays that graze an edge may be blocked in a bundle and free alone: then a solid that is near is named.
  std::vector<std::size_t> rays_of(names_.size());
  std::optional<std::size_t> near;
  for (const View::Before& before : from.groups) {
    if (!near) near = before.in_reach(face);
  }
  for (const Vec3& start : face.starts) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t solid = 0;
    for (const View::Before& before : from.groups) {
      const auto hit = before.group->tree.first_hit(before.in_group(start), before.eye);
      if (!hit || hit->share >= nearest) continue;
      nearest = hit->share;
      solid = before.group->members[hit->surface];
    }
    if (std::isfinite(nearest)) ++rays_of[solid];
  }
  const auto most_rays = std::max_element(rays_of.begin(), rays_of.end());
  return *most_rays > 0 ? static_cast<std::size_t>(most_rays - rays_of.begin()) : near;
}

MotionVisibility Occlusion::unhidden_targets(std::span<const Target> targets, std::size_t carrier,
                                             std::span<const std::vector<RigidMotion>> poses) const {
  const TargetMask all =
      targets.size() == kMaxTargets ? ~TargetMask{0} : (TargetMask{1} << targets.size()) - 1;
  return unhidden_of({std::vector(poses.size(), std::array{all, all})}, targets, carrier, poses);
}

MotionVisibility Occlusion::unhidden_of(const MotionVisibility& seen, std::span<const Target> targets,
                                        std::size_t carrier,
                                        std::span<const std::vector<RigidMotion>> poses) const {
  require(targets.size() <= kMaxTargets, "a body has at most 64 targets");
  require(seen.poses() == poses.size(), "visibilities that are joined are of the same poses");
  MotionVisibility unhidden = seen;
  if (empty()) return unhidden;
  std::vector<std::optional<Face>> faces(targets.size());  // those that look the same to every camera
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].normal) faces[i] = face_of(targets[i], *targets[i].normal);
  }
  parallel_for(poses.size(), [&](std::size_t pose) {
    for (const Side side : {Side::Left, Side::Right}) {
      TargetMask& mask = unhidden.seen[pose][static_cast<std::size_t>(side)];
      if (mask == 0) continue;
      const View from = view(carrier, poses[pose], side);
      for (std::size_t i = 0; i < targets.size(); ++i) {
        if ((mask >> i & 1U) == 0) continue;
        const Face own = faces[i] ? Face{} : face_before(targets[i], from.eye);
        const Face& face = faces[i] ? *faces[i] : own;
        const std::size_t most = most_blocked(face);
        if (blocked(face, from, most) > most) mask &= ~(TargetMask{1} << i);
      }
    }
  });
  return unhidden;
}

}  // namespace asterism
