// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/calibration/stereo_calibration.hpp"
#include "asterism/camera/disc_image.hpp"
#include "asterism/core/random.hpp"

// Made-up boards before a made-up rig, for this room's tests.

namespace asterism::testing_rig {

inline StereoRig made_up_rig(int coefficients) {
  StereoRig rig;
  rig.left = {1600, 1605, 0, 630, 470, {}, coefficients, 1280, 960};
  rig.right = {1615, 1612, 0, 645, 485, {}, coefficients, 1280, 960};
  const std::array<double, 5> distortion = {-0.12, 0.07, 0.0006, -0.0004, -0.02};
  for (std::size_t i = 0; i < static_cast<std::size_t>(std::min(coefficients, 5)); ++i) {
    rig.left.distortion[i] = distortion[i];
    rig.right.distortion[i] = 0.8 * distortion[i];
  }
  rig.right_from_left = {exp_rotation(Vec3(0.02, 0.3, -0.01)), Vec3(-480, 6, 70)};
  return rig;
}

/// Attitudes up to `tilt_rad` about both axes, at 1.3 to 1.9 m, before both cameras.
inline RigidMotion board_before_rig(RandomStream& random, const Board& board, double tilt_rad) {
  const auto points = board_points(board);
  const Vec3 middle = 0.5 * (points.front() + points.back());
  const Quaternion attitude =
      exp_rotation(Vec3(random.uniform(-tilt_rad, tilt_rad), random.uniform(-tilt_rad, tilt_rad) - 0.5 * 0.3,
                        random.uniform(-tilt_rad, tilt_rad)));
  const Vec3 place(random.uniform(120, 300), random.uniform(-90, 90), random.uniform(1300, 1900));
  return {attitude, place - attitude * middle};
}

/// What one camera sees, with normal noise of `sigma_px`; by the exact conic when the board has circles.
inline BoardView view_of(const StereoRig& rig, Side side, const RigidMotion& tracker_from_board,
                         const Board& board, double sigma_px, RandomStream& random) {
  BoardView view;
  const RigidMotion camera_from_board = rig.camera_from_tracker(side) * tracker_from_board;
  const auto points = board_points(board);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Disc disc{camera_from_board * points[i], camera_from_board.rotation * Vec3::UnitZ(),
                    0.5 * board.circle_diameter_mm};
    const auto image = project_disc_centre(rig.lens(side), disc);
    const Vec2 noise(random.normal(), random.normal());
    view.points.push_back({static_cast<int>(i), image->px + sigma_px * noise,
                           std::max(1e-8, sigma_px * sigma_px) * Mat2::Identity()});
  }
  view.diameter_of_pitch = board.circle_diameter_mm / board.pitch_mm;
  return view;
}

inline CalibrationInput made_up_input(const StereoRig& rig, const Board& board, int pairs, double sigma_px,
                                      std::uint64_t seed, double tilt_rad = 0.6) {
  CalibrationInput input;
  input.board = board;
  input.left_width_px = input.right_width_px = rig.left.width_px;
  input.left_height_px = input.right_height_px = rig.left.height_px;
  for (int i = 0; i < pairs; ++i) {
    RandomStream random(seed, static_cast<std::uint64_t>(i));
    const RigidMotion pose = board_before_rig(random, board, tilt_rad);
    CalibrationPair pair;
    pair.left.name = "left" + std::to_string(i);
    pair.right.name = "right" + std::to_string(i);
    pair.left.view = view_of(rig, Side::Left, pose, board, sigma_px, random);
    pair.right.view = view_of(rig, Side::Right, pose, board, sigma_px, random);
    input.pairs.push_back(pair);
  }
  return input;
}

/// All parameters in the order of StereoRig::covariance_order, as their difference to `truth`.
inline VecX rig_error(const StereoRig& rig, const StereoRig& truth) {
  std::vector<double> error;
  for (const Side side : {Side::Left, Side::Right}) {
    const Lens &a = rig.lens(side), &b = truth.lens(side);
    for (const double value : {a.fx - b.fx, a.fy - b.fy, a.skew - b.skew, a.cx - b.cx, a.cy - b.cy})
      error.push_back(value);
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.coefficients); ++i)
      error.push_back(a.distortion[i] - b.distortion[i]);
  }
  const Vec6 motion = difference(rig.right_from_left, truth.right_from_left);
  error.insert(error.end(), motion.data(), motion.data() + 6);
  return Eigen::Map<VecX>(error.data(), static_cast<Eigen::Index>(error.size()));
}

}  // namespace asterism::testing_rig
