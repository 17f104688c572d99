// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/two_view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

StereoRig converging(int coefficients = 0) {
  StereoRig rig;
  rig.left = {2400, 2402, 0.3, 1023.5, 767.5, {-0.12, 0.08, 3e-4, -2e-4, -0.02}, coefficients, 2048, 1536};
  rig.right = {2398, 2401, -0.2, 1020.5, 770.0, {-0.11, 0.07, -2e-4, 3e-4, -0.01}, coefficients, 2048, 1536};
  rig.right_from_left = RigidMotion{exp_rotation({0.01, -0.3, 0.02}), Vec3(1000, 20, -10)}.inverse();
  return rig;
}

Vec2 image(const StereoRig& rig, Side side, const Vec3& point) {
  return project(rig.lens(side), rig.camera_from_tracker(side) * point).value().px;
}

Vec3 somewhere(RandomStream& random) {
  return {random.uniform(0, 600), random.uniform(-400, 400), random.uniform(1800, 2600)};
}

TEST(TriangulatePair, OfParallelCamerasIsThePapersBaselineTimesFocalLengthOverDisparity) {
  StereoRig rig;
  rig.left = rig.right = {2000, 2000, 0, 1000, 700, {}, 0, 2000, 1400};
  rig.right_from_left.translation = Vec3(-800, 0, 0);
  const double left_x = 350, right_x = -240, y = 120;  // px from the principal point
  const Mat2 covariance = 0.01 * Mat2::Identity();
  const auto point = triangulate_pair(rig, Vec2(1000 + left_x, 700 + y), covariance,
                                      Vec2(1000 + right_x, 700 + y), covariance);
  ASSERT_TRUE(point);
  const double z = 800 * 2000 / (left_x - right_x);
  EXPECT_NEAR(point->in_tracker.z(), z, 1e-9);
  EXPECT_NEAR(point->in_tracker.x(), left_x * z / 2000, 1e-9);
  EXPECT_NEAR(point->in_tracker.y(), y * z / 2000, 1e-9);
  EXPECT_NEAR(point->epipolar_error_px, 0, 1e-9);
  // σ_z = z² / (b f) · σ_disparity, with σ = 0.1 px in each image.
  EXPECT_NEAR(std::sqrt(point->covariance(2, 2)), z * z / (800.0 * 2000.0) * 0.1 * std::sqrt(2.0), 1e-6);
}

class TwoViewsThrough : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, TwoViewsThrough, testing::Values(0, 5));

TEST_P(TwoViewsThrough, FindsThePointThatWasProjected) {
  const StereoRig rig = converging(GetParam());
  RandomStream random(41, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 truth = somewhere(random);
    const auto point = triangulate_pair(rig, image(rig, Side::Left, truth), Mat2::Identity(),
                                        image(rig, Side::Right, truth), Mat2::Identity());
    ASSERT_TRUE(point);
    EXPECT_LT((point->in_tracker - truth).norm(), 1e-6);
    EXPECT_LT(std::abs(point->epipolar_error_px), 1e-7);
  }
}

TEST_P(TwoViewsThrough, CovarianceHoldsOverTwoThousandDraws) {
  const StereoRig rig = converging(GetParam());
  Mat2 left, right;  // unlike each other and not round
  left << 0.04, 0.015, 0.015, 0.01;
  right << 0.01, -0.004, -0.004, 0.03;
  const Mat2 left_root = left.llt().matrixL(), right_root = right.llt().matrixL();
  double nees = 0, epipolar = 0, inside = 0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(42, static_cast<std::uint64_t>(i));
    const Vec3 truth = somewhere(random);
    const Vec2 left_px = image(rig, Side::Left, truth) + left_root * Vec2(random.normal(), random.normal());
    const Vec2 right_px =
        image(rig, Side::Right, truth) + right_root * Vec2(random.normal(), random.normal());
    const auto point = triangulate_pair(rig, left_px, left, right_px, right);
    ASSERT_TRUE(point);
    const Vec3 error = point->in_tracker - truth;
    const double square = error.dot(point->covariance.inverse() * error);
    nees += square / kDraws;
    inside += square < 7.815 ? 1.0 / kDraws : 0;  // 95 % of χ² with three degrees
    epipolar += std::pow(point->epipolar_error_px / point->epipolar_sigma_px, 2) / kDraws;
  }
  EXPECT_NEAR(nees, 3.0, 0.17);  // three sigmas: √(6/2000) · 3
  EXPECT_NEAR(inside, 0.95, 0.015);
  EXPECT_NEAR(epipolar, 1.0, 0.1);
}

