// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "asterism/calibration/body_learning_congruence.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

/// Mean direction to the middle between the cameras, in the body's frame.
Vec3 towards_cameras(const StereoRig& rig, const BodyModel& model, const Vec3& centroid) {
  const Vec3 middle = 0.5 * rig.right_from_left.inverse().translation;
  Vec3 sum = Vec3::Zero();
  for (const RigidMotion& pose : model.tracker_from_body)
    sum += (pose.inverse() * middle - centroid).normalized();
  return sum;
}

Vec3 least_spread(const std::vector<Vec3>& positions, const Vec3& centroid) {
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& p : positions) scatter += (p - centroid) * (p - centroid).transpose();
  return symmetric_eigen(scatter).vectors.col(0);
}

/// All targets as points with one uncertainty, for the congruence search.
std::vector<Point> as_points(const std::vector<Vec3>& positions, double sigma_mm) {
  std::vector<Point> points;
  for (const Vec3& p : positions) points.push_back({p, sigma_mm * sigma_mm * Mat3::Identity()});
  return points;
}

/// Least squares of the learnt targets onto the nominal ones they are paired with.
BodyFrame frame_of_pairs(const BodyModel& model, const Body& nominal, const Congruence& found) {
  BodyFrame frame;
  frame.order.resize(nominal.targets.size());
  for (const PointPair& pair : found.pairs) {
    frame.order[static_cast<std::size_t>(pair.b)] = static_cast<std::size_t>(pair.a);
  }
  std::vector<Vec3> in_nominal, in_set;
  for (std::size_t t = 0; t < nominal.targets.size(); ++t) {
    frame.ids.push_back(nominal.targets[t].id);
    in_nominal.push_back(nominal.targets[t].position);
    in_set.push_back(model.positions[frame.order[t]]);
  }
  const auto fit = fit_rigid_motion(in_nominal, in_set);
  require(fit.has_value(), "targets that are congruent do not lie on a line");
  frame.body_from_set = fit->a_from_b;
  frame.rms_mm = fit->rms;
  return frame;
}

}  // namespace

BodyFrame own_frame(const StereoRig& rig, const BodyModel& model) {
  const Vec3 centroid = centroid_of(model.positions);
  Vec3 z = least_spread(model.positions, centroid);
  if (z.dot(towards_cameras(rig, model, centroid)) < 0) z = -z;
  const auto across = [&](std::size_t t) {
    const Vec3 from_centroid = model.positions[t] - centroid;
    return Vec3(from_centroid - z * z.dot(from_centroid));
  };
  std::size_t farthest = 0;
  for (std::size_t t = 1; t < model.positions.size(); ++t) {
    if (across(t).norm() > across(farthest).norm()) farthest = t;
  }
  Mat3 axes;
  axes.col(0) = across(farthest).normalized();
  axes.col(2) = z;
  axes.col(1) = z.cross(axes.col(0));
  BodyFrame frame;
  frame.body_from_set = RigidMotion{quaternion_from_matrix(axes), centroid}.inverse();
  frame.order.resize(model.positions.size());
  std::iota(frame.order.begin(), frame.order.end(), 0);
  const auto angle = [&](std::size_t t) {
    if (t == farthest) return -1.0;
    const Vec3 p = frame.body_from_set * model.positions[t];
    const double turn = std::atan2(p.y(), p.x());
    return turn < 0 ? turn + 2 * std::numbers::pi : turn;
  };
  std::stable_sort(frame.order.begin(), frame.order.end(),
                   [&](std::size_t a, std::size_t b) { return angle(a) < angle(b); });
  for (std::size_t t = 0; t < frame.order.size(); ++t) frame.ids.push_back(fmt::format("T{}", t + 1));
  return frame;
}

std::optional<BodyFrame> nominal_frame(const BodyModel& model, const Body& nominal, double error_mm) {
  const std::vector<Vec3> positions = positions_of(nominal.targets);
  // The gate of a congruence is √kPointGate sigmas of a pair.
  const double sigma = error_mm / std::sqrt(2 * kPointGate);
  const auto found = congruent_subsets(as_points(model.positions, sigma), as_points(positions, sigma), 0.0,
                                       std::min<std::size_t>(model.positions.size(), 4));
  std::optional<BodyFrame> best;
  for (const Congruence& one : found) {
    if (one.pairs.size() < nominal.targets.size()) continue;
    BodyFrame frame = frame_of_pairs(model, nominal, one);
    if (!best || frame.rms_mm < best->rms_mm) {
      if (best) frame.second_rms_mm = best->rms_mm;
      best = std::move(frame);
    } else if (best->second_rms_mm == 0 || frame.rms_mm < best->second_rms_mm) {
      best->second_rms_mm = frame.rms_mm;
    }
  }
  return best;
}

BodyModel in_frame(const BodyModel& model, const BodyFrame& frame) {
  BodyModel moved;
  for (const std::size_t t : frame.order) {
    moved.positions.push_back(frame.body_from_set * model.positions[t]);
    moved.normals.push_back(model.normals[t]);
    if (moved.normals.back()) *moved.normals.back() = frame.body_from_set.rotation * *moved.normals.back();
    moved.radii_mm.push_back(model.radii_mm[t]);
  }
  const RigidMotion set_from_body = frame.body_from_set.inverse();
  for (const RigidMotion& pose : model.tracker_from_body)
    moved.tracker_from_body.push_back(pose * set_from_body);
  return moved;
}

MatX in_frame(const MatX& covariance, const BodyFrame& frame) {
  const Mat3 turn = frame.body_from_set.rotation.toRotationMatrix();
  MatX moved(covariance.rows(), covariance.cols());
  const auto at = [](std::size_t t) { return static_cast<Eigen::Index>(3 * t); };
  for (std::size_t i = 0; i < frame.order.size(); ++i) {
    for (std::size_t j = 0; j < frame.order.size(); ++j) {
      moved.block<3, 3>(at(i), at(j)) =
          turn * covariance.block<3, 3>(at(frame.order[i]), at(frame.order[j])) * turn.transpose();
    }
  }
  return moved;
}

}  // namespace asterism
