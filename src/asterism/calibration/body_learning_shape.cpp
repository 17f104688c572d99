// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/camera/disc_image.hpp"

namespace asterism {
namespace {

constexpr int kDirections = 300;        // of the hemisphere tried: about 8° apart
constexpr std::size_t kMostTried = 60;  // views used there
constexpr int kIterations = 15;
constexpr double kHuber = 2.5;
constexpr double kLargestSigma_rad = rad_from_deg(10.0);
constexpr double kLargestMisfit = 8.0;  // RMS of the weighted residuals: no disc looks like that

struct ShapeView {
  const Lens* lens;
  RigidMotion camera_from_body;
  Vec3 centre_in_camera;
  Vec3 measured;  // mean radius, elongation along x, along the diagonal; px
  Vec3 sigma;
};

/// The square root of the ellipse's shape matrix, as numbers of like error.
Vec3 shape_numbers(const Ellipse& ellipse) {
  const double mean = 0.5 * (ellipse.semi_major + ellipse.semi_minor);
  const double elongation = 0.5 * (ellipse.semi_major - ellipse.semi_minor);
  return {mean, elongation * std::cos(2 * ellipse.angle_rad), elongation * std::sin(2 * ellipse.angle_rad)};
}

std::vector<ShapeView> shape_views(const StereoRig& rig, const BodyModel& model, std::size_t target,
                                   const std::vector<BodyView>& views, double shape_error_px) {
  constexpr std::uint32_t kNoEllipse = kOccluded | kBorder | kTouching | kCoarse;
  std::vector<ShapeView> usable;
  for (const BodyView& view : views) {
    const Ellipse& ellipse = view.centre.ellipse;
    if (view.target != target || view.rejected || (view.centre.flags & kNoEllipse) != 0) continue;
    if (!(ellipse.semi_minor > 0)) continue;
    const RigidMotion camera_from_body =
        rig.camera_from_tracker(view.side) * model.tracker_from_body[view.frame];
    // An edge fit knows the mean radius √2 better than a coordinate of the centre, an elongation as well.
    const double centre = 0.5 * view.centre.covariance.trace();
    const double floor = shape_error_px * shape_error_px;
    usable.push_back({&rig.lens(view.side), camera_from_body, camera_from_body * model.positions[target],
                      shape_numbers(ellipse),
                      Vec3(0.5 * centre + floor, centre + floor, centre + floor).cwiseSqrt()});
  }
  return usable;
}

std::optional<Vec3> expected(const ShapeView& view, const Vec3& normal, double radius_mm) {
  const auto image = image_of_disc(
      *view.lens, Disc{view.centre_in_camera, view.camera_from_body.rotation * normal, radius_mm});
  if (!image) return std::nullopt;
  return shape_numbers(*image);
}

struct Misfit {
  double square;  // mean of the weighted squares
  double radius_mm;
};

/// The best radius for one normal: to first order an image grows with the disc.
std::optional<Misfit> misfit_of(const std::vector<ShapeView>& views, const Vec3& normal) {
  constexpr double kTrial_mm = 1.0;
  const std::size_t stride = 1 + views.size() / kMostTried;
  double along = 0, own = 0, measured = 0;
  int count = 0;
  for (std::size_t v = 0; v < views.size(); v += stride) {
    const auto unit = expected(views[v], normal, kTrial_mm);
    if (!unit) return std::nullopt;
    const Vec3 e = unit->cwiseQuotient(views[v].sigma), m = views[v].measured.cwiseQuotient(views[v].sigma);
    along += e.dot(m);
    own += e.squaredNorm();
    measured += m.squaredNorm();
    count += 3;
  }
  if (!(along > 0)) return std::nullopt;
  return Misfit{(measured - along * along / own) / count, kTrial_mm * along / own};
}

Vec3 mean_direction_to_cameras(const std::vector<ShapeView>& views) {
  Vec3 sum = Vec3::Zero();
  for (const ShapeView& view : views) {
    sum -= view.camera_from_body.rotation.conjugate() * view.centre_in_camera.normalized();
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3::UnitZ();
}

struct Start {
  Vec3 normal;
  double radius_mm;
};

std::optional<Start> best_of_hemisphere(const std::vector<ShapeView>& views) {
  const Vec3 towards = mean_direction_to_cameras(views);
  const Quaternion turn = Quaternion::FromTwoVectors(Vec3::UnitZ(), towards);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::optional<Start> best;
  double least = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (i + 0.5) / kDirections;
    const double ring = std::sqrt(1 - z * z);
    const Vec3 normal = turn * Vec3(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
    const auto misfit = misfit_of(views, normal);
    if (!misfit || (best && misfit->square >= least)) continue;
    least = misfit->square;
    best = Start{normal, misfit->radius_mm};
  }
  return best;
}

Vec3 turned(const Vec3& normal, const Vec3& u, const Vec3& v, double by_u, double by_v) {
  return (normal + by_u * u + by_v * v).normalized();
}

struct Normal3 {
  Mat3 information = Mat3::Zero();
  Vec3 gradient = Vec3::Zero();
  double cost = 0, squares_px = 0, squares = 0;
};

/// Normal equations over two tilts and the radius; slopes by central differences.
std::optional<Normal3> linearise(const std::vector<ShapeView>& views, const Start& at, const Vec3& u,
                                 const Vec3& v) {
  constexpr double kStep = 1e-4;
  Normal3 sum;
  for (const ShapeView& view : views) {
    const auto here = expected(view, at.normal, at.radius_mm);
    const auto up = expected(view, turned(at.normal, u, v, kStep, 0), at.radius_mm);
    const auto down = expected(view, turned(at.normal, u, v, -kStep, 0), at.radius_mm);
    const auto left = expected(view, turned(at.normal, u, v, 0, kStep), at.radius_mm);
    const auto right = expected(view, turned(at.normal, u, v, 0, -kStep), at.radius_mm);
    if (!here || !up || !down || !left || !right) return std::nullopt;
    const Vec3 whitening = view.sigma.cwiseInverse();
    Mat3 jacobian;
    jacobian << (*up - *down) / (2 * kStep), (*left - *right) / (2 * kStep), *here / at.radius_mm;
    jacobian = whitening.asDiagonal() * jacobian;
    const Vec3 residual = whitening.cwiseProduct(view.measured - *here);
    const double norm = residual.norm();
    const double weight = norm <= kHuber ? 1.0 : kHuber / norm;
    sum.information += weight * jacobian.transpose() * jacobian;
    sum.gradient += weight * jacobian.transpose() * residual;
    sum.cost += norm <= kHuber ? norm * norm : kHuber * (2 * norm - kHuber);
    sum.squares += weight * norm * norm;
    sum.squares_px += weight * (view.measured - *here).squaredNorm();
  }
  return sum;
}

}  // namespace

Result<DiscShape, ShapeFailure> fit_disc_shape(const StereoRig& rig, const BodyModel& model,
                                               std::size_t target, const std::vector<BodyView>& views,
                                               double shape_error_px) {
  const auto usable = shape_views(rig, model, target, views, shape_error_px);
  if (usable.size() < 2) return because(ShapeFailure::TooFewEllipses);
  auto at = best_of_hemisphere(usable);
  if (!at) return because(ShapeFailure::NoDisc);

  Normal3 last;
  double damping = 1e-3;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Vec3 u = at->normal.unitOrthogonal(), v = at->normal.cross(u);
    const auto sum = linearise(usable, *at, u, v);
    if (!sum) return because(ShapeFailure::NoDisc);
    last = *sum;
    Mat3 damped = sum->information;
    damped.diagonal() *= 1 + damping;
    if (!(damped.determinant() > 0)) return because(ShapeFailure::Undetermined);
    const Vec3 step = damped.inverse() * sum->gradient;
    const Start next{turned(at->normal, u, v, step.x(), step.y()), at->radius_mm + step.z()};
    const auto there = next.radius_mm > 0 ? linearise(usable, next, u, v) : std::nullopt;
    if (!there || there->cost > sum->cost) {
      damping *= 10;
      continue;
    }
    at = next;
    damping = std::max(1e-9, 0.1 * damping);
    if (step.head<2>().norm() < 1e-8) break;
  }

  const auto degrees = 3.0 * static_cast<double>(usable.size()) - 3.0;
  const double factor = last.squares / degrees;
  if (std::sqrt(factor) > kLargestMisfit) return because(ShapeFailure::NoDisc);
  if (!(last.information.determinant() > 0)) return because(ShapeFailure::Undetermined);
  const Mat3 covariance = last.information.inverse() * std::max(1.0, factor);
  const double normal_sigma =
      std::sqrt(symmetric_eigen(Mat2(covariance.topLeftCorner<2, 2>())).values.maxCoeff());
  if (!(normal_sigma < kLargestSigma_rad)) return because(ShapeFailure::Undetermined);
  const double facing = at->normal.dot(mean_direction_to_cameras(usable)) < 0 ? -1.0 : 1.0;
  return DiscShape{facing * at->normal, at->radius_mm, normal_sigma, std::sqrt(covariance(2, 2)),
                   std::sqrt(last.squares_px / (3.0 * static_cast<double>(usable.size())))};
}

}  // namespace asterism
