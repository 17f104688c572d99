// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/stereo_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/calibration/bundle_quality.hpp"
#include "asterism/calibration/working_bundle.hpp"
#include "asterism/camera/two_view.hpp"

namespace asterism {
namespace {

constexpr double kFewer = 1.01;  // fewer coefficients are preferred when they predict within one per cent

std::vector<int> numbers_to_try(CoefficientChoice choice) {
  switch (choice) {
    case CoefficientChoice::None:
      return {0};
    case CoefficientChoice::Four:
      return {4};
    case CoefficientChoice::Five:
      return {5};
    case CoefficientChoice::Eight:
      return {8};
    case CoefficientChoice::Auto:
      break;
  }
  return {0, 4, 5, 8};
}

/// Tries each number of coefficients; leaves the bundle with the fewest that predict held-out pairs as
/// well as any.
std::vector<ModelTrial> choose_coefficients(Bundle& bundle, const CalibrationOptions& options) {
  std::vector<ModelTrial> trials;
  std::vector<Bundle> adjusted;
  double least = std::numeric_limits<double>::infinity();
  for (const int coefficients : numbers_to_try(options.coefficients)) {
    Bundle trial = bundle;
    set_coefficients(trial, coefficients);
    if (!adjust_with_model_sigma(trial)) continue;
    trials.push_back({coefficients, stereo_rms(trial), held_out_rms(trial, options.folds)});
    adjusted.push_back(std::move(trial));
    least = std::min(least, trials.back().held_out_rms_px);
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!(trials[i].held_out_rms_px <= kFewer * least)) continue;
    bundle = adjusted[i];
    break;
  }
  return trials;
}

/// The covariance, or what the views leave open, in words.
MatX covariance_or_refusal(const Bundle& bundle, const std::vector<CalibrationPair>& pairs,
                           double max_focal_error) {
  const double tilt_deg = deg_from_rad(largest_tilt_rad(bundle));
  const std::string advice = fmt::format(
      "; the board's attitudes differ by {:.0f} degrees at most: tilt it by 20 to 45 degrees about both of "
      "its axes, at different distances",
      tilt_deg);
  auto covariance = rig_covariance(bundle);
  if (!covariance || !covariance->allFinite()) {
    give_up("the views do not determine the cameras' focal lengths and distances" + advice, pairs);
  }
  *covariance *= variance_factor(bundle);
  int column = 0;
  for (const Side side : {Side::Left, Side::Right}) {
    const Lens& lens = bundle.rig.lens(side);
    for (const auto& [value, name] : {std::pair{lens.fx, "fx"}, std::pair{lens.fy, "fy"}}) {
      const double sigma = std::sqrt((*covariance)(column, column));
      ++column;
      if (sigma <= max_focal_error * value) continue;
      give_up(fmt::format("the {} camera's focal length is not determined: {} = {:.0f} ± {:.0f} px{}",
                          side == Side::Left ? "left" : "right", name, value, sigma, advice),
              pairs);
    }
    column += 3 + lens.coefficients;
  }
  return *covariance;
}

void add_notes(StereoCalibration& result, const Bundle& bundle) {
  const double tilt_deg = deg_from_rad(largest_tilt_rad(bundle));
  if (tilt_deg < 20) {
    result.notes.push_back(
        fmt::format("the board's attitudes differ by only {:.0f} degrees: the focal lengths are "
                    "poorly supported; tilt it by 20 to 45 degrees",
                    tilt_deg));
  }
  if (result.pairs_used < 8) {
    result.notes.push_back(fmt::format("only {} pairs took part: 10 to 20 make the error estimates reliable",
                                       result.pairs_used));
  }
  const BoardForm form = board_form(bundle);
  if (form.off_grid_mm > 3 * form.noise_mm) {
    result.notes.push_back(
        fmt::format("the board's points lie {:.3f} mm (RMS) off a flat even grid, where the residuals' "
                    "noise would give {:.3f} mm: the board may be bent or unevenly printed, or the "
                    "lens needs more coefficients",
                    form.off_grid_mm, form.noise_mm));
  }
  if (result.model_sigma_px > 3 * result.corner_sigma_px) {
    result.notes.push_back(
        fmt::format("the residuals ({:.3f} px per axis) are far above what the points' own noise "
                    "explains ({:.3f} px): board, lens model or synchronisation limit this rig",
                    result.model_sigma_px, result.corner_sigma_px));
  }
  if (result.held_out_rms_px > 1.3 * result.stereo_rms_px) {
    result.notes.push_back(
        "pairs held out are predicted clearly worse than pairs used: take more views, and "
        "cover the corners of the images");
  }
}

/// Length by the finished rig minus the stated one, mm.
double length_error(const ScaleBarView& bar, const StereoRig& rig) {
  Vec3 ends[2] = {Vec3::Zero(), Vec3::Zero()};
  for (int end = 0; end < 2; ++end) {
    const auto point =
        triangulate_pair(rig, bar.px[0][end], bar.covariance[0][end], bar.px[1][end], bar.covariance[1][end]);
    if (point) ends[end] = point->in_tracker;
  }
  return (ends[0] - ends[1]).norm() - bar.length_mm;
}

void report_images(StereoCalibration& result, const Working& working) {
  const auto rms = image_rms(working.bundle);
  for (std::size_t i = 0; i < working.pair_of.size(); ++i) {
    CalibrationPair& pair = result.pairs[working.pair_of[i]];
    const BundleView& view = working.bundle.views[i];
    const auto fill = [](CalibrationImage& image, const std::optional<BoardView>& used, double value) {
      if (!used) return;
      image.rms_px = value;
      image.outliers = static_cast<int>(image.view->points.size() - used->points.size());
    };
    fill(pair.left, view.left, rms[i].left_px);
    fill(pair.right, view.right, rms[i].right_px);
    if (view.left && view.right) ++result.pairs_used;
  }
}

}  // namespace

