// SPDX-License-Identifier: Apache-2.0
// OpenCV's own 13 stereo pairs of a chessboard (9 × 6 corners, 25 mm), real photographs of a low-cost rig;
// Debian package opencv-doc.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "asterism/calibration/stereo_calibration.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/io/image_file.hpp"

namespace asterism {
namespace {

std::filesystem::path folder_of_pairs() {
  const char* given = std::getenv("ASTERISM_OPENCV_DOC");
  return given != nullptr ? given : ASTERISM_OPENCV_DOC;
}

CalibrationInput read_pairs(const std::filesystem::path& folder) {
  CalibrationInput input;
  input.board = {BoardPattern::Chessboard, 9, 6, 25, 0};
  input.left_width_px = input.right_width_px = 640;
  input.left_height_px = input.right_height_px = 480;
  std::vector<std::string> numbers;
  for (int i = 1; i <= 14; ++i) {
    if (i != 10) numbers.push_back(fmt::format("{:02}", i));  // OpenCV has no tenth
  }
  input.pairs.resize(numbers.size());
  parallel_for(numbers.size(), [&](std::size_t i) {
    const auto look = [&](const std::string& side) {
      const std::string name = side + numbers[i] + ".jpg";
      return view_image(name, read_image(folder / name), 640, 480, input.board, {});
    };
    input.pairs[i] = {look("left"), look("right")};
  });
  return input;
}

TEST(OpenCvPairs, CalibrateAsWellAsOpenCvsLeastSquaresOnAllOfThem) {
  const auto folder = folder_of_pairs();
  if (!std::filesystem::exists(folder / "left01.jpg")) {
    GTEST_SKIP() << "OpenCV's stereo pairs are not in " << folder
                 << ": run tools/setup test, or set ASTERISM_OPENCV_DOC to the folder of left01.jpg";
  }
  CalibrationOptions options;
  options.coefficients = CoefficientChoice::Five;
  const StereoCalibration result = calibrate_stereo(read_pairs(folder), options);
  std::printf("stereo RMS %.4f px, held-out %.4f px, baseline %.3f ± %.3f mm\n", result.stereo_rms_px,
              result.held_out_rms_px, result.baseline_mm, result.baseline_sigma_mm);
  EXPECT_EQ(result.pairs_used, 13);
  // The minimum of OpenCV's least squares on OpenCV's corners is 0.2150 px; our corners are better.
  EXPECT_LE(result.stereo_rms_px, 0.217);
  EXPECT_NEAR(result.baseline_mm, 83.18, 0.15);
  EXPECT_GT(result.held_out_rms_px, result.stereo_rms_px);
  EXPECT_LT(result.held_out_rms_px, 0.25);
}

}  // namespace
}  // namespace asterism
