// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/truth.hpp"

#include "asterism/simulation/scene.hpp"

namespace asterism {
namespace {

bool inside(const Lens& lens, const Rim& rim) {
  for (const RimPoint& point : rim) {
    const Vec2& px = point.px;
    if (px.x() < -0.5 || px.y() < -0.5 || px.x() > lens.width_px - 0.5 || px.y() > lens.height_px - 0.5)
      return false;
  }
  return true;
}

/// How far the image of the target's centre goes during the exposure.
double way_px(const Stage& stage, const TargetTruth& truth, double time_s) {
  const Cell& cell = stage.cell;
  const auto body = static_cast<std::size_t>(truth.body);
  const Vec3 position =
      target_at(stage, body, static_cast<std::size_t>(truth.target), time_s).target.position;
  const auto at = [&](double t) {
    const RigidMotion camera_from_body =
        cell.rig.camera_from_tracker(truth.side) * pose_at(cell.movers[body].motion, t);
    return project(cell.rig.lens(truth.side), camera_from_body * position);
  };
  const auto begin = at(time_s - 0.5 * cell.sensor.exposure_s);
  const auto end = at(time_s + 0.5 * cell.sensor.exposure_s);
  return begin && end ? (end->px - begin->px).norm() : 0.0;
}

void add_targets(const Stage& stage, Side side, double time_s, FrameTruth& truth) {
  const Lens& lens = stage.cell.rig.lens(side);
  const Scene scene = scene_of(stage, side, time_s);
  for (std::size_t i = 0; i < scene.discs.size(); ++i) {
    const SceneDisc& disc = scene.discs[i];
    if (disc.body < 0) break;  // lamps are no targets
    const auto centre = project(lens, disc.place.centre);
    const Rim rim = rim_of_disc(lens, disc.place);
    if (!centre || rim.empty()) continue;
    TargetTruth target;
    target.body = disc.body;
    target.target = disc.target;
    target.side = side;
    target.centre_px = centre->px;
    target.image = disc.place.radius_mm > 0 ? moments_of(rim).ellipse : Ellipse{centre->px, 0, 0, 0};
    target.incidence_rad = disc.incidence_rad;
    target.brightness = disc.brightness;
    target.in_image = inside(lens, rim);
    target.visible = visible_share(scene, i, lens);
    target.blur_px = way_px(stage, target, time_s);
    target.in_camera = disc.place.centre;
    truth.targets.push_back(target);
  }
}

}  // namespace

FrameTruth truth_of(const Stage& stage, double time_s) {
  FrameTruth truth;
  for (const Mover& mover : stage.cell.movers)
    truth.tracker_from_body.push_back(pose_at(mover.motion, time_s));
  add_targets(stage, Side::Left, time_s, truth);
  add_targets(stage, Side::Right, time_s, truth);
  return truth;
}

}  // namespace asterism
