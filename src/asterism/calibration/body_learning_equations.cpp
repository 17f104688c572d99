// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_equations.hpp"

#include <cmath>

#include "asterism/camera/disc_image.hpp"

namespace asterism {
namespace {

constexpr double kHuber = 3.0;  // sigmas; the norm of a 2-vector exceeds it once in 90

Mat2 whitener_of(const Mat2& covariance) {
  // Inverse of the lower Cholesky factor, by hand: 2×2.
  const double l11 = std::sqrt(covariance(0, 0));
  const double l21 = covariance(1, 0) / l11;
  const double l22 = std::sqrt(covariance(1, 1) - l21 * l21);
  Mat2 inverse;
  inverse << 1 / l11, 0, -l21 / (l11 * l22), 1 / l22;
  return inverse;
}

double huber_weight(double norm) { return norm <= kHuber ? 1.0 : kHuber / norm; }

/// ∂px / ∂ (the rig's parameters) of one view; that the target is a disc changes nothing at this order.
MatX view_by_rig(const StereoRig& rig, const BodyModel& model, const BodyView& view) {
  const Vec3 in_tracker = model.tracker_from_body[view.frame] * model.positions[view.target];
  const auto image = project(rig.lens(view.side), rig.camera_from_tracker(view.side) * in_tracker);
  require(image.has_value(), "a view in use lies before its camera");
  return pixel_by_rig(rig, view.side, in_tracker, image->by_point);
}

/// Everything one frame adds: gathered first, since its pose block is eliminated as a whole.
struct FrameBlocks {
  Mat6 pose = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  MatX coupling, by_rig;
};

}  // namespace

Result<ExpectedView, LensFailure> expect_view(const StereoRig& rig, const BodyModel& model, std::size_t frame,
                                              std::size_t target, Side side) {
  const RigidMotion camera_from_tracker = rig.camera_from_tracker(side);
  const RigidMotion& pose = model.tracker_from_body[frame];
  const Vec3 turned = pose.rotation * model.positions[target];
  const auto& normal = model.normals[target];
  const Mat3 camera_axes = camera_from_tracker.rotation.toRotationMatrix();
  const Vec3 in_camera = camera_from_tracker * (turned + pose.translation);
  const Vec3 normal_turned = normal ? Vec3(pose.rotation * *normal) : Vec3::UnitZ();
  const auto image = project_disc_centre(
      rig.lens(side), Disc{in_camera, camera_axes * normal_turned, normal ? model.radii_mm[target] : 0.0});
  if (!image) return because(image.error());
  ExpectedView view;
  view.px = image->px;
  const Mat23 by_point = image->by_centre * camera_axes;
  view.by_position = by_point * pose.rotation.toRotationMatrix();
  view.by_pose << -by_point * skew(turned) - image->by_normal * camera_axes * skew(normal_turned), by_point;
  return view;
}

Result<ViewResidual, LensFailure> residual_of(const StereoRig& rig, const BodyModel& model,
                                              const BodyView& view) {
  const auto expected = expect_view(rig, model, view.frame, view.target, view.side);
  if (!expected) return because(expected.error());
  const Mat2 whitener = whitener_of(view.centre.covariance);
  return ViewResidual{whitener * (view.centre.px() - expected->px), whitener * expected->by_position,
                      whitener * expected->by_pose, whitener};
}

double huber_cost(double norm) { return norm <= kHuber ? norm * norm : kHuber * (2 * norm - kHuber); }

bool assemble_equations(const EquationInput& in, ReducedEquations& reduced) {
  const auto n = static_cast<Eigen::Index>(3 * in.model.positions.size());
  const std::size_t frames = in.model.tracker_from_body.size();
  const Eigen::Index rig_columns = in.with_rig ? in.rig.covariance.cols() : 0;
  reduced.information = MatX::Zero(n, n);
  reduced.gradient = VecX::Zero(n);
  reduced.by_rig = MatX::Zero(n, rig_columns);
  std::vector<FrameBlocks> blocks(frames);
  for (FrameBlocks& block : blocks) {
    block.coupling = MatX::Zero(6, n);
    block.by_rig = MatX::Zero(6, rig_columns);
  }
  for (const BodyView& view : in.views) {
    if (view.rejected) continue;
    const auto residual = residual_of(in.rig, in.model, view);
    if (!residual) return false;
    const double weight = in.robust ? huber_weight(residual->whitened.norm()) : 1.0;
    const auto at = static_cast<Eigen::Index>(3 * view.target);
    FrameBlocks& block = blocks[view.frame];
    reduced.information.block<3, 3>(at, at) +=
        weight * residual->by_position.transpose() * residual->by_position;
    reduced.gradient.segment<3>(at) += weight * residual->by_position.transpose() * residual->whitened;
    block.pose += weight * residual->by_pose.transpose() * residual->by_pose;
    block.gradient += weight * residual->by_pose.transpose() * residual->whitened;
    block.coupling.middleCols(at, 3) += weight * residual->by_pose.transpose() * residual->by_position;
    if (rig_columns == 0) continue;
    const MatX by_rig = residual->whitener * view_by_rig(in.rig, in.model, view);
    reduced.by_rig.middleRows(at, 3) += weight * residual->by_position.transpose() * by_rig;
    block.by_rig += weight * residual->by_pose.transpose() * by_rig;
  }
  reduced.inverse_poses.clear();
  reduced.pose_gradients.clear();
  reduced.pose_coupling.clear();
  for (FrameBlocks& block : blocks) {
    Mat6 damped = block.pose;
    damped.diagonal() *= 1 + in.damping;
    // A frame all of whose views were refused takes no part.
    const bool empty = !(block.pose.trace() > 0);
    const auto inverse = empty ? std::optional<Mat6>(Mat6::Zero()) : inverse_positive(damped);
    if (!inverse) return false;
    const MatX gain = block.coupling.transpose() * *inverse;
    reduced.information -= gain * block.coupling;
    reduced.gradient -= gain * block.gradient;
    if (rig_columns > 0) reduced.by_rig -= gain * block.by_rig;
    reduced.inverse_poses.push_back(*inverse);
    reduced.pose_gradients.push_back(block.gradient);
    reduced.pose_coupling.push_back(std::move(block.coupling));
  }
  return true;
}

}  // namespace asterism
