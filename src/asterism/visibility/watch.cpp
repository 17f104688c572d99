// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/watch.hpp"

#include <bit>
#include <utility>
#include <variant>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/point_sets.hpp"

namespace asterism {
namespace {

constexpr std::array kSides = {Side::Left, Side::Right};

/// All targets of a body in one pose of the cell.
std::vector<std::array<SightCause, 2>> causes_at(const Cell& cell, std::size_t mover,
                                                 std::span<const RigidMotion> poses,
                                                 const VisibilityOptions& options,
                                                 const Occlusion& occlusion) {
  const std::vector<Target>& targets = cell.movers[mover].body.targets;
  std::vector<std::array<SightCause, 2>> causes(targets.size());
  for (const Side side : kSides) {
    const auto sights = look_at(targets, poses[mover], cell.rig, side, cell.volume, options);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      SightCause& cause = causes[i][static_cast<std::size_t>(side)];
      cause.fails = sights[i].fails;
      if (cause.fails || occlusion.empty()) continue;
      cause.solid = occlusion.hidden_by(targets[i], mover, poses, side);
      if (cause.solid) cause.fails = SightFailure::Hidden;
    }
  }
  return causes;
}

std::array<TargetMask, 2> mask_of(const std::vector<std::array<SightCause, 2>>& causes) {
  std::array<TargetMask, 2> seen{};
  for (std::size_t i = 0; i < causes.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (causes[i][side].seen()) seen[side] |= TargetMask{1} << i;
    }
  }
  return seen;
}

bool in_image(const Lens& lens, const Vec3& in_camera) {
  const auto image = project(lens, in_camera);
  return image && image->px.x() >= 0 && image->px.x() <= lens.width_px - 1 && image->px.y() >= 0 &&
         image->px.y() <= lens.height_px - 1;
}

}  // namespace

WatchedCell watch_cell(const Cell& cell, std::span<const double> times_s, const VisibilityOptions& visibility,
                       const Occlusion& occlusion) {
  WatchedCell watched;
  watched.times_s.assign(times_s.begin(), times_s.end());
  for (const double time_s : times_s) watched.poses.push_back(poses_at(cell, time_s));
  for (std::size_t mover = 0; mover < cell.movers.size(); ++mover) {
    WatchedBody& body = watched.bodies.emplace_back();
    body.causes.resize(times_s.size());
    parallel_for(times_s.size(), [&](std::size_t pose) {
      body.causes[pose] = causes_at(cell, mover, watched.poses[pose], visibility, occlusion);
    });
    for (const auto& causes : body.causes) body.visibility.seen.push_back(mask_of(causes));
  }
  const int platform = cell.platform ? mover_index(cell, cell.platform->body) : -1;
  if (platform < 0) return watched;
  const auto place = static_cast<std::size_t>(platform);
  const std::vector<Target>& targets = cell.movers[place].body.targets;
  const Vec3 centre = targets.empty() ? cell.platform->pivot_mm : centroid_of(positions_of(targets));
  for (const auto& poses : watched.poses) {
    watched.coverage.push_back(coverage_coefficient(cell, poses[place], centre));
  }
  return watched;
}

double coverage_coefficient(const Cell& cell, const RigidMotion& tracker_from_platform,
                            const Vec3& centre_mm) {
  const Vec3 centre = tracker_from_platform * centre_mm;
  for (const Side side : kSides) {
    if (!in_image(cell.rig.lens(side), cell.rig.camera_from_tracker(side) * centre)) return 0;
  }
  const RigidMotion from_middle = tracker_from_middle(cell.rig);
  if (cell.volume && !contains(*cell.volume, from_middle.inverse() * centre)) return 0;
  const Vec3 to_cameras = (from_middle.translation - centre).normalized();
  return to_cameras.dot(tracker_from_platform.rotation * Vec3::UnitZ());
}

HiddenCounts count_hidden(const WatchedBody& body, std::size_t solids) {
  const std::size_t targets = body.causes.empty() ? 0 : body.causes.front().size();
  HiddenCounts counts(targets, {std::vector<int>(solids), std::vector<int>(solids)});
  for (const auto& causes : body.causes) {
    for (std::size_t i = 0; i < targets; ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (causes[i][side].solid) ++counts[i][side][*causes[i][side].solid];
      }
    }
  }
  return counts;
}

AttitudeMap attitude_map(const Cell& cell, std::size_t mover, double reach_deg, int steps,
                         const VisibilityOptions& visibility, const Occlusion& occlusion) {
  require(steps >= 2, "an attitude map has two steps or more");
  const Motion& motion = cell.movers[mover].motion;
  const auto* sweep = std::get_if<Sweep>(&motion);
  const RigidMotion rest = sweep ? sweep->tracker_from_rest : pose_at(motion, 0);
  const Vec3 pivot = sweep ? sweep->pivot_mm : Vec3(Vec3::Zero());
  AttitudeMap map;
  for (int i = 0; i < steps; ++i) map.roll_deg.push_back(reach_deg * (2.0 * i / (steps - 1) - 1.0));
  map.pitch_deg = map.roll_deg;

  const std::vector<RigidMotion> others = poses_at(cell, 0);
  std::vector<std::vector<RigidMotion>> poses;
  std::vector<RigidMotion> of_body;
  for (const double pitch : map.pitch_deg) {
    for (const double roll : map.roll_deg) {
      const Quaternion turn = rotation_from_yaw_pitch_roll(0, rad_from_deg(pitch), rad_from_deg(roll));
      of_body.push_back(rest * rotation_about(pivot, turn));
      poses.push_back(others);
      poses.back()[mover] = of_body.back();
    }
  }
  const std::vector<Target>& targets = cell.movers[mover].body.targets;
  map.seen = occlusion.unhidden_of(visible_targets(targets, of_body, cell.rig, cell.volume, visibility),
                                   targets, mover, poses);
  for (std::size_t row = 0; row < map.pitch_deg.size(); ++row) {
    auto& masks = map.seen_by_both.emplace_back();
    auto& counts = map.visible.emplace_back();
    for (std::size_t column = 0; column < map.roll_deg.size(); ++column) {
      masks.push_back(map.seen.both(row * map.roll_deg.size() + column));
      counts.push_back(std::popcount(masks.back()));
    }
  }
  map.tracker_from_body = std::move(of_body);
  return map;
}

}  // namespace asterism
