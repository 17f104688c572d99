// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/working_bundle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/calibration/bundle_quality.hpp"
#include "asterism/calibration/calibration_start.hpp"

namespace asterism {
namespace {

constexpr double kOutlierSigmas = 6.0;
constexpr double kHarmless = 0.05;  // px: an image this good is never refused

std::string refusals(const std::vector<CalibrationPair>& pairs) {
  std::string text;
  for (const CalibrationPair& pair : pairs) {
    for (const CalibrationImage* image : {&pair.left, &pair.right}) {
      if (!image->refused.empty()) text += fmt::format("\n  {}: {}", image->name, image->refused);
    }
  }
  return text;
}

}  // namespace

void give_up(const std::string& why, const std::vector<CalibrationPair>& pairs) {
  throw MeasurementError(why + refusals(pairs));
}

namespace {

int usable_pairs(const std::vector<CalibrationPair>& pairs) {
  return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](const CalibrationPair& pair) {
    return pair.left.refused.empty() && pair.right.refused.empty();
  }));
}

void check_enough(const std::vector<CalibrationPair>& pairs) {
  const int usable = usable_pairs(pairs);
  if (usable >= 3) return;
  give_up(
      fmt::format("calibration needs the board seen by both cameras in at least 3 pairs of images, {} of {} "
                  "{} usable",
                  usable, pairs.size(), usable == 1 ? "is" : "are"),
      pairs);
}

/// Refuses what cannot be used for want of a partner, when single views are not wanted.
void refuse_single_views(std::vector<CalibrationPair>& pairs, const CalibrationOptions& options) {
  for (CalibrationPair& pair : pairs) {
    const bool left = pair.left.refused.empty(), right = pair.right.refused.empty();
    if (options.single_views || left == right) continue;
    (left ? pair.left : pair.right).refused = "its partner shows no board";
  }
}

LensStart start_camera(const std::vector<CalibrationPair>& pairs, Side side, const CalibrationInput& input,
                       int coefficients) {
  std::vector<BoardView> views;
  for (const CalibrationPair& pair : pairs) {
    const CalibrationImage& image = side == Side::Left ? pair.left : pair.right;
    if (image.refused.empty()) views.push_back(*image.view);
  }
  const bool left = side == Side::Left;
  const auto start = start_lens(views, input.board, left ? input.left_width_px : input.right_width_px,
                                left ? input.left_height_px : input.right_height_px, coefficients);
  if (!start) {
    give_up(fmt::format(
                "the {} camera's views do not lead to a lens: tilt the board by 20 to 45 degrees about both "
                "of its axes, at different distances",
                left ? "left" : "right"),
            pairs);
  }
  return *start;
}

void estimate_diameter(Working& working, const std::vector<CalibrationPair>& pairs) {
  Board& board = working.bundle.board;
  if (board.pattern == BoardPattern::Chessboard || board.circle_diameter_mm > 0) return;
  std::vector<double> shares;
  for (const CalibrationPair& pair : pairs) {
    for (const CalibrationImage* image : {&pair.left, &pair.right}) {
      if (image->refused.empty()) shares.push_back(image->view->diameter_of_pitch);
    }
  }
  std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2),
                   shares.end());
  board.circle_diameter_mm = shares[shares.size() / 2] * board.pitch_mm;
}

