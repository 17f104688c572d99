// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/scanning/alignment.hpp"
#include "asterism/scanning/free_motions.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

/// The part's place, with what its points say there.
struct Fit {
  RigidMotion platform_from_workpiece;
  double chi2 = 0;
  std::vector<double> residuals_mm;
  Mat6 information = Mat6::Zero();  // of (ω, δ) at the points' mean, in the part's frame
  Vec6 pull = Vec6::Zero();
  Vec3 about = Vec3::Zero();
  double reach_mm = 1;
};

/// Empty when a point lies too far off the surface.
std::optional<Fit> fit_at(const RigidMotion& pose, std::span<const ProbedPoint> probed,
                          const SurfaceTree& surface, const BestFitOptions& options) {
  Fit fit;
  fit.platform_from_workpiece = pose;
  const RigidMotion back = pose.inverse();
  std::vector<Vec3> places;
  for (const ProbedPoint& point : probed) {
    places.push_back(back * point.in_platform);
    fit.about += places.back() / static_cast<double>(probed.size());
  }
  for (std::size_t i = 0; i < probed.size(); ++i) {
    const auto nearest = surface.nearest(places[i], options.within_mm);
    if (!nearest) return std::nullopt;
    const double off = nearest->signed_distance_mm - options.ball_mm;
    const Vec3 normal = back.rotation.conjugate() * nearest->normal;
    const double variance = normal.dot(probed[i].covariance * normal);
    const Vec3 arm = places[i] - fit.about;
    Vec6 slope;
    slope << -arm.cross(nearest->normal), -nearest->normal;
    fit.information += slope * slope.transpose() / variance;
    fit.pull -= slope * off / variance;
    fit.chi2 += off * off / variance;
    fit.residuals_mm.push_back(off);
    fit.reach_mm = std::max(fit.reach_mm, arm.norm());
  }
  return fit;
}

/// A motion (ω, δ at `about`) of the part in its own frame.
RigidMotion moved_by(const RigidMotion& pose, const Vec6& way, const Vec3& about) {
  const RigidMotion turn = rotation_about(about, exp_rotation(way.head<3>()));
  return pose * RigidMotion{turn.rotation, turn.translation + way.tail<3>()};
}

/// Steps as long as they pay, by Levenberg and Marquardt.
std::optional<Fit> fit_from(const RigidMotion& start, std::span<const ProbedPoint> probed,
                            const SurfaceTree& surface, const BestFitOptions& options) {
  auto fit = fit_at(start, probed, surface, options);
  if (!fit) return std::nullopt;
  double damping = 1e-3;
  for (int step = 0; step < options.most_steps; ++step) {
    Vec6 scale;
    scale << Vec3::Constant(fit->reach_mm * fit->reach_mm), Vec3::Ones();
    const double most = fit->information.bottomRightCorner<3, 3>().trace();
    const auto way =
        solve_positive(Mat6(fit->information + Mat6((damping * most * scale).asDiagonal())), fit->pull);
    if (!way) break;
    const auto next =
        fit_at(moved_by(fit->platform_from_workpiece, *way, fit->about), probed, surface, options);
    constexpr double kStill_mm = 1e-9;
    const double moved_mm = std::max(way->head<3>().norm() * fit->reach_mm, way->tail<3>().norm());
    if (next && next->chi2 <= fit->chi2) {
      fit = next;
      damping = std::max(damping / 5, 1e-12);
    } else {
      damping *= 10;
    }
    if (moved_mm < kStill_mm || damping > 1e6) break;
  }
  return fit;
}

/// How far two places of the part put its points apart, along what is determined.
double apart_mm(const Fit& a, const Fit& b, std::span<const ProbedPoint> probed) {
  double most = 0;
  for (const ProbedPoint& point : probed) {
    most = std::max(most, (a.platform_from_workpiece.inverse() * point.in_platform -
                           b.platform_from_workpiece.inverse() * point.in_platform)
                              .norm());
  }
  return most;
}

}  // namespace

Alignment align_best_fit(std::span<const ProbedPoint> probed, const SurfaceTree& surface,
                         std::span<const RigidMotion> starts, const BestFitOptions& options) {
  constexpr std::size_t kFewest = 6;
  if (probed.size() < kFewest) {
    throw InputError("alignment", fmt::format("a best fit needs {} points at least; there are {}", kFewest,
                                              probed.size()));
  }
  std::vector<Fit> fits;
  for (const RigidMotion& start : starts) {
    if (auto fit = fit_from(start, probed, surface, options)) fits.push_back(std::move(*fit));
  }
  if (fits.empty()) {
    throw MeasurementError(fmt::format(
        "from no start do all points lie within {:g} mm of the surface; a better first guess is needed",
        options.within_mm));
  }
  const auto best =
      std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.chi2 < b.chi2; });
  const Determined determined = determined_by(best->information, best->reach_mm, options.free_mm);
  const double degrees = static_cast<double>(probed.size()) - determined.degrees;
  // Another place fits as well when its χ² is larger by no more than chance makes it.
  constexpr double kRare = 0.001;
  const double scale = std::max(1.0, degrees > 0 ? best->chi2 / degrees : 1.0);
  const double alike = best->chi2 + scale * chi_square_quantile(1 - kRare, 6);
  for (const Fit& other : fits) {
    if (other.chi2 > alike || !determined.free.empty()) continue;
    if (apart_mm(*best, other, probed) < options.free_mm) continue;
    const Vec3 turn = log_rotation(best->platform_from_workpiece.rotation.conjugate() *
                                   other.platform_from_workpiece.rotation);
    throw MeasurementError(
        fmt::format("the part fits in two ways that differ by a turn of {:.1f}°; probe a feature that tells "
                    "them apart, or give a first guess",
                    deg_from_rad(turn.norm())));
  }
  Alignment alignment;
  alignment.method = "best fit";
  alignment.points = probed.size();
  alignment.platform_from_workpiece = best->platform_from_workpiece;
  alignment.residuals_mm = best->residuals_mm;
  alignment.chi2 = best->chi2;
  alignment.degrees = degrees;
  double sum = 0;
  for (const double off : best->residuals_mm) sum += off * off;
  alignment.rms_mm = std::sqrt(sum / static_cast<double>(probed.size()));
  for (const Vec6& motion : determined.free) {
    alignment.not_determined.push_back(words_of(motion, best->about, best->reach_mm));
  }
  // From the points' mean to the part's origin, and to the platform's axes.
  Mat6 to_origin = Mat6::Identity();
  to_origin.bottomLeftCorner<3, 3>() = skew(best->about);
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
      best->platform_from_workpiece.rotation.toRotationMatrix();
  const Mat6 jacobian = turn * to_origin;
  alignment.covariance = jacobian * determined.inverse * jacobian.transpose();
  if (degrees >= 1 && chi_square_tail(best->chi2, degrees) < kRare)
    alignment.covariance *= best->chi2 / degrees;
  return alignment;
}

}  // namespace asterism
