// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/calibration/bundle_terms.hpp"

namespace ceres {
class CostFunction;
}

namespace asterism {

/// A rigid motion as six numbers for the adjustment: ω about a fixed reference attitude, and t.
struct MotionReference {
  Quaternion rotation = Quaternion::Identity();

  [[nodiscard]] RigidMotion motion(const double* six) const {
    return {(exp_rotation(Vec3(six[0], six[1], six[2])) * rotation).normalized(),
            Vec3(six[3], six[4], six[5])};
  }
  /// ∂ by the motion's error → ∂ by the six numbers.
  [[nodiscard]] Mat26 by_six(const Mat26& by_error, const double* six) const {
    Mat26 by = by_error;
    by.leftCols<3>() = by_error.leftCols<3>() * left_jacobian(Vec3(six[0], six[1], six[2]));
    return by;
  }
};

struct MarkMeasurement {
  BoardMark mark;
  Side side;
  Vec2 px;
  Mat2 covariance;
};

/// Number of a lens' parameters in the adjustment, and how they are laid out: fx fy skew cx cy, coefficients.
[[nodiscard]] inline int parameter_count(const Lens& lens) { return 5 + lens.coefficients; }
void write_parameters(const Lens& lens, double* parameters);
[[nodiscard]] Lens lens_with(const Lens& like, const double* parameters);

/// Whitened residual of a mark on the board. Blocks: lens; for the right camera the rig's motion; the board's
/// motion; the board's scale (a factor near 1); for circles the radius. `shape` gives the number of
/// coefficients.
[[nodiscard]] ceres::CostFunction* mark_cost(const MarkMeasurement& measured, const Lens& shape,
                                             const MotionReference& rig, const MotionReference& board);

/// Whitened residual of one end of a scale bar. Blocks: lens; for the right camera the rig's motion; both
/// ends in `tracker` (6 numbers).
[[nodiscard]] ceres::CostFunction* bar_end_cost(const Vec2& px, const Mat2& covariance, Side side, int end,
                                                const Lens& shape, const MotionReference& rig);

/// (|a − b| − length) / sigma. Block: both ends.
[[nodiscard]] ceres::CostFunction* length_cost(double length_mm, double sigma_mm);

}  // namespace asterism
