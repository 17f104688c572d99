// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/bundle_costs.hpp"

#include <ceres/cost_function.h>

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

template <int Columns>
using RowMajor = Eigen::Matrix<double, 2, Columns, Eigen::RowMajor>;

/// W with Wᵀ W = C⁻¹.
Mat2 whitening(const Mat2& covariance) {
  const double a = std::sqrt(covariance(0, 0));
  const double b = covariance(1, 0) / a;
  const double c = std::sqrt(std::max(covariance(1, 1) - b * b, 1e-12 * covariance(1, 1)));
  Mat2 w;
  w << 1 / a, 0, -b / (a * c), 1 / c;
  return w;
}

/// Writes the Jacobian of the next block where the solver asks for it.
class BlockWriter {
 public:
  BlockWriter(double** jacobians, const Mat2& whiten) : jacobians_(jacobians), whiten_(whiten) {}

  template <class Matrix>
  void write(const Matrix& by) {
    double* target = jacobians_ == nullptr ? nullptr : jacobians_[next_];
    ++next_;
    if (target != nullptr) Eigen::Map<RowMajor<Eigen::Dynamic>>(target, 2, by.cols()) = whiten_ * by;
  }

 private:
  double** jacobians_;
  Mat2 whiten_;
  int next_ = 0;
};

class MarkCost final : public ceres::CostFunction {
 public:
  MarkCost(const MarkMeasurement& measured, const Lens& shape, const MotionReference& rig,
           const MotionReference& board)
      : measured_(measured),
        shape_(shape),
        rig_(rig),
        board_(board),
        whiten_(whitening(measured.covariance)) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(parameter_count(shape));
    if (measured.side == Side::Right) mutable_parameter_block_sizes()->push_back(6);
    mutable_parameter_block_sizes()->push_back(6);
    mutable_parameter_block_sizes()->push_back(1);
    if (measured.mark.radius_mm > 0) mutable_parameter_block_sizes()->push_back(1);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const bool right = measured_.side == Side::Right;
    const double* rig_six = right ? parameters[1] : nullptr;
    const double* board_six = parameters[right ? 2 : 1];
    StereoRig rig;
    (right ? rig.right : rig.left) = lens_with(shape_, parameters[0]);
    if (right) rig.right_from_left = rig_.motion(rig_six);
    BoardMark mark = measured_.mark;
    const double scale = parameters[right ? 3 : 2][0];
    mark.in_board *= scale;
    if (mark.radius_mm > 0) mark.radius_mm = std::abs(parameters[right ? 4 : 3][0]);
    const auto image = image_of_mark(mark, measured_.side, rig, board_.motion(board_six));
    if (!image) return false;
    Eigen::Map<Vec2> whitened(residuals);
    whitened = whiten_ * (image->px - measured_.px);
    BlockWriter writer(jacobians, whiten_);
    writer.write(image->by_lens);
    if (right) writer.write(rig_.by_six(image->by_rig, rig_six));
    writer.write(board_.by_six(image->by_board, board_six));
    writer.write(Vec2(image->by_scale / scale));
    if (mark.radius_mm > 0) writer.write(image->by_radius);
    return true;
  }

 private:
  MarkMeasurement measured_;
  Lens shape_;
  MotionReference rig_, board_;
  Mat2 whiten_;
};

class BarEndCost final : public ceres::CostFunction {
 public:
  BarEndCost(const Vec2& px, const Mat2& covariance, Side side, int end, const Lens& shape,
             const MotionReference& rig)
      : px_(px), whiten_(whitening(covariance)), side_(side), end_(end), shape_(shape), rig_(rig) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(parameter_count(shape));
    if (side == Side::Right) mutable_parameter_block_sizes()->push_back(6);
    mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const bool right = side_ == Side::Right;
    const Vec3 in_tracker = Eigen::Map<const Vec3>(parameters[right ? 2 : 1] + 3 * end_);
    const RigidMotion motion = right ? rig_.motion(parameters[1]) : RigidMotion{};
    const Vec3 in_camera = motion * in_tracker;
    const Lens lens = lens_with(shape_, parameters[0]);
    const auto image = project(lens, in_camera);
    if (!image) return false;
    Eigen::Map<Vec2> whitened(residuals);
    whitened = whiten_ * (image->px - px_);
    BlockWriter writer(jacobians, whiten_);
    writer.write(pixel_by_parameters(lens, in_camera.hnormalized()));
    if (right) {
      Mat36 by_motion;
      by_motion << -skew(motion.rotation * in_tracker), Mat3::Identity();
      writer.write(rig_.by_six(image->by_point * by_motion, parameters[1]));
    }
    Mat26 by_ends = Mat26::Zero();
    by_ends.middleCols<3>(3 * end_) = image->by_point * motion.rotation.toRotationMatrix();
    writer.write(by_ends);
    return true;
  }

 private:
  Vec2 px_;
  Mat2 whiten_;
  Side side_;
  int end_;
  Lens shape_;
  MotionReference rig_;
};

class LengthCost final : public ceres::CostFunction {
 public:
  LengthCost(double length_mm, double sigma_mm) : length_mm_(length_mm), sigma_mm_(sigma_mm) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Vec3 between = Eigen::Map<const Vec3>(parameters[0]) - Eigen::Map<const Vec3>(parameters[0] + 3);
    const double length = between.norm();
    if (!(length > 0)) return false;
    residuals[0] = (length - length_mm_) / sigma_mm_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      const Vec3 direction = between / (length * sigma_mm_);
      Eigen::Map<Vec6> by_ends(jacobians[0]);
      by_ends << direction, -direction;
    }
    return true;
  }

 private:
  double length_mm_, sigma_mm_;
};

}  // namespace

void write_parameters(const Lens& lens, double* parameters) {
  const double first[] = {lens.fx, lens.fy, lens.skew, lens.cx, lens.cy};
  std::copy(std::begin(first), std::end(first), parameters);
  std::copy_n(lens.distortion.begin(), lens.coefficients, parameters + 5);
}

Lens lens_with(const Lens& like, const double* parameters) {
  Lens lens = like;
  lens.fx = parameters[0];
  lens.fy = parameters[1];
  lens.skew = parameters[2];
  lens.cx = parameters[3];
  lens.cy = parameters[4];
  std::copy_n(parameters + 5, like.coefficients, lens.distortion.begin());
  return lens;
}

ceres::CostFunction* mark_cost(const MarkMeasurement& measured, const Lens& shape, const MotionReference& rig,
                               const MotionReference& board) {
  return new MarkCost(measured, shape, rig, board);
}

ceres::CostFunction* bar_end_cost(const Vec2& px, const Mat2& covariance, Side side, int end,
                                  const Lens& shape, const MotionReference& rig) {
  return new BarEndCost(px, covariance, side, end, shape, rig);
}

ceres::CostFunction* length_cost(double length_mm, double sigma_mm) {
  return new LengthCost(length_mm, sigma_mm);
}

}  // namespace asterism
