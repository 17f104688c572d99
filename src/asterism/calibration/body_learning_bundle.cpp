// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_bundle.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/calibration/body_learning_equations.hpp"

namespace asterism {
namespace {

constexpr double kRefusal = 5.0;  // robust sigmas; once in 270,000
constexpr int kLeastViews = 4;    // of a frame: three give a pose, the fourth checks it
constexpr int kIterations = 30;

/// Rows: the sum of all shifts, and the sum of p × shift. Zero for a change that neither moves nor turns
/// the targets as a whole (inner constraints).
MatX inner_constraints(const std::vector<Vec3>& positions) {
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : positions) centroid += p / static_cast<double>(positions.size());
  double spread = 0;
  for (const Vec3& p : positions) spread = std::max(spread, (p - centroid).norm());
  MatX rows = MatX::Zero(6, static_cast<Eigen::Index>(3 * positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    rows.block<3, 3>(0, at) = Mat3::Identity();
    rows.block<3, 3>(3, at) = skew((positions[i] - centroid) / spread);
  }
  return rows;
}

/// The reduced information knows nothing of where the frame is; the constraints hold it there.
MatX held(const MatX& information, const MatX& constraints) {
  const double scale = information.diagonal().mean();
  return information + scale * constraints.transpose() * constraints;
}

double robust_cost(const StereoRig& rig, const BodyModel& model, const std::vector<BodyView>& views) {
  double cost = 0;
  for (const BodyView& view : views) {
    if (view.rejected) continue;
    const auto residual = residual_of(rig, model, view);
    cost += residual ? huber_cost(residual->whitened.norm()) : 1e9;
  }
  return cost;
}

BodyModel stepped(const BodyModel& model, const ReducedEquations& reduced, const VecX& step) {
  BodyModel next = model;
  for (std::size_t i = 0; i < next.positions.size(); ++i) {
    next.positions[i] += step.segment<3>(static_cast<Eigen::Index>(3 * i));
  }
  for (std::size_t f = 0; f < next.tracker_from_body.size(); ++f) {
    const Vec6 pose_step =
        reduced.inverse_poses[f] * (reduced.pose_gradients[f] - Vec6(reduced.pose_coupling[f] * step));
    next.tracker_from_body[f] = perturbed(next.tracker_from_body[f], pose_step);
  }
  return next;
}

bool minimise(const StereoRig& rig, BodyModel& model, const std::vector<BodyView>& views) {
  double cost = robust_cost(rig, model, views);
  double damping = 1e-6;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    ReducedEquations reduced;
    if (!assemble_equations({rig, model, views, true, damping, false}, reduced)) return false;
    MatX information = held(reduced.information, inner_constraints(model.positions));
    information.diagonal() *= 1 + damping;
    const auto step = solve_positive(information, reduced.gradient);
    if (!step) return false;
    BodyModel next = stepped(model, reduced, *step);
    const double next_cost = robust_cost(rig, next, views);
    if (next_cost > cost) {
      damping = std::max(1e-4, 10 * damping);
      if (damping > 1e6) break;
      continue;
    }
    const bool done = cost - next_cost <= 1e-9 * (1 + cost);
    model = std::move(next);
    cost = next_cost;
    damping = std::max(1e-9, 0.1 * damping);
    if (done) break;
  }
  return true;
}

/// Refuses views beyond kRefusal times the robust spread of all. Returns how many.
int refuse_far_views(const StereoRig& rig, const BodyModel& model, std::vector<BodyView>& views) {
  std::vector<double> norms(views.size(), 0.0);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto residual = residual_of(rig, model, views[v]);
    norms[v] = residual ? residual->whitened.norm() : 1e9;
  }
  std::vector<double> sorted = norms;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double sigma =
      std::max(1.0, sorted[sorted.size() / 2] / 1.17741);  // the median norm of a normal 2-vector
  std::vector<int> left(model.tracker_from_body.size(), 0);
  for (std::size_t v = 0; v < views.size(); ++v) {
    views[v].rejected = norms[v] > kRefusal * sigma;
    if (!views[v].rejected) ++left[views[v].frame];
  }
  int rejected = 0;
  for (BodyView& view : views) {
    if (left[view.frame] < kLeastViews) view.rejected = true;
    rejected += view.rejected ? 1 : 0;
  }
  return rejected;
}

