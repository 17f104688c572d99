// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/robot_reach.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/scanning/scan_scene.hpp"

namespace asterism {
namespace {

constexpr std::uint64_t kStarts = 12;
constexpr int kSteps = 60;
constexpr double kNearEnough_mm = 0.01, kNearEnough_rad = 1e-5;
constexpr double kMmARad = 500;  // how rotation and translation are weighed against each other
constexpr std::uint32_t kPurpose = 0x10B07;

/// What is missing, along the base's axes: rotation times kMmARad, translation.
Vec6 missing(const RigidMotion& wanted, const RigidMotion& have) {
  Vec6 error = difference(wanted, have);
  error.head<3>() *= kMmARad;
  return error;
}

bool near_enough(const Vec6& error) {
  return error.head<3>().norm() < kMmARad * kNearEnough_rad && error.tail<3>().norm() < kNearEnough_mm;
}

/// How the flange moves with each joint.
MatX jacobian(const Robot& robot, const std::vector<RigidMotion>& frames, const Vec3& flange) {
  MatX columns(6, static_cast<Eigen::Index>(frames.size()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 axis = frames[i].rotation * robot.joints[i].axis;
    const auto column = static_cast<Eigen::Index>(i);
    columns.block<3, 1>(0, column) = kMmARad * axis;
    columns.block<3, 1>(3, column) = axis.cross(flange - frames[i].translation);
  }
  return columns;
}

void keep_within(const Robot& robot, std::vector<double>& angles) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    angles[i] = std::clamp(angles[i], rad_from_deg(robot.joints[i].lowest_deg),
                           rad_from_deg(robot.joints[i].highest_deg));
  }
}

std::optional<std::vector<double>> from_start(const Robot& robot, const RigidMotion& base_from_flange,
                                              std::vector<double> angles) {
  double damping = 1e-2;
  std::vector<RigidMotion> frames;
  RigidMotion flange = flange_of(robot, angles, &frames);
  Vec6 error = missing(base_from_flange, flange);
  for (int step = 0; step < kSteps; ++step) {
    if (near_enough(error)) return angles;
    const MatX columns = jacobian(robot, frames, flange.translation);
    MatX normal = columns.transpose() * columns;
    normal.diagonal().array() += damping * kMmARad * kMmARad;
    const auto turn = solve_positive(normal, VecX(columns.transpose() * error));
    if (!turn) return std::nullopt;
    std::vector<double> next = angles;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += (*turn)(static_cast<Eigen::Index>(i));
    keep_within(robot, next);
    std::vector<RigidMotion> next_frames;
    const RigidMotion next_flange = flange_of(robot, next, &next_frames);
    const Vec6 next_error = missing(base_from_flange, next_flange);
    if (next_error.norm() < error.norm()) {
      angles = std::move(next), frames = std::move(next_frames), flange = next_flange, error = next_error;
      damping = std::max(damping * 0.2, 1e-9);
    } else {
      damping *= 5;
      if (damping > 1e4) return std::nullopt;
    }
  }
  return near_enough(error) ? std::optional(angles) : std::nullopt;
}

/// Places along a link's axis, and how far from each nothing may be so that the capsule is free.
bool is_off(const Capsule& link, const RigidMotion& frame_from_joint, const SurfaceTree& surface) {
  const Vec3 from = frame_from_joint * link.from_mm, to = frame_from_joint * link.to_mm;
  const double length = (to - from).norm();
  const int steps = 1 + static_cast<int>(length / link.radius_mm);
  const double half = 0.5 * length / steps;
  const double reach = std::hypot(link.radius_mm, half);
  for (int i = 0; i < steps; ++i) {
    const double share = (i + 0.5) / steps;
    if (surface.nearest(from + share * (to - from), reach)) return false;
  }
  return true;
}

TriangleMesh part_and_fixtures(const Cell& cell) {
  TriangleMesh all = *cell.workpiece->surface;
  append(all, fixtures_on_part(cell));
  return all;
}

}  // namespace

RigidMotion flange_of(const Robot& robot, std::span<const double> angles_rad,
                      std::vector<RigidMotion>* frames) {
  require(angles_rad.size() == robot.joints.size(), "there is an angle for each joint");
  RigidMotion base_from_joint;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const RobotJoint& joint = robot.joints[i];
    base_from_joint = base_from_joint * joint.parent_from_joint *
                      RigidMotion{exp_rotation(angles_rad[i] * joint.axis), Vec3::Zero()};
    if (frames != nullptr) frames->push_back(base_from_joint);
  }
  return base_from_joint;
}

std::optional<std::vector<double>> joint_angles(const Robot& robot, const RigidMotion& base_from_body,
                                                const AcceptAngles& accept) {
  const RigidMotion base_from_flange = base_from_body * robot.flange_from_scanner_body.inverse();
  for (std::uint64_t start = 0; start < kStarts; ++start) {
    RandomStream random(0, start, kPurpose);
    std::vector<double> angles;
    for (const RobotJoint& joint : robot.joints) {
      const double share = start == 0 ? 0.5 : random.uniform(0.1, 0.9);
      angles.push_back(rad_from_deg(joint.lowest_deg + share * (joint.highest_deg - joint.lowest_deg)));
    }
    auto found = from_start(robot, base_from_flange, std::move(angles));
    if (found && (!accept || accept(*found))) return found;
  }
  return std::nullopt;
}

RobotReach::RobotReach(const Cell& cell)
    : robot_(*cell.robot), part_(part_and_fixtures(cell)), surroundings_(surroundings_of(cell)) {}

bool RobotReach::reaches(const RigidMotion& tracker_from_body, const RigidMotion& tracker_from_part) const {
  const RigidMotion part_from_base = tracker_from_part.inverse() * robot_.tracker_from_base;
  return joint_angles(robot_, robot_.tracker_from_base.inverse() * tracker_from_body,
                      [&](std::span<const double> angles) { return is_free(angles, part_from_base); })
      .has_value();
}

bool RobotReach::is_free(std::span<const double> angles_rad, const RigidMotion& part_from_base) const {
  std::vector<RigidMotion> frames;
  static_cast<void>(flange_of(robot_, angles_rad, &frames));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Capsule& link = robot_.joints[i].link;
    if (!is_off(link, part_from_base * frames[i], part_)) return false;
    if (!is_off(link, robot_.tracker_from_base * frames[i], surroundings_)) return false;
  }
  return true;
}

}  // namespace asterism
