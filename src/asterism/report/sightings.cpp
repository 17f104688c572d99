// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/sightings.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/camera/disc_image.hpp"

namespace asterism {
namespace {

// A centre this near a predicted image is that target's: wide against any residual of a sound pose, narrow
// against the distance between targets. The pose's own uncertainty is far below it.
constexpr double kGate_px = 1.5;

using Residual = std::optional<Vec2>;

std::optional<Vec2> predicted_px(const Target& target, const RigidMotion& tracker_from_body,
                                 const StereoRig& rig, Side side) {
  const RigidMotion camera_from_body = rig.camera_from_tracker(side) * tracker_from_body;
  const Vec3 normal = camera_from_body.rotation * target.normal.value_or(Vec3::UnitZ());
  const Disc disc{camera_from_body * target.position, normal, target.imaged_radius_mm()};
  const auto image = project_disc_centre(rig.lens(side), disc);
  if (!image) return std::nullopt;
  return image->px;
}

Residual of_labelled(const std::vector<Centre>& centres, int index, const std::optional<Vec2>& predicted) {
  const bool known = index >= 0 && static_cast<std::size_t>(index) < centres.size();
  if (!known || !predicted) return std::nullopt;
  return Vec2(centres[static_cast<std::size_t>(index)].px() - *predicted);
}

Residual of_nearest(const std::vector<Centre>& centres, const std::optional<Vec2>& predicted) {
  if (!predicted) return std::nullopt;
  Residual nearest;
  for (const Centre& centre : centres) {
    const Vec2 residual = centre.px() - *predicted;
    if (residual.norm() < (nearest ? nearest->norm() : kGate_px)) nearest = residual;
  }
  return nearest;
}

/// The labelled point of each target, null where there is none.
std::vector<const Point*> labelled_points(const TrackedFrame& frame, int body_index, std::size_t targets) {
  std::vector<const Point*> of_target(targets, nullptr);
  for (const BodyLabels& labels : frame.labels) {
    if (labels.body != body_index || labels.status != LabelStatus::Ok) continue;
    for (const LabelledPoint& label : labels.points)
      of_target.at(static_cast<std::size_t>(label.target)) =
          &frame.points.at(static_cast<std::size_t>(label.point));
  }
  return of_target;
}

}  // namespace

std::vector<Sighting> sightings(const TrackedFrame& frame, const Body& body, int body_index,
                                const StereoRig& rig) {
  std::vector<Sighting> seen(body.targets.size());
  const auto pose = std::find_if(frame.poses.begin(), frame.poses.end(), [&](const BodyPose& candidate) {
    return candidate.body == body_index && candidate.estimate &&
           (candidate.status == PoseStatus::Ok || candidate.status == PoseStatus::Partial);
  });
  if (pose == frame.poses.end()) return seen;

  const std::vector<const Point*> points = labelled_points(frame, body_index, body.targets.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto residual = [&](Side side, const std::vector<Centre>& centres, int index) {
      const auto predicted = predicted_px(body.targets[i], pose->estimate->tracker_from_body, rig, side);
      return points[i] ? of_labelled(centres, index, predicted) : of_nearest(centres, predicted);
    };
    seen[i].left_px = residual(Side::Left, frame.centres.left, points[i] ? points[i]->left : -1);
    seen[i].right_px = residual(Side::Right, frame.centres.right, points[i] ? points[i]->right : -1);
  }
  return seen;
}

}  // namespace asterism
