// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/cell/cell.hpp"

namespace asterism {

/// For tests: six 12-mm targets (the paper's S3 of Table 1) that face up, seen from 2.3 m and 60° above,
/// sweeping ±15°.
inline Cell test_cell() {
  Cell cell;
  cell.name = "test cell";
  cell.rig = rig_of({1024, 768, 1600, 1000, 2300});
  Body body{"platform", {}};
  const Vec3 places[] = {{200, -100, 590}, {-100, 300, 610}, {-200, 100, 600},
                         {0, -250, 605},   {210, 180, 580},  {-200, -240, 590}};
  for (const Vec3& place : places) {
    body.targets.push_back({"P" + std::to_string(body.targets.size() + 1), place, Vec3::UnitZ(), 12.0, {}});
  }
  Sweep sweep;
  sweep.tracker_from_rest =
      tracker_from_frame({{0, 0, 600}, 2300, rad_from_deg(60), rad_from_deg(45)}, cell.rig);
  sweep.pivot_mm = {0, 0, 600};
  sweep.yaw = {rad_from_deg(15), 0.5, 0};
  sweep.pitch = {rad_from_deg(15), 0.25, 0.7};
  sweep.roll = {rad_from_deg(15), 0.35, 1.9};
  cell.movers.push_back({body, sweep});
  return cell;
}

}  // namespace asterism
