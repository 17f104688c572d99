// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/stereo_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/calibration/rig_for_tests.hpp"
#include "asterism/camera/two_view.hpp"
#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

using namespace testing_rig;

const Board kChessboard{BoardPattern::Chessboard, 8, 6, 40, 0};

CalibrationOptions with(CoefficientChoice choice) {
  CalibrationOptions options;
  options.coefficients = choice;
  return options;
}

/// The covariance without the rows that are held (zero variance).
std::vector<Eigen::Index> estimated(const MatX& covariance) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    if (covariance(i, i) > 0) rows.push_back(i);
  }
  return rows;
}

std::string message_of(const CalibrationInput& input, const CalibrationOptions& options) {
  try {
    (void)calibrate_stereo(input, options);
  } catch (const MeasurementError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CalibrateStereo, FindsTheRigFromNoiselessBoards) {
  const StereoRig truth = made_up_rig(5);
  const auto result =
      calibrate_stereo(made_up_input(truth, kChessboard, 12, 0, 1), with(CoefficientChoice::Five));
  const VecX error = rig_error(result.rig, truth);
  EXPECT_LT(std::abs(error(0)),
            1e-3);  // px; corners are whole to 1e-7 px by OpenCV's floats in the start only
  EXPECT_LT(error.tail<6>().tail<3>().norm(), 1e-3);
  EXPECT_LT(result.stereo_rms_px, 1e-5);
  EXPECT_EQ(result.pairs_used, 12);
}

TEST(CalibrateStereo, StatesAnHonestCovarianceOfEveryParameter) {
  const StereoRig truth = made_up_rig(4);
  constexpr int kRuns = 50;
  std::vector<double> nees(kRuns), points(kRuns);
  Eigen::Index parameters = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto input = made_up_input(truth, kChessboard, 8, 0.05, 100 + static_cast<std::uint64_t>(run));
    auto options = with(CoefficientChoice::Four);
    options.folds = 2;
    const auto result = calibrate_stereo(input, options);
    const auto rows = estimated(result.rig.covariance);
    parameters = static_cast<Eigen::Index>(rows.size());
    const VecX error = rig_error(result.rig, truth)(rows);
    const auto weighted = solve_positive(MatX(result.rig.covariance(rows, rows)), error);
    ASSERT_TRUE(weighted);
    nees[static_cast<std::size_t>(run)] = error.dot(*weighted) / static_cast<double>(parameters);
    // A point triangulated with this rig from noiseless pixels is off by the rig's error alone.
    const Vec3 point(150, 60, 1600);
    const Mat2 exact = 1e-12 * Mat2::Identity();
    const auto seen = triangulate_pair(result.rig, project(truth.left, point)->px, exact,
                                       project(truth.right, truth.right_from_left * point)->px, exact);
    ASSERT_TRUE(seen);
    const Vec3 off = seen->in_tracker - point;
    points[static_cast<std::size_t>(run)] = off.dot(seen->covariance.inverse() * off) / 3;
  }
  EXPECT_EQ(parameters, 22);  // 2 × (4 + 4) + 6
  double mean = 0, mean_point = 0;
  for (std::size_t i = 0; i < kRuns; ++i) mean += nees[i] / kRuns, mean_point += points[i] / kRuns;
  // A χ² mean over 50 · 22 degrees scatters by 4.3 %, over 50 · 3 by 11.5 %: bands of four and three sigmas.
  // The variance factor itself is known to 2 % a run.
  EXPECT_NEAR(mean, 1.0, 0.17);
  EXPECT_NEAR(mean_point, 1.0, 0.35);
}

TEST(CalibrateStereo, ChoosesTheFewestCoefficientsThatPredictHeldOutPairs) {
  const auto plain = calibrate_stereo(made_up_input(made_up_rig(0), kChessboard, 10, 0.05, 7),
                                      with(CoefficientChoice::Auto));
  EXPECT_EQ(plain.rig.left.coefficients, 0);
  EXPECT_EQ(plain.trials.size(), 4U);
  const auto curved = calibrate_stereo(made_up_input(made_up_rig(4), kChessboard, 10, 0.05, 7),
                                       with(CoefficientChoice::Auto));
  EXPECT_EQ(curved.rig.left.coefficients, 4);
  EXPECT_GT(curved.held_out_rms_px, curved.stereo_rms_px);
  EXPECT_LT(curved.held_out_rms_px, 0.1);
}

