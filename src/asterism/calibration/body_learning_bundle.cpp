// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_bundle.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/camera/disc_image.hpp"

namespace asterism {
namespace {

constexpr double kHuber = 3.0;    // sigmas; the norm of a 2-vector exceeds it once in 90
constexpr double kRefusal = 5.0;  // robust sigmas; once in 270,000
constexpr int kLeastViews = 4;    // of a frame: three give a pose, the fourth checks it
constexpr int kIterations = 30;

/// Residual of one view, whitened.
struct Residual {
  Vec2 whitened;
  Eigen::Matrix<double, 2, 3> by_position;
  Mat26 by_pose;
  Mat2 whitener;  // Wᵀ W = covariance⁻¹
};

Mat2 whitener_of(const Mat2& covariance) {
  // Inverse of the lower Cholesky factor, by hand: 2×2.
  const double l11 = std::sqrt(covariance(0, 0));
  const double l21 = covariance(1, 0) / l11;
  const double l22 = std::sqrt(covariance(1, 1) - l21 * l21);
  Mat2 inverse;
  inverse << 1 / l11, 0, -l21 / (l11 * l22), 1 / l22;
  return inverse;
}

Result<Residual, LensFailure> residual_of(const StereoRig& rig, const BodyModel& model,
                                          const BodyView& view) {
  const auto expected = expect_view(rig, model, view.frame, view.target, view.side);
  if (!expected) return because(expected.error());
  const Mat2 whitener = whitener_of(view.centre.covariance);
  return Residual{whitener * (view.centre.px() - expected->px), whitener * expected->by_position,
                  whitener * expected->by_pose, whitener};
}

double huber_weight(double norm) { return norm <= kHuber ? 1.0 : kHuber / norm; }
double huber_cost(double norm) { return norm <= kHuber ? norm * norm : kHuber * (2 * norm - kHuber); }

/// Normal equations with the poses eliminated. `rig_columns` > 0 also gathers the coupling to the rig's
/// parameters.
struct Reduced {
  MatX information;                 // 3N × 3N
  VecX gradient;                    // 3N
  MatX by_rig;                      // 3N × parameters of the rig
  std::vector<Mat6> inverse_poses;  // of the undamped blocks, given the coordinates
  std::vector<Vec6> pose_gradients;
  std::vector<MatX> pose_coupling;  // 6 × 3N
};

struct Assembly {
  const StereoRig& rig;
  const BodyModel& model;
  const std::vector<BodyView>& views;
  bool robust;
  double damping;
  bool with_rig;
};

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

bool assemble(const Assembly& in, Reduced& reduced) {
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

BodyModel stepped(const BodyModel& model, const Reduced& reduced, const VecX& step) {
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
    Reduced reduced;
    if (!assemble({rig, model, views, true, damping, false}, reduced)) return false;
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
std::optional<MatX> covariance_held(const Reduced& reduced, const std::vector<Vec3>& positions) {
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

Result<BundleSummary, BundleFailure> bundle_body(const StereoRig& rig, BodyModel& model,
                                                 std::vector<BodyView>& views) {
  if (!enough_views(model, views)) return because(BundleFailure::TooFewViews);
  if (!minimise(rig, model, views)) return because(BundleFailure::Singular);
  BundleSummary summary;
  summary.rejected = refuse_far_views(rig, model, views);
  if (!enough_views(model, views)) return because(BundleFailure::TooFewViews);
  if (!minimise(rig, model, views)) return because(BundleFailure::Singular);

  Reduced reduced;
  if (!assemble({rig, model, views, false, 0.0, rig.covariance.size() > 0}, reduced)) {
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