/// Lenses one by one, then the motion between them on which most pairs agree.
Working start(std::vector<CalibrationPair>& pairs, const CalibrationInput& input, int coefficients) {
  const LensStart left = start_camera(pairs, Side::Left, input, coefficients);
  const LensStart right = start_camera(pairs, Side::Right, input, coefficients);
  std::vector<PairPoses> poses;
  std::vector<BoardView*> right_views;
  std::vector<std::size_t> both;
  std::vector<RigidMotion> right_only(pairs.size());
  Working working;
  working.pair_of.clear();
  std::size_t next_left = 0, next_right = 0;
  std::vector<RigidMotion> left_pose(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool in_left = pairs[i].left.refused.empty(), in_right = pairs[i].right.refused.empty();
    if (in_left) left_pose[i] = left.poses[next_left++];
    if (in_right) right_only[i] = right.poses[next_right++];
    if (!in_left || !in_right) continue;
    poses.push_back({left_pose[i], right_only[i]});
    right_views.push_back(&*pairs[i].right.view);
    both.push_back(i);
  }
  const PairStart between = start_pair(poses, right_views, input.board);
  for (std::size_t k = 0; k < both.size(); ++k) {
    if (between.agrees[k]) continue;
    const std::string why =
        "left and right do not show the board in one place: not taken at one moment, or not a pair";
    pairs[both[k]].left.refused = pairs[both[k]].right.refused = why;
  }
  check_enough(pairs);

  Bundle& bundle = working.bundle;
  bundle.board = input.board;
  bundle.bars = input.bars;
  bundle.rig.left = left.lens;
  bundle.rig.right = right.lens;
  bundle.rig.right_from_left = between.right_from_left;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool in_left = pairs[i].left.refused.empty(), in_right = pairs[i].right.refused.empty();
    if (!in_left && !in_right) continue;
    BundleView view;
    if (in_left) view.left = pairs[i].left.view;
    if (in_right) view.right = pairs[i].right.view;
    view.tracker_from_board = in_left ? left_pose[i] : between.right_from_left.inverse() * right_only[i];
    bundle.views.push_back(view);
    working.pair_of.push_back(i);
  }
  estimate_diameter(working, pairs);
  return working;
}

}  // namespace

void set_coefficients(Bundle& bundle, int coefficients) {
  for (Lens* lens : {&bundle.rig.left, &bundle.rig.right}) {
    lens->coefficients = coefficients;
    std::fill(lens->distortion.begin() + coefficients, lens->distortion.end(), 0.0);
  }
}

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Refuses the image whose median residual stands out most; false when none does. The median, so that
/// a few points hidden by a hand do not cost the image.
bool refuse_worst(const Working& working, std::vector<CalibrationPair>& pairs, double max_ratio) {
  std::vector<std::array<std::vector<double>, 2>> lengths(working.bundle.views.size());
  for (const BundleResidual& residual : residuals_of(working.bundle)) {
    lengths[static_cast<std::size_t>(residual.view)][static_cast<std::size_t>(residual.side)].push_back(
        residual.px.norm());
  }
  std::vector<double> typical;
  CalibrationImage* worst = nullptr;
  double most = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    CalibrationPair& pair = pairs[working.pair_of[i]];
    for (std::size_t side = 0; side < 2; ++side) {
      if (lengths[i][side].empty()) continue;
      typical.push_back(median(lengths[i][side]));
      if (typical.back() <= most) continue;
      most = typical.back();
      worst = side == 0 ? &pair.left : &pair.right;
    }
  }
  const double usual = median(typical);
  if (!(most > max_ratio * usual && most > kHarmless)) return false;
  worst->refused =
      fmt::format("residual too large: {:.3f} px where the median image has {:.3f} px", most, usual);
  return true;
}

}  // namespace

Working settle(std::vector<CalibrationPair>& pairs, const CalibrationInput& input,
               const CalibrationOptions& options, int coefficients) {
  for (;;) {
    refuse_single_views(pairs, options);
    check_enough(pairs);
    Working working = start(pairs, input, std::min(coefficients, 4));
    set_coefficients(working.bundle, coefficients);
    working.bundle.estimate_skew = options.estimate_skew;
    working.bundle.estimate_diameter =
        input.board.pattern != BoardPattern::Chessboard && input.board.circle_diameter_mm == 0;
    if (!adjust_with_model_sigma(working.bundle)) {
      give_up("the adjustment did not converge: the views do not determine the cameras", pairs);
    }
    if (refuse_worst(working, pairs, options.max_image_ratio)) continue;
    for (int round = 0; round < 3 && drop_outliers(working.bundle, kOutlierSigmas) > 0; ++round) {
      if (!adjust_with_model_sigma(working.bundle)) give_up("the adjustment did not converge", pairs);
    }
    return working;
  }
}

}  // namespace asterism