void describe(CalibrationOptions& options, OptionVisitor& visit) {
  visit.choice_of("coefficients", options.coefficients, {"auto", "0", "4", "5", "8"},
                  "distortion coefficients; auto = the fewest that predict held-out pairs as well as any");
  visit.flag("estimate_skew", options.estimate_skew, "estimate the skew of the pixel axes too");
  visit.flag("single_views", options.single_views,
             "use images whose partner shows no board for their own camera");
  visit.integer("folds", options.folds, {2, 100}, "groups of the held-out error");
  visit.number("max_image_ratio", options.max_image_ratio, {1.5, 100},
               "refuse an image whose residual exceeds the median image's by more");
  visit.number("max_focal_error", options.max_focal_error, {1e-6, 1},
               "relative standard deviation of a focal length that counts as undetermined");
}

CalibrationImage view_image(const std::string& name, const Image& image, int width_px, int height_px,
                            const Board& board, const BoardSearchOptions& options) {
  CalibrationImage result{name, std::nullopt, "", 0, 0};
  if (width_of(image) != width_px || height_of(image) != height_px) {
    result.refused = fmt::format("size {} x {} differs from the first image's {} x {}", width_of(image),
                                 height_of(image), width_px, height_px);
    return result;
  }
  const auto view = find_board(image, board, options);
  if (view)
    result.view = *view;
  else
    result.refused = text_of(view.error());
  return result;
}

StereoCalibration calibrate_stereo(const CalibrationInput& input, const CalibrationOptions& options) {
  check_board(input.board);
  if (input.pairs.empty()) throw InputError("calibration needs images, none were given");
  StereoCalibration result;
  result.pairs = input.pairs;
  const auto numbers = numbers_to_try(options.coefficients);
  Working working = settle(result.pairs, input, options, numbers.size() == 1 ? numbers.front() : 5);
  Bundle& bundle = working.bundle;
  result.trials = choose_coefficients(bundle, options);
  if (result.trials.empty()) give_up("the adjustment did not converge", result.pairs);

  result.rig = bundle.rig;
  result.rig.covariance = covariance_or_refusal(bundle, result.pairs, options.max_focal_error);
  result.rig.covariance_order = rig_parameter_names(result.rig);
  result.stereo_rms_px = stereo_rms(bundle);
  for (const ModelTrial& trial : result.trials) {
    if (trial.coefficients == result.rig.left.coefficients) result.held_out_rms_px = trial.held_out_rms_px;
  }
  const Vec3 along = result.rig.right_from_left.translation.normalized();
  result.baseline_mm = result.rig.baseline_mm();
  result.baseline_sigma_mm = std::sqrt(along.dot(result.rig.covariance.bottomRightCorner<3, 3>() * along));
  result.model_sigma_px = bundle.model_sigma_px;
  double variance = 0;
  const auto residuals = residuals_of(bundle);
  for (const BundleResidual& residual : residuals) variance += 0.5 * residual.covariance.trace();
  result.corner_sigma_px = std::sqrt(variance / static_cast<double>(residuals.size()));
  result.pitch_mm = bundle.board.pitch_mm;
  for (const ScaleBarView& bar : input.bars) result.bar_errors_mm.push_back(length_error(bar, result.rig));
  result.circle_diameter_mm = bundle.board.circle_diameter_mm;
  report_images(result, working);
  add_notes(result, bundle);
  return result;
}

}  // namespace asterism
