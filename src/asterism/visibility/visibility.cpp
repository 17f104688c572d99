// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/core/result.hpp"
#include "asterism/visibility/sight_lanes.hpp"

namespace asterism {
namespace {

std::optional<SightFailure> failure_of(std::int64_t code) {
  if (code == 0) return std::nullopt;
  return static_cast<SightFailure>(code - 1);
}

/// How far the images of other targets that shine are away, edge to edge.
void find_nearest(const std::array<SightLanes, kMaxTargets>& sights, std::size_t count, std::size_t of,
                  TargetSight& sight) {
  sight.clearance_px = std::numeric_limits<double>::infinity();
  if (sights[of].shines[0] == 0) return;
  for (std::size_t other = 0; other < count; ++other) {
    if (other == of || sights[other].shines[0] == 0) continue;
    const double apart =
        std::hypot(sights[of].u[0] - sights[other].u[0], sights[of].v[0] - sights[other].v[0]) -
        sights[of].major[0] - sights[other].major[0];
    if (apart >= sight.clearance_px) continue;
    sight.clearance_px = apart;
    sight.nearest = other;
  }
}

}  // namespace

void describe(VisibilityOptions& options, OptionVisitor& visit) {
  visit.number("margin_px", options.margin_px, {0, 10000}, "between a target's image and the picture's edge");
  visit.number("max_incidence_deg", options.max_incidence_deg, {1, 90},
               "largest angle between a target's normal and the line of sight");
  visit.number("min_diameter_px", options.min_diameter_px, {0, 1000},
               "smallest image, across its shorter axis");
  visit.number("guard_px", options.guard_px, {0, 1000}, "smallest gap between the images of two targets");
}

std::string_view text_of(SightFailure failure) {
  static constexpr std::array<std::string_view, kSightFailures> kTexts = {
      "behind the camera", "outside the working volume",  "too oblique", "outside the image",
      "too small",         "too close to another target", "hidden"};
  return kTexts[static_cast<std::size_t>(failure)];
}

std::vector<TargetSight> look_at(std::span<const Target> targets, const RigidMotion& tracker_from_body,
                                 const StereoRig& rig, Side side, const std::optional<WorkingVolume>& volume,
                                 const VisibilityOptions& options) {
  const SeenMotion motion = seen_motion({&tracker_from_body, 1}, rig);
  const SightConditions conditions(targets, rig, volume, options);
  SightConditions::Sights sights;
  conditions.look(motion.camera_from_body[0][0], motion.camera_from_body[1][0], sights);
  const auto& mine = sights[static_cast<std::size_t>(side)];
  std::vector<TargetSight> found(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    TargetSight& sight = found[i];
    sight.fails = failure_of(mine[i].failure[0]);
    sight.px = {mine[i].u[0], mine[i].v[0]};
    const double square = mine[i].cosine_square[0];
    sight.incidence_rad =
        std::acos(std::clamp(std::copysign(std::sqrt(std::abs(square)), square), -1.0, 1.0));
    sight.semi_major_px = mine[i].major[0];
    sight.semi_minor_px = std::sqrt(std::max(0.0, mine[i].minor_square[0]));
    find_nearest(mine, targets.size(), i, sight);
  }
  return found;
}

MotionVisibility common(const MotionVisibility& a, const MotionVisibility& b) {
  require(a.poses() == b.poses(), "visibilities that are joined are of the same poses");
  MotionVisibility joined = a;
  for (std::size_t pose = 0; pose < joined.poses(); ++pose) {
    for (std::size_t side = 0; side < 2; ++side) joined.seen[pose][side] &= b.seen[pose][side];
  }
  return joined;
}

MotionVisibility visible_targets(std::span<const Target> targets,
                                 std::span<const RigidMotion> tracker_from_body, const StereoRig& rig,
                                 const std::optional<WorkingVolume>& volume,
                                 const VisibilityOptions& options) {
  return visible_targets(targets, seen_motion(tracker_from_body, rig), volume, options);
}

MotionVisibility visible_targets(std::span<const Target> targets, const SeenMotion& motion,
                                 const std::optional<WorkingVolume>& volume,
                                 const VisibilityOptions& options) {
  const SightConditions conditions(targets, motion.rig, volume, options);
  MotionVisibility visibility{std::vector<std::array<TargetMask, 2>>(motion.poses())};
  SightConditions::Sights sights;
  for (std::size_t block = 0; block < motion.camera_from_body[0].size(); ++block) {
    conditions.look(motion.camera_from_body[0][block], motion.camera_from_body[1][block], sights);
    const std::size_t lanes = std::min(kDoubleLanes, motion.poses() - block * kDoubleLanes);
    for (std::size_t side = 0; side < 2; ++side) {
      MaskLanes seen{};
      for (std::size_t i = 0; i < targets.size(); ++i) {
        const MaskLanes bit = MaskLanes{} + static_cast<std::int64_t>(TargetMask{1} << i);
        seen |= (sights[side][i].failure == 0) & bit;
      }
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        visibility.seen[block * kDoubleLanes + lane][side] = static_cast<TargetMask>(seen[lane]);
      }
    }
  }
  return visibility;
}

SightFailureCounts count_sight_failures(std::span<const Target> targets, const SeenMotion& motion,
                                        const std::optional<WorkingVolume>& volume,
                                        const VisibilityOptions& options) {
  const SightConditions conditions(targets, motion.rig, volume, options);
  SightFailureCounts counts(targets.size());
  SightConditions::Sights sights;
  for (std::size_t pose = 0; pose < motion.poses(); ++pose) {
    const std::size_t block = pose / kDoubleLanes, lane = pose % kDoubleLanes;
    if (lane == 0) {
      conditions.look(motion.camera_from_body[0][block], motion.camera_from_body[1][block], sights);
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        const auto failure = failure_of(sights[side][i].failure[lane]);
        if (failure) ++counts[i][side][static_cast<std::size_t>(*failure)];
      }
    }
  }
  return counts;
}

}  // namespace asterism
