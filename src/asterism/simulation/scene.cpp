// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asterism {
namespace {

// A target's face stands proud of what carries it; a ray that starts on the carrier's skin would be lost.
constexpr double kProud_mm = 0.5;

SceneDisc disc_of(const Target& target, const RigidMotion& camera_from_body, const Light& light) {
  SceneDisc disc;
  disc.place.centre = camera_from_body * target.position;
  const Vec3 to_camera = -disc.place.centre.normalized();
  disc.place.normal = target.normal ? camera_from_body.rotation * target.normal->normalized() : to_camera;
  disc.place.radius_mm = target.diameter_mm ? 0.5 * *target.diameter_mm : 0.0;
  const double cosine = std::clamp(disc.place.normal.dot(to_camera), -1.0, 1.0);
  disc.incidence_rad = std::acos(cosine);
  if (cosine <= 0) return disc;
  const double ratio =
      light.retro_falloff_deg > 0 ? deg_from_rad(disc.incidence_rad) / light.retro_falloff_deg : 0.0;
  disc.brightness = std::exp(-ratio * ratio * ratio * ratio);
  disc.level = light.target_level * disc.brightness;
  return disc;
}

SceneDisc disc_of(const Lamp& lamp, int number, const RigidMotion& camera_from_tracker) {
  SceneDisc disc;
  disc.body = -1;
  disc.target = number;
  disc.place.centre = camera_from_tracker * lamp.in_tracker_mm;
  disc.place.normal = -disc.place.centre.normalized();
  disc.place.radius_mm = lamp.radius_mm;
  disc.brightness = 1;
  disc.level = lamp.level;
  return disc;
}

/// Points spread evenly over the unit disc (sunflower).
Vec2 spread_point(int i, int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double radius = std::sqrt((i + 0.5) / count);
  return {radius * std::cos(i * golden), radius * std::sin(i * golden)};
}

int count_visible(const Hiding& hiding, const DiscPlace& disc, const Lens& lens, int count) {
  const Vec3 across = disc.normal.unitOrthogonal();
  const Vec3 along = disc.normal.cross(across);
  int visible = 0;
  for (int i = 0; i < count; ++i) {
    const Vec2 at = disc.radius_mm * spread_point(i, count);
    const Vec3 point = disc.centre + at.x() * across + at.y() * along;
    const auto image = project(lens, point);
    if (!image) continue;
    const bool inside = image->px.x() >= -0.5 && image->px.y() >= -0.5 &&
                        image->px.x() <= lens.width_px - 0.5 && image->px.y() <= lens.height_px - 0.5;
    if (inside && !hiding.hides(point)) ++visible;
  }
  return visible;
}

}  // namespace

Scene scene_of(const Stage& stage, Side side, double time_s) {
  const Cell& cell = stage.cell;
  const RigidMotion camera_from_tracker = cell.rig.camera_from_tracker(side);
  Scene scene;
  std::vector<RigidMotion> camera_from_body;
  for (const Mover& mover : cell.movers) {
    camera_from_body.push_back(camera_from_tracker * pose_at(mover.motion, time_s));
    const std::size_t body = camera_from_body.size() - 1;
    for (std::size_t i = 0; i < mover.body.targets.size(); ++i) {
      const StageTarget now = target_at(stage, body, i, time_s);
      SceneDisc disc = disc_of(now.target, camera_from_body.back(), cell.light);
      disc.there = now.there;
      if (!now.there) disc.brightness = disc.level = 0;
      disc.body = static_cast<int>(body);
      disc.target = static_cast<int>(i);
      scene.discs.push_back(disc);
    }
  }
  for (const Lamp& lamp : cell.lamps) {
    const int number = static_cast<int>(&lamp - cell.lamps.data());
    scene.discs.push_back(disc_of(lamp, number, camera_from_tracker));
  }
  for (const Obstacle& obstacle : cell.obstacles) {
    RigidMotion camera_from_shape = camera_from_tracker * obstacle.carrier_from_shape;
    for (std::size_t i = 0; i < cell.movers.size(); ++i) {
      if (cell.movers[i].body.name == obstacle.body)
        camera_from_shape = camera_from_body[i] * obstacle.carrier_from_shape;
    }
    const Ball ball = ball_around(obstacle.shape);
    scene.solids.push_back(
        {obstacle.shape, camera_from_shape.inverse(), {camera_from_shape * ball.centre, ball.radius_mm}});
  }
  const auto camera_from = [&](int carrier) {
    return carrier < 0 ? camera_from_tracker : camera_from_body[static_cast<std::size_t>(carrier)];
  };
  for (const StageSolid& solid : stage.solids)
    scene.meshes.push_back({&solid, camera_from(solid.carrier).inverse()});
  for (const DrawnSurface& surface : stage.surfaces)
    scene.surfaces.push_back({&surface, camera_from(surface.carrier)});
  return scene;
}

Hiding::Hiding(const Scene& scene, std::size_t index) {
  const SceneDisc& disc = scene.discs[index];
  const Vec3 camera = Vec3::Zero();
  for (const SceneSolid& solid : scene.solids) {
    const double apart = segment_distance(disc.place.centre, camera, solid.ball.centre, solid.ball.centre);
    if (apart <= disc.place.radius_mm + solid.ball.radius_mm) solids_.push_back(&solid);
  }
  for (const SceneMesh& mesh : scene.meshes) {
    const RigidMotion& there = mesh.carrier_from_camera;
    if (!out_of_reach(mesh.solid->slabs, there * disc.place.centre, there.rotation * disc.place.normal,
                      disc.place.radius_mm, there.translation))
      meshes_.push_back(&mesh);
  }
  for (const SceneDisc& other : scene.discs) {
    if (!other.there || other.body == disc.body || other.place.centre.norm() >= disc.place.centre.norm())
      continue;
    const double apart = segment_distance(disc.place.centre, camera, other.place.centre, other.place.centre);
    if (apart <= disc.place.radius_mm + other.place.radius_mm) plates_.push_back(&other.place);
  }
}

bool Hiding::hides(const Vec3& on_disc) const {
  const Vec3 start = on_disc * (1.0 - kProud_mm / on_disc.norm());
  for (const SceneSolid* solid : solids_) {
    if (blocks(solid->shape, solid->shape_from_camera * start, solid->shape_from_camera.translation))
      return true;
  }
  for (const SceneMesh* mesh : meshes_) {
    if (mesh->solid->tree.blocked(mesh->carrier_from_camera * start, mesh->carrier_from_camera.translation))
      return true;
  }
  for (const DiscPlace* plate : plates_) {
    const double t = plate->normal.dot(plate->centre) / plate->normal.dot(start);
    if (t > 0 && t < 1 && (t * start - plate->centre).norm() <= plate->radius_mm) return true;
  }
  return false;
}

double visible_share(const Scene& scene, std::size_t index, const Lens& lens) {
  const SceneDisc& disc = scene.discs[index];
  if (disc.brightness <= 0 || disc.place.centre.z() <= 0) return 0;
  constexpr int kFew = 250;
  constexpr int kMany = 4000;
  const Hiding hiding(scene, index);
  const int few = count_visible(hiding, disc.place, lens, kFew);
  if (few == 0) return 0;
  if (few == kFew) return 1;
  return static_cast<double>(count_visible(hiding, disc.place, lens, kMany)) / kMany;
}

}  // namespace asterism
