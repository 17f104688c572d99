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

/// Where the rays of a target begin, in its carrier's frame. A disc shows its face; what has no normal or no
/// diameter is a point, which stands proud towards the camera when there is no normal either.
std::vector<Vec3> starts_of(const Target& target, const Vec3& eye, const OcclusionOptions& options) {
  const Vec3 normal = target.normal ? *target.normal : Vec3((eye - target.position).normalized());
  const Vec3 middle = target.position + options.proud_mm * normal;
  const double radius = target.imaged_radius_mm();
  if (radius == 0) return {middle};
  const Vec3 across = radius * normal.unitOrthogonal();
  const Vec3 along = normal.cross(across);
  std::vector<Vec3> starts;
  for (int i = 0; i < options.rays; ++i) {
    const Vec2 at = spread_point(i, options.rays);
    starts.emplace_back(middle + at.x() * across + at.y() * along);
  }
  return starts;
}

}  // namespace

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
    std::vector<TriangleMesh> surfaces;
    for (std::size_t i = 0; i < occluders.size(); ++i) {
      if (occluders[i].carrier != carrier || occluders[i].surface.empty()) continue;
      members.push_back(i);
      surfaces.push_back(std::move(occluders[i].surface));
    }
    groups_.push_back({carrier, members, RayScene(surfaces)});
  }
}

/// One group as it stands before a carrier's targets and a camera.
struct Occlusion::Before {
  const RayScene* tree;
  const std::vector<std::size_t>* members;
  bool same_carrier;
  RigidMotion group_from_carrier;
  Vec3 eye;  // in the group's frame

  [[nodiscard]] Vec3 in_group(const Vec3& in_carrier) const {
    return same_carrier ? in_carrier : Vec3(group_from_carrier * in_carrier);
  }
};

std::vector<Occlusion::Before> Occlusion::before(std::size_t carrier,
                                                 std::span<const RigidMotion> tracker_from_mover,
                                                 const Vec3& eye_in_tracker) const {
  std::vector<Before> all;
  for (const Group& group : groups_) {
    const RigidMotion group_from_tracker =
        group.carrier < 0 ? RigidMotion{}
                          : tracker_from_mover[static_cast<std::size_t>(group.carrier)].inverse();
    all.push_back({&group.tree, &group.members, group.carrier == static_cast<int>(carrier),
                   group_from_tracker * tracker_from_mover[carrier], group_from_tracker * eye_in_tracker});
  }
  return all;
}

Vec3 Occlusion::eye_of(Side side) const { return rig_.camera_from_tracker(side).inverse().translation; }

double Occlusion::free_share(const Target& target, std::size_t carrier,
                             std::span<const RigidMotion> tracker_from_mover, Side side) const {
  const Vec3 eye = eye_of(side);
  const auto groups = before(carrier, tracker_from_mover, eye);
  const auto starts = starts_of(target, tracker_from_mover[carrier].inverse() * eye, options_);
  const auto blocked = std::count_if(starts.begin(), starts.end(), [&](const Vec3& start) {
    return std::any_of(groups.begin(), groups.end(), [&](const Before& group) {
      return group.tree->blocked(group.in_group(start), group.eye);
    });
  });
  return 1.0 - static_cast<double>(blocked) / static_cast<double>(starts.size());
}

std::optional<std::size_t> Occlusion::hidden_by(const Target& target, std::size_t carrier,
                                                std::span<const RigidMotion> tracker_from_mover,
                                                Side side) const {
  const Vec3 eye = eye_of(side);
  const auto groups = before(carrier, tracker_from_mover, eye);
  const auto starts = starts_of(target, tracker_from_mover[carrier].inverse() * eye, options_);
  std::vector<std::size_t> first_met(names_.size());
  std::size_t blocked = 0;
  for (const Vec3& start : starts) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t solid = 0;
    for (const Before& group : groups) {
      const auto hit = group.tree->first_hit(group.in_group(start), group.eye);
      if (!hit || hit->share >= nearest) continue;
      nearest = hit->share;
      solid = (*group.members)[hit->surface];
    }
    if (!std::isfinite(nearest)) continue;
    ++blocked;
    ++first_met[solid];
  }
  if (blocked <= most_blocked(starts.size())) return std::nullopt;
  return static_cast<std::size_t>(std::max_element(first_met.begin(), first_met.end()) - first_met.begin());
}

/// So many of a target's rays may end at something.
std::size_t Occlusion::most_blocked(std::size_t rays) const {
  return static_cast<std::size_t>(
      std::floor((1.0 - options_.least_share) * static_cast<double>(rays) + 1e-9));
}

MotionVisibility Occlusion::unhidden_targets(std::span<const Target> targets, std::size_t carrier,
                                             std::span<const std::vector<RigidMotion>> poses) const {
  require(targets.size() <= kMaxTargets, "a body has at most 64 targets");
  MotionVisibility unhidden{std::vector<std::array<TargetMask, 2>>(poses.size())};
  parallel_for(poses.size(), [&](std::size_t pose) {
    for (const Side side : {Side::Left, Side::Right}) {
      const Vec3 eye = eye_of(side);
      const auto groups = before(carrier, poses[pose], eye);
      TargetMask mask = 0;
      for (std::size_t i = 0; i < targets.size(); ++i) {
        const auto starts = starts_of(targets[i], poses[pose][carrier].inverse() * eye, options_);
        const std::size_t allowed = most_blocked(starts.size());
        std::size_t blocked = 0;
        for (std::size_t ray = 0; ray < starts.size() && blocked <= allowed; ++ray) {
          blocked += std::any_of(groups.begin(), groups.end(), [&](const Before& group) {
            return group.tree->blocked(group.in_group(starts[ray]), group.eye);
          });
        }
        if (blocked <= allowed) mask |= TargetMask{1} << i;
      }
      unhidden.seen[pose][static_cast<std::size_t>(side)] = mask;
    }
  });
  return unhidden;
}

}  // namespace asterism
