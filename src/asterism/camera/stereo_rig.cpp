// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/stereo_rig.hpp"

#include <fmt/format.h>

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

}  // namespace

void check_rig(const StereoRig& rig, const std::string& where) {
  check_lens(rig.left, where, "left");
  check_lens(rig.right, where, "right");
  const RigidMotion& motion = rig.right_from_left;
  if (!motion.translation.allFinite() || !motion.rotation.coeffs().allFinite()) {
    throw InputError(where, "R or T holds a value that is not a finite number");
  }
  if (std::abs(motion.rotation.norm() - 1.0) > 1e-6) throw InputError(where, "R is no rotation");
  if (!(rig.baseline_mm() > 0)) throw InputError(where, "the baseline (length of T) is zero");
}

}  // namespace asterism
