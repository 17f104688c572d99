// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"
#include "asterism/cell/paper_layouts.hpp"

namespace asterism {

/// The paper's platform and tracker as docs/paper.md chooses them (60° up, 16 mm lenses, 1 m apart), sweeping
/// 15°, its targets in a room of the given radius between z 580 and 620 and tilted outwards; a point of the
/// part above. From 2.6 m and without the tilt all of the paper's layouts are seen all the time.
inline Cell paper_cell(double radius_mm = 350, int poses = 40, double range_mm = 2000, double tilt_deg = 20) {
  Cell cell;
  cell.name = "paper";
  cell.rig = rig_of(CameraPair{4096, 3000, 4638, 1000, 2000});
  Body platform{"platform", {}};
  for (const Vec3& position : paper_table1()[2].targets) {
    Target target;
    target.id = "P" + std::to_string(platform.targets.size() + 1);
    target.position = position;
    platform.targets.push_back(target);
  }
  Sweep sweep;
  sweep.tracker_from_rest =
      tracker_from_frame(SeenFrom{Vec3(0, 0, 600), range_mm, rad_from_deg(60), rad_from_deg(45)}, cell.rig);
  sweep.pitch = {rad_from_deg(15), 0.25, 0};
  sweep.roll = {rad_from_deg(15), 0.5, 0};
  cell.movers.push_back({platform, sweep});
  cell.timing = {81, 20};  // 4 s: a whole turn of both swings

  LayoutTask task;
  task.body = "platform";
  task.surface.patches.push_back({"room", CylinderRoom{{0, 0, 580}, radius_mm, 40, rad_from_deg(tilt_deg)}});
  task.points.push_back({"part", Vec3(0, 0, 900)});
  task.poses = poses;
  cell.layout = task;
  return cell;
}

/// The same with a mast on the platform and a beam that stands before the cameras, seen from 2.6 m.
inline Cell shaded_cell(int poses = 12) {
  Cell cell = paper_cell(350, poses, 2600, 0);
  cell.obstacles = {
      {"mast", Frustum{80, 80, 500}, "platform", {Quaternion::Identity(), {0, 0, 590}}, {}},
      {"beam", Capsule{{-700, 0, 0}, {700, 0, 0}, 40}, "", {Quaternion::Identity(), {0, -100, 1300}}, {}}};
  return cell;
}

}  // namespace asterism