bool enough_views(const BodyModel& model, const std::vector<BodyView>& views) {
  std::vector<int> of_target(model.positions.size(), 0), of_frame(model.tracker_from_body.size(), 0);
  for (const BodyView& view : views) {
    if (view.rejected) continue;
    ++of_target[view.target];
    ++of_frame[view.frame];
  }
  const auto located = [](int count) { return count >= 2; };
  const auto posed_or_empty = [](int count) { return count == 0 || count >= kLeastViews; };
  return std::all_of(of_target.begin(), of_target.end(), located) &&
         std::all_of(of_frame.begin(), of_frame.end(), posed_or_empty);
}

/// Covariance of the coordinates with the inner constraints held: (H + s CᵀC)⁻¹ holds them to within
/// N (CN)⁻¹ s⁻¹ (CN)⁻ᵀ Nᵀ, N the directions of a rigid motion, which is taken off.
std::optional<MatX> covariance_held(const ReducedEquations& reduced, const std::vector<Vec3>& positions) {
  const MatX constraints = inner_constraints(positions);
  const double scale = reduced.information.diagonal().mean();
  const auto inverse = inverse_positive(held(reduced.information, constraints));
  if (!inverse) return std::nullopt;
  // A rigid motion moves the targets along the constraints' own rows: N = Cᵀ.
  const auto gram = inverse_positive(MatX(constraints * constraints.transpose()));
  if (!gram) return std::nullopt;
  const MatX back = constraints.transpose() * *gram;
  return MatX(*inverse - back * back.transpose() / scale);
}

}  // namespace

Result<BundleSummary, BundleFailure> bundle_body(const StereoRig& rig, BodyModel& model,
                                                 std::vector<BodyView>& views) {
  if (!enough_views(model, views)) return because(BundleFailure::TooFewViews);
  if (!minimise(rig, model, views)) return because(BundleFailure::Singular);
  BundleSummary summary;
  summary.rejected = refuse_far_views(rig, model, views);
  if (!enough_views(model, views)) return because(BundleFailure::TooFewViews);
  if (!minimise(rig, model, views)) return because(BundleFailure::Singular);

  ReducedEquations reduced;
  if (!assemble_equations({rig, model, views, false, 0.0, rig.covariance.size() > 0}, reduced)) {
    return because(BundleFailure::Singular);
  }
  double chi_square = 0, squares = 0;
  std::size_t used = 0;
  for (const BodyView& view : views) {
    if (view.rejected) continue;
    const auto residual = residual_of(rig, model, view);
    if (!residual) return because(BundleFailure::Singular);
    chi_square += residual->whitened.squaredNorm();
    squares += (residual->whitener.inverse() * residual->whitened).squaredNorm();
    ++used;
  }
  const auto posed = std::count_if(reduced.inverse_poses.begin(), reduced.inverse_poses.end(),
                                   [](const Mat6& inverse) { return inverse.trace() > 0; });
  const double unknowns =
      3.0 * static_cast<double>(model.positions.size()) + 6.0 * static_cast<double>(posed) - 6.0;
  const double degrees = 2.0 * static_cast<double>(used) - unknowns;
  summary.variance_factor = degrees > 0 ? chi_square / degrees : 1.0;
  summary.rms_px = std::sqrt(squares / (2.0 * static_cast<double>(used)));

  const auto covariance = covariance_held(reduced, model.positions);
  if (!covariance) return because(BundleFailure::Singular);
  summary.covariance = *covariance * std::max(1.0, summary.variance_factor);
  if (rig.covariance.size() > 0) {
    const MatX gain = *covariance * reduced.by_rig;
    summary.covariance += gain * rig.covariance * gain.transpose();
  }
  for (const Mat6& inverse : reduced.inverse_poses) summary.pose_covariances.push_back(inverse);
  return summary;
}

}  // namespace asterism