TEST(CalibrateStereo, RenumbersABoardReadFromItsOtherEnd) {
  const StereoRig truth = made_up_rig(0);
  auto input = made_up_input(truth, kChessboard, 8, 0.02, 3);
  for (BoardPoint& point : input.pairs[2].right.view->points) point.point = 47 - point.point;
  const auto result = calibrate_stereo(input, with(CoefficientChoice::None));
  EXPECT_EQ(result.pairs_used, 8);
  EXPECT_LT(result.stereo_rms_px, 0.05);
}

TEST(CalibrateStereo, RefusesAnImageThatDoesNotFitAndSaysWhich) {
  const StereoRig truth = made_up_rig(0);
  auto input = made_up_input(truth, kChessboard, 8, 0.02, 4);
  RandomStream random(9, 9);
  for (BoardPoint& point : input.pairs[5].left.view->points)
    point.px += Vec2(random.normal(), random.normal());
  const auto result = calibrate_stereo(input, with(CoefficientChoice::None));
  EXPECT_NE(result.pairs[5].left.refused.find("residual too large"), std::string::npos);
  EXPECT_EQ(result.pairs[5].right.refused, "");  // still serves its own camera
  EXPECT_EQ(result.pairs_used, 7);
  EXPECT_NEAR(result.baseline_mm, truth.baseline_mm(), 5 * result.baseline_sigma_mm);
}

TEST(CalibrateStereo, RefusesAPairThatWasNotTakenAtOneMoment) {
  const StereoRig truth = made_up_rig(0);
  auto input = made_up_input(truth, kChessboard, 8, 0.02, 5);
  input.pairs[1].right.view = made_up_input(truth, kChessboard, 1, 0.02, 77).pairs[0].right.view;
  const auto result = calibrate_stereo(input, with(CoefficientChoice::None));
  EXPECT_FALSE(result.pairs[1].left.refused.empty());
  EXPECT_EQ(result.pairs_used, 7);
}

TEST(CalibrateStereo, LeavesOutSinglePointsThatAreGross) {
  auto input = made_up_input(made_up_rig(0), kChessboard, 8, 0.02, 6);
  input.pairs[0].left.view->points[10].px += Vec2(1.5, -1);
  const auto result = calibrate_stereo(input, with(CoefficientChoice::None));
  EXPECT_EQ(result.pairs[0].left.outliers, 1);
  EXPECT_EQ(result.pairs_used, 8);
}

TEST(CalibrateStereo, SaysWhenFaceOnBoardsLeaveTheFocalLengthOpen) {
  const StereoRig rig = [] {
    StereoRig parallel = made_up_rig(0);
    parallel.right_from_left.rotation = Quaternion::Identity();
    return parallel;
  }();
  CalibrationInput input = made_up_input(rig, kChessboard, 8, 0.05, 8, 0.0);
  for (std::size_t i = 0; i < input.pairs.size(); ++i) {
    RandomStream random(8, i);
    const RigidMotion face_on{Quaternion::Identity(), Vec3(random.uniform(-100, 200), random.uniform(-200, 0),
                                                           random.uniform(1400, 1800))};
    input.pairs[i].left.view = view_of(rig, Side::Left, face_on, kChessboard, 0.05, random);
    input.pairs[i].right.view = view_of(rig, Side::Right, face_on, kChessboard, 0.05, random);
  }
  const std::string message = message_of(input, with(CoefficientChoice::None));
  EXPECT_NE(message.find("tilt"), std::string::npos) << message;
}

TEST(CalibrateStereo, SaysWhyEachImageWasRefusedWhenTooFewRemain) {
  auto input = made_up_input(made_up_rig(0), kChessboard, 4, 0.05, 2);
  input.pairs[0].left.refused = "board not found";
  input.pairs[3].right.refused = "blurred";
  const std::string message = message_of(input, with(CoefficientChoice::None));
  EXPECT_NE(message.find("at least 3 pairs of images, 2 of 4 are usable"), std::string::npos) << message;
  EXPECT_NE(message.find("left0: board not found"), std::string::npos);
  EXPECT_NE(message.find("right3: blurred"), std::string::npos);
}