TEST_P(TwoViewsThrough, RigCovarianceIsWhatMovingTheRigDoes) {
  StereoRig rig = converging(GetParam());
  const int of_lens = 5 + GetParam();
  VecX sigma(2 * of_lens + 6);
  for (int camera = 0; camera < 2; ++camera) {
    sigma.segment(camera * of_lens, 5) << 0.4, 0.4, 1e-4, 0.5, 0.5;
    for (int i = 0; i < GetParam(); ++i) sigma(camera * of_lens + 5 + i) = i == 2 || i == 3 ? 1e-4 : 1e-3;
  }
  sigma.tail<6>() << 1e-4, 1e-4, 1e-4, 0.1, 0.1, 0.1;
  rig.covariance = sigma.cwiseAbs2().asDiagonal();
  rig.covariance_order = rig_parameter_names(rig);

  const Vec3 truth(400, 250, 2200);
  const Vec2 left_px = image(rig, Side::Left, truth), right_px = image(rig, Side::Right, truth);
  const Mat2 tiny = 1e-8 * Mat2::Identity();
  const auto stated = triangulate_pair(rig, left_px, tiny, right_px, tiny);
  ASSERT_TRUE(stated);

  constexpr int kDraws = 3000;
  Mat3 seen = Mat3::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(43, static_cast<std::uint64_t>(draw));
    StereoRig moved = converging(GetParam());
    for (Lens* lens : {&moved.left, &moved.right}) {
      const int first = lens == &moved.left ? 0 : of_lens;
      double* values[] = {&lens->fx, &lens->fy, &lens->skew, &lens->cx, &lens->cy};
      for (int i = 0; i < 5; ++i) *values[i] += sigma(first + i) * random.normal();
      for (int i = 0; i < GetParam(); ++i) {
        lens->distortion[static_cast<std::size_t>(i)] += sigma(first + 5 + i) * random.normal();
      }
    }
    Vec6 error;
    for (int i = 0; i < 6; ++i) error(i) = sigma(2 * of_lens + i) * random.normal();
    moved.right_from_left = perturbed(moved.right_from_left, error);
    const auto point = triangulate_pair(moved, left_px, tiny, right_px, tiny);
    ASSERT_TRUE(point);
    seen += (point->in_tracker - truth) * (point->in_tracker - truth).transpose() / kDraws;
  }
  // Whitened by what is stated, what is seen is the identity within four sigmas of 3000 draws.
  const Mat3 root = stated->covariance.llt().matrixL();
  const Mat3 white = root.inverse() * seen * root.inverse().transpose();
  EXPECT_LT((white - Mat3::Identity()).cwiseAbs().maxCoeff(), 4 * std::sqrt(2.0 / kDraws));
}

TEST(TriangulatePair, DoesNotChangeWhenTheCellIsMirroredLeftToRight) {
  const StereoRig rig = converging();
  StereoRig swapped;
  swapped.left = rig.right;
  swapped.right = rig.left;
  swapped.right_from_left = rig.right_from_left.inverse();
  const Vec3 truth(300, -100, 2300);
  const Vec2 l = image(rig, Side::Left, truth) + Vec2(0.3, -0.4),
             r = image(rig, Side::Right, truth) + Vec2(-0.2, 0.5);
  const Mat2 c = 0.04 * Mat2::Identity();
  const auto one = triangulate_pair(rig, l, c, r, c);
  const auto other = triangulate_pair(swapped, r, c, l, c);
  ASSERT_TRUE(one && other);
  EXPECT_LT((rig.right_from_left * one->in_tracker - other->in_tracker).norm(), 1e-6);
  EXPECT_NEAR(std::abs(one->epipolar_error_px), std::abs(other->epipolar_error_px), 1e-9);
}

TEST(TriangulatePair, NamesTheReasonWhenTheRaysAreParallel) {
  StereoRig rig;
  rig.left = rig.right = {2000, 2000, 0, 1000, 700, {}, 0, 2000, 1400};
  rig.right_from_left.translation = Vec3(-800, 0, 0);
  const Mat2 c = Mat2::Identity();
  EXPECT_EQ(triangulate_pair(rig, Vec2(900, 700), c, Vec2(900, 700), c).error(),
            TwoViewFailure::RaysParallel);
}

TEST(TriangulatePair, NamesTheReasonWhenTheRaysMeetBehind) {
  StereoRig rig;
  rig.left = rig.right = {2000, 2000, 0, 1000, 700, {}, 0, 2000, 1400};
  rig.right_from_left.translation = Vec3(-800, 0, 0);
  const Mat2 c = Mat2::Identity();
  EXPECT_EQ(triangulate_pair(rig, Vec2(900, 700), c, Vec2(1000, 700), c).error(),
            TwoViewFailure::BehindCamera);
}

TEST(TriangulatePair, NamesTheReasonWhenTheLensFoldsBack) {
  StereoRig rig = converging(4);
  rig.left.distortion = {-0.5};
  const Mat2 c = Mat2::Identity();
  EXPECT_EQ(triangulate_pair(rig, Vec2(rig.left.cx + 0.6 * rig.left.fx, 700), c, Vec2(900, 700), c).error(),
            TwoViewFailure::LensFolds);
}

TEST(CheckRig, SaysInWhichOrderACovarianceMustCome) {
  StereoRig rig = converging(4);
  rig.covariance = MatX::Identity(24, 24);
  rig.covariance_order = rig_parameter_names(rig);
  EXPECT_NO_THROW(check_rig(rig, "rig.yaml"));
  std::swap(rig.covariance_order[0], rig.covariance_order[1]);
  try {
    check_rig(rig, "rig.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("covariance_order must be: fx1 fy1 skew1 cx1 cy1 k1_1"),
              std::string::npos)
        << error.what();
  }
}

TEST(PixelByRig, EqualsCentralDifferences) {
  const StereoRig rig = converging(5);
  const Vec3 point(350, -200, 2100);
  const auto at = project(rig.right, rig.right_from_left * point);
  const MatX by = pixel_by_rig(rig, Side::Right, point, at->by_point);
  for (int axis = 0; axis < 6; ++axis) {
    const auto moved = [&](double step) {
      return project(rig.right, perturbed(rig.right_from_left, step * Vec6::Unit(axis)) * point)->px;
    };
    const Vec2 slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
    EXPECT_LT((slope - by.col(20 + axis)).norm(), 1e-4 * (1 + slope.norm()));
  }
  EXPECT_EQ(by.leftCols(10).norm(), 0);
}

}  // namespace
}  // namespace asterism
