// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/pose_model.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {

/// A pose with what all its views share.
struct PoseProblem::Attitude {
  Mat3 rotation;
  Vec3 translation;

  explicit Attitude(const RigidMotion& motion)
      : rotation(motion.rotation.toRotationMatrix()), translation(motion.translation) {}
};

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  information += other.information;
  gradient += other.gradient;
  chi_square += other.chi_square;
  views += other.views;
  return *this;
}

PoseProblem::PoseProblem(const Body& body, std::span<const TargetView> views, const StereoRig& rig,
                         const PoseOptions& options)
    : rig_(rig), right_from_left_(rig.right_from_left.rotation.toRotationMatrix()) {
  const double floor = options.sigma_floor_px * options.sigma_floor_px;
  views_.reserve(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const TargetView& view = views[i];
    require(view.target >= 0 && static_cast<std::size_t>(view.target) < body.targets.size(),
            "a view names a target of its body");
    const Mat2 covariance = view.covariance + floor * Mat2::Identity();
    require(covariance.determinant() > 0 && covariance(0, 0) > 0, "a view's covariance is positive definite");
    views_.push_back({&body.targets[static_cast<std::size_t>(view.target)], static_cast<int>(i), view.side,
                      true, view.px, covariance.inverse()});
  }
  std::sort(views_.begin(), views_.end(), [](const View& a, const View& b) {
    return a.target != b.target ? a.target < b.target : a.side < b.side;
  });
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const bool same = i > 0 && views_[i].target == views_[i - 1].target;
    require(!same || views_[i].side != views_[i - 1].side, "a target has at most one view in a camera");
    if (same) {
      groups_.back().last = i + 1;
    } else {
      groups_.push_back({i, i + 1});
    }
  }
}

bool PoseProblem::linearise(const Attitude& attitude, const View& view, LinearView& out) const {
  const Target& target = *view.target;
  const bool left = view.side == Side::Left;
  const Vec3 arm = attitude.rotation * target.position;
  out.in_tracker = arm + attitude.translation;
  Disc disc{out.in_tracker, Vec3::UnitZ(), target.imaged_radius_mm()};
  Vec3 normal = Vec3::Zero();
  if (target.normal) normal = attitude.rotation * *target.normal;
  if (!left) disc.centre = right_from_left_ * disc.centre + rig_.right_from_left.translation;
  if (target.normal) disc.normal = left ? normal : Vec3(right_from_left_ * normal);
  out.facing = target.normal ? -disc.normal.dot(disc.centre) / disc.centre.norm() : 1.0;

  const auto image = project_disc_centre(left ? rig_.left : rig_.right, disc);
  if (!image) return false;
  out.residual = view.px - image->px;
  out.by_point = left ? image->by_centre : Mat23(image->by_centre * right_from_left_);
  // g · (ω × a) = (a × g) · ω.
  for (int row = 0; row < 2; ++row) {
    out.by_pose.block<1, 3>(row, 0) = arm.cross(out.by_point.row(row).transpose()).transpose();
  }
  out.by_pose.rightCols<3>() = out.by_point;
  if (disc.radius > 0) {
    const Mat23 by_normal = left ? image->by_normal : Mat23(image->by_normal * right_from_left_);
    for (int row = 0; row < 2; ++row) {
      out.by_pose.block<1, 3>(row, 0) += normal.cross(by_normal.row(row).transpose()).transpose();
    }
  }
  return true;
}

bool PoseProblem::add_group(const Attitude& attitude, const Group& group, NormalEquations& sum) const {
  const std::optional<Mat3>& own = views_[group.first].target->covariance;
  Mat3 a = Mat3::Zero();
  Mat36 b = Mat36::Zero();
  Vec3 u = Vec3::Zero();
  for (std::size_t i = group.first; i < group.last; ++i) {
    const View& view = views_[i];
    if (!view.used) continue;
    LinearView at;
    if (!linearise(attitude, view, at)) return false;
    const Mat26 weighted = view.weight * at.by_pose;
    sum.information.noalias() += at.by_pose.transpose() * weighted;
    sum.gradient.noalias() += weighted.transpose() * at.residual;
    sum.chi_square += at.residual.dot(view.weight * at.residual);
    ++sum.views;
    if (!own) continue;
    const Mat23 by = view.weight * at.by_point;
    a += at.by_point.transpose() * by;
    b += at.by_point.transpose() * weighted;
    u += by.transpose() * at.residual;
  }
  if (!own) return true;
  // The target's own error is common to its views: (W⁻¹ + G C Gᵀ)⁻¹ = W − W G C (I + A C)⁻¹ Gᵀ W.
  const Mat3 c = attitude.rotation * *own * attitude.rotation.transpose();
  const Mat3 m = c * (Mat3::Identity() + a * c).inverse();
  sum.information -= b.transpose() * m * b;
  sum.gradient -= b.transpose() * m * u;
  sum.chi_square -= u.dot(m * u);
  return true;
}

