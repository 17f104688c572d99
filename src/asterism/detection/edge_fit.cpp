// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/edge_fit.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr int kN = EdgeModel::kParameters;
constexpr int kBlur = 7;
using Matrix = std::array<std::array<double, kN>, kN>;
using Vector = std::array<double, kN>;

/// Lower Cholesky factor of a symmetric positive definite matrix, in place; false when it is none.
bool factorise(Matrix& a) {
  for (std::size_t j = 0; j < kN; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t i = j; i < kN; ++i) a[i][j] -= a[i][k] * a[j][k];
    }
    if (!(a[j][j] > 1e-12)) return false;
    const double inverse = 1.0 / std::sqrt(a[j][j]);
    for (std::size_t i = j; i < kN; ++i) a[i][j] *= inverse;
  }
  return true;
}

void solve(const Matrix& lower, Vector& b) {
  for (std::size_t i = 0; i < kN; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= lower[i][k] * b[k];
    b[i] /= lower[i][i];
  }
  for (std::size_t i = kN; i-- > 0;) {
    for (std::size_t k = i + 1; k < kN; ++k) b[i] -= lower[k][i] * b[k];
    b[i] /= lower[i][i];
  }
}

/// The normal equations with the prior on the blur, scaled to a unit diagonal.
struct System {
  Matrix matrix{};
  Vector right{}, scale{};
  double chi_square = 0;

  System(const NormalEquations& equations, const EdgeModel& model, const BlurPrior& prior) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < kN; ++i) {
      for (std::size_t j = i; j < kN; ++j) matrix[i][j] = matrix[j][i] = equations.matrix[k++];
      right[i] = equations.right[i];
    }
    chi_square = equations.chi_square;
    if (prior.deviation > 0) {
      const double precision = 1.0 / (prior.deviation * prior.deviation), off = prior.mean - model.blur;
      matrix[kBlur][kBlur] += precision;
      right[kBlur] += precision * off;
      chi_square += precision * off * off;
    } else {
      for (std::size_t i = 0; i < kN; ++i) matrix[i][kBlur] = matrix[kBlur][i] = 0;
      matrix[kBlur][kBlur] = 1;
      right[kBlur] = 0;
    }
    for (std::size_t i = 0; i < kN; ++i) scale[i] = matrix[i][i] > 0 ? 1.0 / std::sqrt(matrix[i][i]) : 1.0;
    for (std::size_t i = 0; i < kN; ++i) {
      for (std::size_t j = 0; j < kN; ++j) matrix[i][j] *= scale[i] * scale[j];
      right[i] *= scale[i];
    }
  }

  bool step(double damping, Vector& by) const {
    Matrix lower = matrix;
    for (std::size_t i = 0; i < kN; ++i) lower[i][i] *= 1 + damping;
    if (!factorise(lower)) return false;
    by = right;
    solve(lower, by);
    for (std::size_t i = 0; i < kN; ++i) by[i] *= scale[i];
    return std::all_of(by.begin(), by.end(), [](double v) { return std::isfinite(v); });
  }

  bool covariance(Mat2& result) const {
    Matrix lower = matrix;
    if (!factorise(lower)) return false;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Vector column{};
      column[axis] = 1;
      solve(lower, column);
      for (std::size_t i = 0; i < 2; ++i) {
        result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) =
            column[i] * scale[i] * scale[axis];
      }
    }
    result(1, 0) = result(0, 1);
    return result.allFinite() && result(0, 0) > 0 && result.determinant() > 0;
  }
};

EdgeModel moved(const EdgeModel& m, const Vector& by) {
  return {m.x + by[0],   m.y + by[1],         m.m11 + by[2],        m.m12 + by[3],
          m.m22 + by[4], m.amplitude + by[5], m.background + by[6], m.blur + by[7]};
}

bool sound(const EdgeModel& m) {
  return m.m11 > 0 && m.m22 > 0 && m.m11 * m.m22 - m.m12 * m.m12 > 1e-9 && m.blur > 0.2 && m.blur < 20;
}

/// Shortens a step that would leave the region where the linearisation means anything.
void limit(const EdgeModel& model, Vector& by) {
  const double size = 1.0 / std::sqrt(model.m11 * model.m22 - model.m12 * model.m12);
  double most = std::hypot(by[0], by[1]) / (0.3 * size);
  for (std::size_t i = 2; i < 5; ++i) most = std::max(most, std::abs(by[i]) * size / 0.3);
  most = std::max(most, std::abs(by[kBlur]) / (0.4 * model.blur));
  if (most <= 1) return;
  for (double& value : by) value /= most;
}

/// The largest move of the outline, px.
double move_of(const EdgeModel& model, const Vector& by) {
  const double squared_size = 1.0 / (model.m11 * model.m22 - model.m12 * model.m12);
  return std::hypot(by[0], by[1]) +
         0.3 * squared_size * (std::abs(by[2]) + std::abs(by[3]) + std::abs(by[4]));
}

}  // namespace

Ellipse ellipse_of(const Patch& patch, const EdgeModel& model) {
  Mat2 root;
  root << model.m11, model.m12, model.m12, model.m22;
  const Mat2 inverse = root.inverse();
  return ellipse_from_shape({model.x + patch.x, model.y + patch.y}, inverse * inverse);
}

EdgeModel model_of(const Patch& patch, const Ellipse& ellipse) {
  const double c = std::cos(ellipse.angle_rad), s = std::sin(ellipse.angle_rad);
  const double major = 1.0 / ellipse.semi_major, minor = 1.0 / ellipse.semi_minor;
  EdgeModel model;
  model.x = ellipse.centre.x() - patch.x;
  model.y = ellipse.centre.y() - patch.y;
  model.m11 = c * c * major + s * s * minor;
  model.m12 = c * s * (major - minor);
  model.m22 = s * s * major + c * c * minor;
  return model;
}

Result<EdgeFit, FitFailure> fit_edge(const Patch& patch, const EdgeModel& start, const EdgeProfile& profile,
                                     const EdgeNoise& noise, const BlurPrior& blur, const FitLimits& limits) {
  EdgeFit fit;
  fit.model = start;
  NormalEquations equations = normal_equations(patch, fit.model, profile, noise);
  System system(equations, fit.model, blur);
  double damping = 0;
  bool converged = false;
  while (fit.iterations < limits.iterations && !converged) {
    ++fit.iterations;
    Vector by;
    if (!system.step(damping, by)) {
      damping = std::max(1e-3, damping * 10);
      continue;
    }
    limit(fit.model, by);
    const EdgeModel next = moved(fit.model, by);
    if (!sound(next)) {
      damping = std::max(1e-2, damping * 10);
      continue;
    }
    if (damping < 1e-3 && move_of(fit.model, by) < limits.enough_px) {
      // The equations here differ from those at the last step by less than their own meaning.
      fit.model = next;
      converged = true;
      break;
    }
    const NormalEquations there = normal_equations(patch, next, profile, noise);
    const System at(there, next, blur);
    if (!(at.chi_square <= system.chi_square * (1 + 1e-4))) {
      damping = std::max(1e-2, damping * 10);
      continue;
    }
    damping = damping < 1e-3 ? 0 : damping * 0.1;
    fit.model = next;
    equations = there;
    system = at;
  }
  if (!converged) return because(FitFailure::NotConverged);
  if (equations.usable < 2 * kN) return because(FitFailure::TooFewPixels);
  if (!system.covariance(fit.covariance)) return because(FitFailure::NotConverged);
  fit.chi_square = equations.chi_square;
  fit.pixels = equations.usable;
  return fit;
}

}  // namespace asterism
