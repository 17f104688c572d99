// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/simulation/outline.hpp"
#include "asterism/simulation/rays.hpp"
#include "asterism/simulation/stage.hpp"

namespace asterism {

/// One target, or one lamp, as one camera has it at one moment; lengths in mm in the camera's frame.
struct SceneDisc {
  int body = 0, target = 0;  // a lamp has body −1 and its number
  DiscPlace place;
  double incidence_rad = 0;  // between its normal and the way to the camera
  double brightness = 0;     // relative to one seen square on; 0 from behind, or when it is not there
  double level = 0;          // its light as a share of full scale
  bool there = true;         // false: it has fallen off
};

struct SceneSolid {
  Shape shape;
  RigidMotion shape_from_camera;
  Ball ball;  // around it, in the camera's frame
};

/// A mesh: the stage's own, seen from here.
struct SceneMesh {
  const StageSolid* solid;
  RigidMotion carrier_from_camera;
};

/// A surface to be drawn: the stage's own, seen from here.
struct SceneSurface {
  const DrawnSurface* surface;
  RigidMotion camera_from_carrier;
};

/// The cell before one camera at one moment; not to outlive its stage.
struct Scene {
  std::vector<SceneDisc> discs;  // targets, then lamps
  std::vector<SceneSolid> solids;
  std::vector<SceneMesh> meshes;
  std::vector<SceneSurface> surfaces;
};

/// A target without a normal, and a lamp, faces each camera; a target without a diameter is a point
/// (radius 0).
[[nodiscard]] Scene scene_of(const Stage& stage, Side side, double time_s);

/// The solids, meshes and foreign targets that may hide part of disc `index`: of the others a ball or a plane
/// tells that they are not in the way to the camera.
class Hiding {
 public:
  Hiding(const Scene& scene, std::size_t index);
  [[nodiscard]] bool possible() const { return !solids_.empty() || !meshes_.empty() || !plates_.empty(); }
  /// Whether a point of the disc is hidden from the camera.
  [[nodiscard]] bool hides(const Vec3& on_disc) const;

 private:
  std::vector<const SceneSolid*> solids_;
  std::vector<const SceneMesh*> meshes_;
  std::vector<const DiscPlace*> plates_;
};

/// Share of the disc that neither solids, meshes, other bodies' targets nor the image's edge keep from the
/// camera; 0 when it faces away. Told by 250 points spread evenly over it, 4000 when they differ.
[[nodiscard]] double visible_share(const Scene& scene, std::size_t index, const Lens& lens);

}  // namespace asterism
