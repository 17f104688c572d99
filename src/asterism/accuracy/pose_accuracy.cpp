// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/pose_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/accuracy/point_information.hpp"
#include "asterism/camera/disc_image.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

/// One target's image in one camera, linearised.
struct View {
  Side side;
  Vec3 in_tracker;
  Mat23 by_point;  // ∂px / ∂(its centre in the tracker's frame)
  Mat26 by_pose;   // ∂px / ∂(ω, δ)
  double weight;   // 1 / σ²
};

std::optional<View> view_of(const Target& target, Side side, const RigidMotion& tracker_from_body,
                            const StereoRig& rig, const CentreVariance& variance) {
  const RigidMotion camera_from_tracker = rig.camera_from_tracker(side);
  const Vec3 arm = tracker_from_body.rotation * target.position;
  View view{side, arm + tracker_from_body.translation, {}, {}, 0};
  const Vec3 normal = target.normal ? Vec3(tracker_from_body.rotation * *target.normal) : Vec3(Vec3::Zero());
  const Disc disc{camera_from_tracker * view.in_tracker,
                  target.normal ? Vec3(camera_from_tracker.rotation * normal) : Vec3(Vec3::UnitZ()),
                  target.imaged_radius_mm()};
  const auto image = project_disc_centre(rig.lens(side), disc);
  if (!image) return std::nullopt;

  const Mat3 rotation = camera_from_tracker.rotation.toRotationMatrix();
  view.by_point = image->by_centre * rotation;
  view.by_pose << -view.by_point * skew(arm), view.by_point;
  view.by_pose.leftCols<3>() -= image->by_normal * rotation * skew(normal);

  double square = variance.constant_px2();
  if (variance.by_size() && target.diameter_mm) {
    const Lens& lens = rig.lens(side);
    const double cosine = target.normal ? -disc.normal.dot(disc.centre) / disc.centre.norm() : 1.0;
    const double semi_minor =
        std::sqrt(lens.fx * lens.fy) * 0.5 * *target.diameter_mm / disc.centre.z() * std::max(cosine, 1e-3);
    square += variance.times_px(cosine) / semi_minor;
  }
  view.weight = 1 / square;
  return view;
}

/// Information with the map's own error in it and without, and what ties the pose to the rig's parameters.
struct Equations {
  Mat6 whole = Mat6::Zero(), of_centres = Mat6::Zero();
  MatX cross;  // Σ Jᵀ W ∂px/∂(rig)
};

Result<Equations, AccuracyFailure> equations_of(std::span<const Target> targets,
                                                const std::array<TargetMask, 2>& seen,
                                                const RigidMotion& tracker_from_body, const StereoRig& rig,
                                                const AccuracyOptions& options) {
  require(targets.size() <= kMaxTargets, "a body has at most 64 targets");
  const CentreVariance variance(options);
  const Mat3 tracker_from_body_rotation = tracker_from_body.rotation.toRotationMatrix();
  Equations sum;
  sum.cross = MatX::Zero(6, rig.covariance.cols());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Mat6 own = Mat6::Zero();
    Mat3 place = Mat3::Zero();
    Mat36 tied = Mat36::Zero();
    MatX place_by_rig = MatX::Zero(3, rig.covariance.cols());
    for (const Side side : {Side::Left, Side::Right}) {
      const TargetMask counts =
          options.single_views ? seen[static_cast<std::size_t>(side)] : seen[0] & seen[1];
      if ((counts >> i & 1U) == 0) continue;
      const auto view = view_of(targets[i], side, tracker_from_body, rig, variance);
      if (!view) return because(AccuracyFailure::BehindCamera);
      own += view->weight * view->by_pose.transpose() * view->by_pose;
      place += view->weight * view->by_point.transpose() * view->by_point;
      tied += view->weight * view->by_point.transpose() * view->by_pose;
      if (rig.covariance.size() == 0) continue;
      const Mat3 tracker_from_camera = rig.camera_from_tracker(side).rotation.conjugate().toRotationMatrix();
      const MatX by_rig = pixel_by_rig(rig, side, view->in_tracker, view->by_point * tracker_from_camera);
      sum.cross += view->weight * view->by_pose.transpose() * by_rig;
      place_by_rig += view->weight * view->by_point.transpose() * by_rig;
    }
    sum.of_centres += own;
    sum.whole += own;
    if (const auto map = target_for_lanes(targets[i], options).map) {
      const Mat3 in_tracker = tracker_from_body_rotation * *map * tracker_from_body_rotation.transpose();
      const Mat3 shared = in_tracker * (Mat3::Identity() + place * in_tracker).inverse();
      sum.whole -= tied.transpose() * shared * tied;
      sum.cross -= tied.transpose() * shared * place_by_rig;
    }
  }
  return sum;
}

}  // namespace

Result<Mat6, AccuracyFailure> pose_information(std::span<const Target> targets,
                                               const std::array<TargetMask, 2>& seen,
                                               const RigidMotion& tracker_from_body, const StereoRig& rig,
                                               const AccuracyOptions& options) {
  const auto equations = equations_of(targets, seen, tracker_from_body, rig, options);
  if (!equations) return because(equations.error());
  return equations->whole;
}

Result<PoseAccuracy, AccuracyFailure> predict_pose_accuracy(std::span<const Target> targets,
                                                            const std::array<TargetMask, 2>& seen,
                                                            const RigidMotion& tracker_from_body,
                                                            const StereoRig& rig,
                                                            const AccuracyOptions& options) {
  const auto equations = equations_of(targets, seen, tracker_from_body, rig, options);
  if (!equations) return because(equations.error());
  const auto whole = inverse_positive(equations->whole);
  const auto of_centres = inverse_positive(equations->of_centres);
  if (!whole || !of_centres) return because(AccuracyFailure::NotDetermined);
  PoseAccuracy accuracy{*whole, *whole - *of_centres};
  const double max_sigma = rad_from_deg(options.max_sigma_deg);
  if (!(whole->topLeftCorner<3, 3>().trace() <= max_sigma * max_sigma)) {
    return because(AccuracyFailure::NotDetermined);
  }
  if (rig.covariance.size() > 0) {
    const MatX by = *whole * equations->cross;
    const Mat6 of_rig = by * rig.covariance * by.transpose();
    accuracy.covariance += of_rig;
    accuracy.systematic += of_rig;
  }
  return accuracy;
}

Result<Mat3, AccuracyFailure> predict_point_covariance(const Vec3& in_tracker, const StereoRig& rig,
                                                       double sigma_px) {
  Mat3 information = Mat3::Zero();
  for (const Side side : {Side::Left, Side::Right}) {
    const RigidMotion camera_from_tracker = rig.camera_from_tracker(side);
    const auto image = project(rig.lens(side), camera_from_tracker * in_tracker);
    if (!image) return because(AccuracyFailure::BehindCamera);
    const Mat23 by_point = image->by_point * camera_from_tracker.rotation.toRotationMatrix();
    information += by_point.transpose() * by_point / (sigma_px * sigma_px);
  }
  const auto covariance = inverse_positive(MatX(information));
  if (!covariance) return because(AccuracyFailure::NotDetermined);
  return Mat3(*covariance);
}

double error_at_point_mm(const RigidMotion& tracker_from_body, const Mat6& covariance, const Vec3& in_body) {
  return std::sqrt(covariance_of_point(tracker_from_body, covariance, in_body).trace());
}

}  // namespace asterism
