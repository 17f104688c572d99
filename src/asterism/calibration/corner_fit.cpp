// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/corner_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr int kParameters = 9;
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
enum Parameter { kX, kY, kAngle1, kAngle2, kBlur, kBase, kAmplitude, kSlopeX, kSlopeY };

struct Sample {
  Vec2 px;
  double grey;
};

struct System {
  Normal normal = Normal::Zero();
  Parameters gradient = Parameters::Zero();
  double squares = 0;
};

/// A pixel's model value and its derivatives.
double model(const Parameters& p, const Vec2& px, Parameters* by) {
  const Vec2 d = px - p.head<2>();
  const double c1 = std::cos(p(kAngle1)), s1 = std::sin(p(kAngle1));
  const double c2 = std::cos(p(kAngle2)), s2 = std::sin(p(kAngle2));
  const double scale = 1.0 / (std::sqrt(2.0) * p(kBlur));
  const double u1 = (c1 * d.x() + s1 * d.y()) * scale;
  const double u2 = (c2 * d.x() + s2 * d.y()) * scale;
  const double e1 = std::erf(u1), e2 = std::erf(u2);
  const double light = 1 + p(kSlopeX) * d.x() + p(kSlopeY) * d.y();
  const double contrast = p(kBase) + p(kAmplitude) * e1 * e2;
  if (by == nullptr) return contrast * light;

  constexpr double kSlope = 2.0 * std::numbers::inv_sqrtpi;
  const double by_u1 = p(kAmplitude) * e2 * kSlope * std::exp(-u1 * u1) * light;
  const double by_u2 = p(kAmplitude) * e1 * kSlope * std::exp(-u2 * u2) * light;
  *by << -(by_u1 * c1 + by_u2 * c2) * scale - contrast * p(kSlopeX),
      -(by_u1 * s1 + by_u2 * s2) * scale - contrast * p(kSlopeY), by_u1 * (c1 * d.y() - s1 * d.x()) * scale,
      by_u2 * (c2 * d.y() - s2 * d.x()) * scale, -(by_u1 * u1 + by_u2 * u2) / p(kBlur), light,
      e1 * e2 * light, contrast * d.x(), contrast * d.y();
  return contrast * light;
}

System linearise(const std::vector<Sample>& samples, const Parameters& p) {
  System system;
  Parameters by;
  for (const Sample& sample : samples) {
    const double residual = sample.grey - model(p, sample.px, &by);
    system.normal.noalias() += by * by.transpose();
    system.gradient += residual * by;
    system.squares += residual * residual;
  }
  return system;
}

double sum_of_squares(const std::vector<Sample>& samples, const Parameters& p) {
  double squares = 0;
  for (const Sample& sample : samples) {
    const double residual = sample.grey - model(p, sample.px, nullptr);
    squares += residual * residual;
  }
  return squares;
}

template <class Grey>
std::vector<Sample> samples_near(const Raster<Grey>& image, const CornerStart& start, double reach) {
  const Mat2 square_by_px = start.px_by_square.inverse();
  const Vec2 half = reach * start.px_by_square.cwiseAbs().rowwise().sum();
  const int left = std::max(0, static_cast<int>(std::ceil(start.px.x() - half.x())));
  const int top = std::max(0, static_cast<int>(std::ceil(start.px.y() - half.y())));
  const int right = std::min(image.width - 1, static_cast<int>(start.px.x() + half.x()));
  const int bottom = std::min(image.height - 1, static_cast<int>(start.px.y() + half.y()));
  std::vector<Sample> samples;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec2 px(x, y);
      const Vec2 square = square_by_px * (px - start.px);
      if (square.cwiseAbs().maxCoeff() <= reach) samples.push_back({px, static_cast<double>(image.at(x, y))});
    }
  }
  return samples;
}

/// The angle of the normal of a line that runs along `direction`.
double normal_angle(const Vec2& direction) { return std::atan2(direction.x(), -direction.y()); }

