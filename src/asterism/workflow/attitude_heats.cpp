// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {
namespace {

constexpr int kSteps = 31;
constexpr double kReachDeg = 15;  // where no platform states its stroke

CellReport::Heat empty_heat(const AttitudeMap& map, std::string title, std::string value_label) {
  return {std::move(title),
          "roll (deg)",
          "pitch (deg)",
          std::move(value_label),
          map.roll_deg,
          map.pitch_deg,
          {map.pitch_deg.size(), std::vector<double>(map.roll_deg.size())}};
}

}  // namespace

std::vector<CellReport::Heat> attitude_heats(const Cell& cell, const VerifiedCell& verified,
                                             const VerifyOptions& options) {
  const std::size_t mover = verified.body.mover;
  const double reach_deg =
      cell.platform ? std::max(cell.platform->stroke.roll_deg, cell.platform->stroke.pitch_deg) : kReachDeg;
  if (!(reach_deg > 0)) return {};
  const AttitudeMap map =
      attitude_map(cell, mover, reach_deg, kSteps, options.visibility, Occlusion(cell, options.occlusion));
  const WorkPoint& point = verified.body.points.at(verified.worst.point);
  CellReport::Heat count = empty_heat(map, "Targets seen by both cameras", "targets");
  CellReport::Heat error =
      empty_heat(map, fmt::format("Predicted error at {}, centres' noise alone", point.name), "error (mm)");
  AccuracyOptions accuracy = accuracy_options_of(cell, options.level);
  StereoRig rig = cell.rig;
  rig.covariance.resize(0, 0);
  for (std::size_t row = 0; row < map.pitch_deg.size(); ++row) {
    for (std::size_t column = 0; column < map.roll_deg.size(); ++column) {
      const std::size_t pose = row * map.roll_deg.size() + column;
      count.value[row][column] = map.visible[row][column];
      const RigidMotion& tracker_from_body = map.tracker_from_body[pose];
      const auto predicted = predict_pose_accuracy(cell.movers[mover].body.targets, map.seen.seen[pose],
                                                   tracker_from_body, rig, accuracy);
      error.value[row][column] =
          predicted ? error_at_point_mm(tracker_from_body, predicted->covariance, point.in_body_mm)
                    : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return {count, error};
}

}  // namespace asterism
