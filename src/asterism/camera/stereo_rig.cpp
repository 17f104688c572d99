// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/stereo_rig.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

namespace asterism {
namespace {

void check_lens(const Lens& lens, const std::string& where, const char* which) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(where, fmt::format("{} camera: {}", which, what));
  };
  bool finite = std::isfinite(lens.fx) && std::isfinite(lens.fy) && std::isfinite(lens.skew) &&
                std::isfinite(lens.cx) && std::isfinite(lens.cy);
  for (const double coefficient : lens.distortion) finite = finite && std::isfinite(coefficient);
  if (!finite) refuse("a calibration value is not a finite number");
  if (!(lens.fx > 0 && lens.fy > 0))
    refuse(fmt::format("focal lengths must be positive, found {} and {}", lens.fx, lens.fy));
  if (lens.width_px < 1 || lens.height_px < 1) {
    refuse(fmt::format("image size must be positive, found {} × {}", lens.width_px, lens.height_px));
  }
}

void check_covariance(const StereoRig& rig, const std::string& where) {
  if (rig.covariance.size() == 0) return;
  if (rig.covariance_order != rig_parameter_names(rig)) {
    throw InputError(where,
                     fmt::format("covariance_order must be: {}", fmt::join(rig_parameter_names(rig), " ")));
  }
  const auto names = static_cast<Eigen::Index>(rig.covariance_order.size());
  if (rig.covariance.rows() != names || rig.covariance.cols() != names) {
    throw InputError(where, fmt::format("covariance must have {0} rows and columns, found {1} × {2}", names,
                                        rig.covariance.rows(), rig.covariance.cols()));
  }
  if (!rig.covariance.allFinite())
    throw InputError(where, "covariance holds a value that is not a finite number");
  if ((rig.covariance.diagonal().array() < 0).any())
    throw InputError(where, "covariance holds a negative variance");
}

}  // namespace

std::vector<std::string> rig_parameter_names(const StereoRig& rig) {
  static constexpr std::array<const char*, 14> kCoefficients = {"k1", "k2", "p1", "p2", "k3", "k4",   "k5",
                                                                "k6", "s1", "s2", "s3", "s4", "taux", "tauy"};
  std::vector<std::string> names;
  for (const Side side : {Side::Left, Side::Right}) {
    const int number = static_cast<int>(side) + 1;
    for (const char* name : {"fx", "fy", "skew", "cx", "cy"})
      names.push_back(fmt::format("{}{}", name, number));
    for (int i = 0; i < rig.lens(side).coefficients; ++i) {
      names.push_back(fmt::format("{}_{}", kCoefficients[static_cast<std::size_t>(i)], number));
    }
  }
  names.insert(names.end(), {"rx", "ry", "rz", "tx", "ty", "tz"});
  return names;
}

MatX pixel_by_rig(const StereoRig& rig, Side side, const Vec3& in_tracker, const Mat23& pixel_by_point) {
  const int of_left = 5 + rig.left.coefficients, of_right = 5 + rig.right.coefficients;
  MatX by = MatX::Zero(2, of_left + of_right + 6);
  if (side == Side::Left) {
    by.leftCols(of_left) = pixel_by_parameters(rig.left, in_tracker.hnormalized());
    return by;
  }
  const Vec3 turned = rig.right_from_left.rotation * in_tracker;
  const Vec3 in_right = turned + rig.right_from_left.translation;
  by.middleCols(of_left, of_right) = pixel_by_parameters(rig.right, in_right.hnormalized());
  by.middleCols<3>(of_left + of_right) = -pixel_by_point * skew(turned);
  by.rightCols<3>() = pixel_by_point;
  return by;
}

void check_rig(const StereoRig& rig, const std::string& where) {
  check_lens(rig.left, where, "left");
  check_lens(rig.right, where, "right");
  const RigidMotion& motion = rig.right_from_left;
  if (!motion.translation.allFinite() || !motion.rotation.coeffs().allFinite()) {
    throw InputError(where, "R or T holds a value that is not a finite number");
  }
  if (std::abs(motion.rotation.norm() - 1.0) > 1e-6) throw InputError(where, "R is no rotation");
  if (!(rig.baseline_mm() > 0)) throw InputError(where, "the baseline (length of T) is zero");
  check_covariance(rig, where);
}

}  // namespace asterism
