// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "asterism/cell/cell.hpp"

// A tube on a platform before a tracker, with a scanner whose targets look to all sides.

namespace asterism::scene {

inline Target target(const std::string& id, const Vec3& at, const Vec3& normal) {
  Target target;
  target.id = id;
  target.position = at;
  target.normal = normal.normalized();
  target.diameter_mm = 14;
  return target;
}

inline Body scanner_body() {
  Body body{"scanner", {}};
  for (int i = 0; i < 24; ++i) {  // a spiral over the sphere, uneven enough to be a body
    const double z = 1 - 2 * (i + 0.5) / 24, r = std::sqrt(1 - z * z), a = 2.4 * i;
    const Vec3 out(r * std::cos(a), r * std::sin(a), z);
    body.targets.push_back(target("S" + std::to_string(i), (130 + 3 * (i % 5)) * out, out));
  }
  return body;
}

inline TriangleMesh tube() { return surface_of_revolution({{170, 0}, {200, 0}, {200, 200}, {170, 200}}, 60); }

inline Cell scan_cell() {
  Cell cell;
  cell.name = "tube";
  CameraPair cameras;
  cameras.focal_px = 2600;
  cell.rig = rig_of(cameras);
  Body platform{"platform", {}};
  for (int i = 0; i < 7; ++i) {
    const double a = 0.9 * i + 0.1 * (i % 3);
    platform.targets.push_back(
        target("P" + std::to_string(i), Vec3(330 * std::cos(a), 330 * std::sin(a), 10 * i), Vec3::UnitZ()));
  }
  const RigidMotion rest =
      tracker_from_frame({{0, 0, 100}, 2300, rad_from_deg(60), rad_from_deg(45)}, cell.rig);
  cell.movers = {{platform, at_rest(rest)},
                 {scanner_body(), at_rest(rest * RigidMotion{Quaternion::Identity(), {0, 0, 700}})}};
  cell.platform = Platform{};
  cell.workpiece = Solid{"tube", std::make_shared<const TriangleMesh>(tube()), "platform", {}, {}};
  cell.scanner = Scanner{};
  cell.scanner->body_from_scanner = {Quaternion::Identity(), {0, 0, 60}};
  cell.noise.sigma_px = 0.03;
  return cell;
}

}  // namespace asterism::scene
