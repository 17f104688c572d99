// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/chain_cell.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/reproduction/printed.hpp"

namespace asterism {
namespace {

constexpr double kDiameterMm = 8;

Target target_at(std::size_t index, const Vec3& place, double tilt_rad) {
  const Vec3 outward = Vec3(place.x(), place.y(), 0).normalized();
  return {fmt::format("P{}", index + 1),
          place,
          Vec3(std::sin(tilt_rad) * outward + std::cos(tilt_rad) * Vec3::UnitZ()),
          kDiameterMm,
          {}};
}

Motion motion_of(const TrackerPlace& place) {
  KeyedMotion motion;
  for (const SightOfRing& sight : watch_ring(place, {})) {
    const Quaternion turn = exp_rotation({sight.turn_x_rad, 0, 0}) * exp_rotation({0, sight.turn_y_rad, 0});
    motion.keys.push_back({sight.time_s, rig_from_platform(place) * RigidMotion{turn, Vec3::Zero()}});
  }
  return motion;
}

/// A tracked scanner needs targets; the paper does not tell of its own.
Body scanner_body() {
  Body scanner{"scanner", {}};
  for (const Vec3& place :
       {Vec3(-120, -70, -40), Vec3(110, -85, -55), Vec3(135, 60, -30), Vec3(-60, 95, -60)}) {
    scanner.targets.push_back(
        {fmt::format("S{}", scanner.targets.size() + 1), place, -Vec3::UnitZ(), kDiameterMm, {}});
  }
  return scanner;
}

/// The scanner looks at the axis from the first station of Table 15, its own z towards the part.
RigidMotion platform_from_first_station() {
  const Vec3 station = printed::table15().front();
  Mat3 axes;
  axes.col(2) = -Vec3(station.x(), station.y(), 0).normalized();
  axes.col(0) = Vec3::UnitZ().cross(axes.col(2));
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {quaternion_from_matrix(axes), station};
}

}  // namespace

std::vector<Target> chain_targets(std::span<const Vec3> places) {
  std::vector<Target> targets;
  for (const Vec3& place : places) targets.push_back(target_at(targets.size(), place, 0));
  return targets;
}

std::vector<Target> chain_ring(const RingOfTargets& ring) {
  std::vector<Target> targets;
  for (int k = 0; k < 8; ++k) {
    const double azimuth = rad_from_deg(22.5 + 45 * k);
    targets.push_back(target_at(
        static_cast<std::size_t>(k),
        {300 * std::cos(azimuth), 300 * std::sin(azimuth), k % 2 == 0 ? 610.0 : 590.0}, ring.tilt_rad));
  }
  return targets;
}

Cell chain_cell(const std::vector<Target>& targets, const TrackerPlace& place) {
  Cell cell;
  cell.name = "the paper's cell";
  cell.rig = stereo_rig();
  cell.movers.push_back({{"platform", targets}, motion_of(place)});
  cell.movers.push_back({scanner_body(), at_rest(rig_from_platform(place) * platform_from_first_station())});
  cell.platform = Platform{};
  // 15° about x and then about y are up to 15.5° of roll in the order of Table 8's yaw, pitch, roll.
  cell.platform->stroke.roll_deg = 15.6;
  cell.workpiece =
      Solid{"casing", std::make_shared<TriangleMesh>(mesh_of(CasingShape{})), "platform", {}, {}};
  cell.scanner = Scanner{};
  cell.noise.sigma_px = 0.20;
  cell.timing = {601, 50};
  return cell;
}

}  // namespace asterism