std::optional<NormalEquations> PoseProblem::at(const RigidMotion& tracker_from_body) const {
  const Attitude attitude(tracker_from_body);
  NormalEquations sum;
  for (const Group& group : groups_) {
    if (!add_group(attitude, group, sum)) return std::nullopt;
  }
  return sum;
}

std::optional<NormalEquations> PoseProblem::at(const RigidMotion& tracker_from_body,
                                               std::size_t group) const {
  NormalEquations share;
  if (!add_group(Attitude(tracker_from_body), groups_[group], share)) return std::nullopt;
  return share;
}

std::optional<LinearView> PoseProblem::linearised(const RigidMotion& tracker_from_body,
                                                  std::size_t view) const {
  LinearView at;
  if (!linearise(Attitude(tracker_from_body), views_[view], at)) return std::nullopt;
  return at;
}

int PoseProblem::targets_used() const {
  return static_cast<int>(std::count_if(groups_.begin(), groups_.end(), [this](const Group& group) {
    return views_[group.first].used || views_[group.last - 1].used;
  }));
}

int PoseProblem::targets_in_both() const {
  return static_cast<int>(std::count_if(groups_.begin(), groups_.end(), [this](const Group& group) {
    return group.last - group.first == 2 && views_[group.first].used && views_[group.last - 1].used;
  }));
}

Result<PoseFit, PoseFailure> minimise(const PoseProblem& problem, const RigidMotion& start,
                                      int max_iterations) {
  // χ² that a step gains (a tenth of a sigma) below which it is the last: what remains after it is of second
  // order.
  constexpr double kSettled = 1e-2;
  PoseFit fit{start, {}};
  auto here = problem.at(start);
  if (!here) return because(PoseFailure::BehindCamera);
  double damping = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Mat6 damped = here->information;
    damped.diagonal() *= 1.0 + damping;
    const auto step = solve_positive(damped, here->gradient);
    if (!step) return because(PoseFailure::NotDetermined);
    const double gain = step->dot(here->gradient);
    if (damping == 0 && gain < kSettled) {
      fit.pose = perturbed(fit.pose, *step);
      fit.equations = *here;
      fit.equations.gradient.setZero();
      fit.equations.chi_square -= gain;
      return fit;
    }
    const RigidMotion moved = perturbed(fit.pose, *step);
    auto there = problem.at(moved);
    if (there && there->chi_square <= here->chi_square * (1 + 1e-12)) {
      fit.pose = moved;
      here = there;
      damping = damping < 1e-5 ? 0 : 0.1 * damping;
    } else {
      damping = std::max(1e-4, 10 * damping);
      if (damping > 1e9) break;
    }
  }
  return because(PoseFailure::NoConvergence);
}

namespace {

Mat3 mirror(const Vec3& unit) { return Mat3::Identity() - 2.0 * unit * unit.transpose(); }

/// The poses to look from: the body seen with its depth turned over by each camera, and turned about the
/// line along which its targets lie most.
std::vector<RigidMotion> other_starts(const PoseProblem& problem, const RigidMotion& pose) {
  Vec3 mean = Vec3::Zero();
  std::vector<Vec3> points;
  for (const auto& group : problem.groups()) {
    if (!problem.used(group.first) && !problem.used(group.last - 1)) continue;
    points.push_back(pose * problem.target(group.first).position);
    mean += points.back();
  }
  mean /= static_cast<double>(points.size());
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& point : points) scatter += (point - mean) * (point - mean).transpose();
  const SymmetricEigen3 axes = symmetric_eigen(scatter);
  const Vec3 thin = axes.vectors.col(0), long_axis = axes.vectors.col(2);

  std::vector<RigidMotion> starts;
  const auto add = [&](const Mat3& turn) {
    starts.push_back(rotation_about(mean, quaternion_from_matrix(turn)) * pose);
  };
  const Vec3 right_eye = problem.rig().right_from_left.inverse().translation;
  for (const Vec3& eye : {Vec3(Vec3::Zero()), right_eye, Vec3(0.5 * right_eye)}) {
    add(mirror((mean - eye).normalized()) * mirror(thin));
  }
  for (const double angle : {0.5, 1.0, 1.5}) {
    add(exp_rotation(angle * std::numbers::pi * long_axis).toRotationMatrix());
  }
  return starts;
}

}  // namespace

std::optional<PoseFit> other_minimum(const PoseProblem& problem, const PoseFit& fit, double gate,
                                     int max_iterations) {
  std::optional<PoseFit> best;
  for (const RigidMotion& start : other_starts(problem, fit.pose)) {
    const auto other = minimise(problem, start, max_iterations);
    if (!other || !(other->equations.chi_square < fit.equations.chi_square + gate)) continue;
    const Vec6 apart = difference(other->pose, fit.pose);
    // The same minimum reached from elsewhere lies within a small part of its own sigma.
    if (apart.dot(fit.equations.information * apart) < 25.0) continue;
    if (!best || other->equations.chi_square < best->equations.chi_square) best = *other;
  }
  return best;
}

}  // namespace asterism