TEST(CalibrateStereo, RefusesToWorkWithoutImages) {
  CalibrationInput input;
  input.board = kChessboard;
  EXPECT_THROW((void)calibrate_stereo(input, {}), InputError);
}

TEST(CalibrateStereo, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto input = made_up_input(made_up_rig(4), kChessboard, 6, 0.05, 11);
  set_thread_count(1);
  const auto one = calibrate_stereo(input, with(CoefficientChoice::Four));
  set_thread_count(4);
  const auto four = calibrate_stereo(input, with(CoefficientChoice::Four));
  set_thread_count(0);
  EXPECT_EQ(one.rig.left.fx, four.rig.left.fx);
  EXPECT_EQ(one.held_out_rms_px, four.held_out_rms_px);
  EXPECT_EQ(one.rig.covariance, four.rig.covariance);
}

TEST(CalibrateStereo, TakesTheLengthFromScaleBarsWhereThereAreSome) {
  const StereoRig truth = made_up_rig(0);
  Board printed_wide = kChessboard;
  printed_wide.pitch_mm = 40.02;  // stated: 40
  auto input = made_up_input(truth, printed_wide, 10, 0.01, 12);
  input.board = kChessboard;
  RandomStream random(12, 99);
  for (int i = 0; i < 20; ++i) {
    const Vec3 a(random.uniform(-100, 0), random.uniform(-150, 150), random.uniform(1400, 1800));
    const Vec3 b = a + 300 * Vec3(1, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)).normalized();
    ScaleBarView bar{300, 0.005, {}, {}};
    for (const Side side : {Side::Left, Side::Right}) {
      for (int end = 0; end < 2; ++end) {
        const auto s = static_cast<int>(side);
        const Vec3 in_camera = truth.camera_from_tracker(side) * (end == 0 ? a : b);
        bar.px[s][end] =
            project(truth.lens(side), in_camera)->px + 0.01 * Vec2(random.normal(), random.normal());
        bar.covariance[s][end] = 1e-4 * Mat2::Identity();
      }
    }
    input.bars.push_back(bar);
  }
  const auto result = calibrate_stereo(input, with(CoefficientChoice::None));
  EXPECT_NEAR(result.pitch_mm, 40.02, 0.002);
  EXPECT_NEAR(result.baseline_mm, truth.baseline_mm(), 4 * result.baseline_sigma_mm);
  EXPECT_LT(result.baseline_sigma_mm, 0.1);
}

TEST(CalibrateStereo, HasNoPerspectiveBiasOnCirclesWhichPointsWouldHave) {
  const StereoRig truth = made_up_rig(0);
  const Board circles{BoardPattern::AsymmetricCircles, 4, 11, 36, 48};
  auto input = made_up_input(truth, circles, 12, 0.002, 13, 0.7);
  const auto exact = calibrate_stereo(input, with(CoefficientChoice::None));
  input.board.circle_diameter_mm = 0;  // estimated
  const auto estimated_diameter = calibrate_stereo(input, with(CoefficientChoice::None));
  input.board.circle_diameter_mm = 1e-3;  // as good as points
  const auto points = calibrate_stereo(input, with(CoefficientChoice::None));
  const auto off = [&](const StereoCalibration& result) {
    return std::abs(result.baseline_mm - truth.baseline_mm());
  };
  EXPECT_LT(off(exact), 4 * exact.baseline_sigma_mm);
  EXPECT_LT(off(estimated_diameter), 4 * estimated_diameter.baseline_sigma_mm);
  EXPECT_NEAR(estimated_diameter.circle_diameter_mm, 48, 1.0);
  EXPECT_GT(points.stereo_rms_px, 2 * exact.stereo_rms_px);
  // Errors of the whole rig in units of what the exact model promises.
  const auto rows = estimated(exact.rig.covariance);
  const auto misfit = [&](const StereoRig& rig) {
    const VecX error = rig_error(rig, truth)(rows);
    return error.dot(*solve_positive(MatX(exact.rig.covariance(rows, rows)), error)) /
           static_cast<double>(rows.size());
  };
  EXPECT_LT(misfit(exact.rig), 2.5);
  EXPECT_GT(misfit(points.rig), 5.0);
}

}  // namespace
}  // namespace asterism
