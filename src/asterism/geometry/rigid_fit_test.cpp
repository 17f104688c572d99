// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/rigid_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace asterism {
namespace {

// Scheme S1 of the paper's Table 1.
const std::vector<Vec3> kS1 = {{250, 0, 600},  {0, 300, 610},   {-250, 0, 590},
                               {0, -300, 605}, {220, 220, 580}, {-220, -220, 605}};
const RigidMotion kMoved{exp_rotation({0.4, -1.1, 0.7}), {120, -340, 2300}};

std::vector<Vec3> moved(const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const Vec3& point : points) result.push_back(kMoved * point);
  return result;
}

TEST(FitRigidMotion, FindsTheMotionExactly) {
  const auto fit = fit_rigid_motion(moved(kS1), kS1);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->a_from_b, kMoved).norm(), 1e-9);
  EXPECT_LT(fit->rms, 1e-9);
}

TEST(FitRigidMotion, NeverReflectsEvenWhenAMirrorImageWouldFitBetter) {
  std::vector<Vec3> mirrored = kS1;
  for (Vec3& point : mirrored) point.x() = -point.x();
  const auto fit = fit_rigid_motion(mirrored, kS1);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->a_from_b.rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
  EXPECT_GT(fit->rms, 1.0) << "a reflection would fit to zero";
}

TEST(FitRigidMotion, FitsAFlatLayoutWithAProperRotation) {
  const std::vector<Vec3> flat = {{0, 0, 0}, {300, 0, 0}, {0, 200, 0}, {150, 220, 0}};
  const auto fit = fit_rigid_motion(moved(flat), flat);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->a_from_b, kMoved).norm(), 1e-9);
}

TEST(FitRigidMotion, FollowsItsWeights) {
  std::vector<Vec3> disturbed = moved(kS1);
  disturbed[0] += Vec3(50, 0, 0);
  const std::vector<double> without_first = {1e-12, 1, 1, 1, 1, 1};
  const auto fit = fit_rigid_motion(disturbed, kS1, without_first);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->a_from_b, kMoved).norm(), 1e-6);
}

TEST(FitRigidMotion, NamesTheReasonWhenItCannot) {
  const std::vector<Vec3> two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(fit_rigid_motion(two, two).error(), RigidFitFailure::TooFewPoints);
  const std::vector<Vec3> line = {{0, 0, 0}, {100, 0, 0}, {300, 0, 0}, {700, 0, 0}};
  EXPECT_EQ(fit_rigid_motion(line, line).error(), RigidFitFailure::Collinear);
}

TEST(FitRigidMotion, RefusesListsOfDifferentLength) {
  EXPECT_THROW((void)fit_rigid_motion(kS1, std::vector<Vec3>{{0, 0, 0}}), ContractViolation);
}

TEST(FrameFromThreePoints, IsAProperRotationUnlikeThePrintedMatrix) {
  const auto frame = frame_from_three_points(kS1[0], kS1[1], kS1[2]);
  ASSERT_TRUE(frame);
  const Mat3 axes = frame->rotation.toRotationMatrix();
  EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12);
  EXPECT_LT((axes.col(0) - (kS1[1] - kS1[0]).normalized()).norm(), 1e-12);
  // Eqs. 11–13 as printed: [V1 V2 n] of unit vectors; the ledger gives its determinant, 0.769.
  const Vec3 v1 = (kS1[1] - kS1[0]).normalized(), v2 = (kS1[2] - kS1[0]).normalized();
  Mat3 printed;
  printed << v1, v2, v1.cross(v2).normalized();
  EXPECT_NEAR(printed.determinant(), 0.769, 1e-3);
}

TEST(ThreePointMotion, FindsTheMotionExactlyWithoutNoise) {
  const auto fit = three_point_motion(moved(kS1), kS1);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->a_from_b, kMoved).norm(), 1e-9);
}

}  // namespace
}  // namespace asterism
