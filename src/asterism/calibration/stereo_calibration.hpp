// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/calibration/bundle.hpp"
#include "asterism/calibration/find_board.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// How many distortion coefficients: a number, or what predicts images best that took no part.
enum class CoefficientChoice { Auto, None, Four, Five, Eight };

struct CalibrationOptions {
  CoefficientChoice coefficients = CoefficientChoice::Auto;
  bool estimate_skew = false;
  bool single_views = true;      // images whose partner shows no board still serve their own camera
  int folds = 5;                 // of the held-out error
  double max_image_ratio = 4.0;  // an image whose RMS exceeds the median image's by more is refused
  double max_focal_error =
      0.02;  // relative standard deviation above which the focal length counts as undetermined
};
void describe(CalibrationOptions& options, OptionVisitor& visit);

/// One image of one camera: its view of the board, or why there is none.
struct CalibrationImage {
  std::string name;
  std::optional<BoardView> view;
  std::string refused;  // empty = used
  double rms_px = 0;    // of its points' residuals, where it was used
  int outliers = 0;     // points left out
};

struct CalibrationPair {
  CalibrationImage left, right;
};

struct CalibrationInput {
  Board board;
  int left_width_px = 0, left_height_px = 0, right_width_px = 0, right_height_px = 0;
  std::vector<CalibrationPair> pairs;
  std::vector<ScaleBarView> bars;
};

/// How well a number of coefficients did. RMS as OpenCV's stereo calibration counts it: of the distances
/// between measured and modelled points, over both images of every pair.
struct ModelTrial {
  int coefficients;
  double stereo_rms_px;
  double held_out_rms_px;  // pairs predicted by rigs calibrated without them (their board's pose fitted)
};

struct StereoCalibration {
  StereoRig rig;  // with covariance
  std::vector<CalibrationPair> pairs;
  int pairs_used = 0;
  double stereo_rms_px = 0, held_out_rms_px = 0;
  std::vector<ModelTrial> trials;  // the chosen one is rig.left.coefficients
  double baseline_mm = 0, baseline_sigma_mm = 0;
  double corner_sigma_px = 0;  // RMS per axis of the points' stated sigmas
  double model_sigma_px = 0;   // per axis, what board and lens model leave over
  double pitch_mm = 0;         // the board's; as given, unless scale bars told the length
  double circle_diameter_mm = 0;
  std::vector<double> bar_errors_mm;  // adjusted − stated
  std::vector<std::string> notes;     // what the user should know before trusting it
};

/// Looks for the board in one image; refuses sizes that differ from the first image's.
[[nodiscard]] CalibrationImage view_image(const std::string& name, const Image& image, int width_px,
                                          int height_px, const Board& board,
                                          const BoardSearchOptions& options);

/// Images of a board → rig with covariance. Throws MeasurementError, with each refused image and its
/// reason, when fewer than three pairs remain or the views do not determine the cameras.
[[nodiscard]] StereoCalibration calibrate_stereo(const CalibrationInput& input,
                                                 const CalibrationOptions& options);

}  // namespace asterism