Parameters first_guess(const std::vector<Sample>& samples, const CornerStart& start) {
  Parameters p = Parameters::Zero();
  p.head<2>() = start.px;
  p(kAngle1) = normal_angle(start.px_by_square.col(0));
  p(kAngle2) = normal_angle(start.px_by_square.col(1));
  p(kBlur) = 1.0;
  // With the edges known, base and amplitude are the two quadrant pairs' means.
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (const Sample& sample : samples) {
    const Vec2 d = sample.px - start.px;
    const double side1 = std::cos(p(kAngle1)) * d.x() + std::sin(p(kAngle1)) * d.y();
    const double side2 = std::cos(p(kAngle2)) * d.x() + std::sin(p(kAngle2)) * d.y();
    const int same = side1 * side2 > 0 ? 1 : 0;
    sum[same] += sample.grey;
    ++count[same];
  }
  const double apart = sum[0] / std::max(1, count[0]), same = sum[1] / std::max(1, count[1]);
  p(kBase) = 0.5 * (apart + same);
  p(kAmplitude) = 0.5 * (same - apart);
  return p;
}

/// Levenberg–Marquardt; false when it does not settle.
bool minimise(const std::vector<Sample>& samples, Parameters& p) {
  double damping = 1e-3;
  System at = linearise(samples, p);
  for (int iteration = 0; iteration < 40; ++iteration) {
    Normal damped = at.normal;
    damped.diagonal() *= 1 + damping;
    const auto step = solve_positive(MatX(damped), VecX(at.gradient));
    if (!step) return false;
    Parameters next = p + *step;
    next(kBlur) = std::clamp(next(kBlur), 0.2, 30.0);
    const double squares = sum_of_squares(samples, next);
    if (squares <= at.squares) {
      p = next;
      if (step->head<2>().norm() < 1e-5) return true;
      damping = std::max(1e-9, damping * 0.2);
      at = linearise(samples, p);
    } else {
      if (step->head<2>().norm() < 1e-5) return true;
      damping *= 10;
    }
    if (damping > 1e8) return false;
  }
  return false;
}

/// The corner's covariance by the residuals where the information is: N⁻¹ (Σ r² j jᵀ) N⁻¹. The edges are
/// noisier than the squares (light noise, print), so one variance for all pixels would be too bold.
std::optional<Mat2> covariance_at(const std::vector<Sample>& samples, const Parameters& p) {
  Normal normal = Normal::Zero(), scatter = Normal::Zero();
  Parameters by;
  for (const Sample& sample : samples) {
    const double residual = sample.grey - model(p, sample.px, &by);
    // Rounding to whole grey levels is noise too, which noiseless images would hide.
    const Normal outer = by * by.transpose();
    normal += outer;
    scatter += (residual * residual + 1.0 / 12.0) * outer;
  }
  const auto inverse = inverse_positive(MatX(normal));
  if (!inverse) return std::nullopt;
  const MatX covariance = *inverse * scatter * *inverse;
  const double correction =
      static_cast<double>(samples.size()) / static_cast<double>(samples.size() - kParameters);
  return Mat2(correction * covariance.topLeftCorner<2, 2>());
}

}  // namespace

Result<CornerFit, CornerFailure> fit_corner(const Image& image, const CornerStart& start, double reach) {
  if (!(start.px.x() > 2 && start.px.y() > 2 && start.px.x() < width_of(image) - 3 &&
        start.px.y() < height_of(image) - 3)) {
    return because(CornerFailure::OutsideImage);
  }
  const double shortest = std::min(start.px_by_square.col(0).norm(), start.px_by_square.col(1).norm());
  const double area = std::abs(start.px_by_square.determinant());
  if (!(shortest * reach >= 2.0 && area * reach * reach >= 6.0))
    return because(CornerFailure::SquareTooSmall);

  const auto samples =
      std::visit([&](const auto& raster) { return samples_near(raster, start, reach); }, image);
  if (samples.size() < 2 * kParameters) return because(CornerFailure::SquareTooSmall);
  Parameters p = first_guess(samples, start);
  if (std::abs(p(kAmplitude)) < 1.0) return because(CornerFailure::NoContrast);
  if (!minimise(samples, p)) return because(CornerFailure::NoConvergence);
  if ((p.head<2>() - start.px).norm() > 0.5 * reach * shortest + 1.0)
    return because(CornerFailure::NoConvergence);

  const auto covariance = covariance_at(samples, p);
  if (!covariance) return because(CornerFailure::NoConvergence);
  const double variance = sum_of_squares(samples, p) / static_cast<double>(samples.size() - kParameters);
  if (std::abs(p(kAmplitude)) < 2 * std::sqrt(variance)) return because(CornerFailure::NoContrast);
  return CornerFit{p.head<2>(), *covariance, p(kBlur), std::abs(p(kAmplitude))};
}

}  // namespace asterism
