// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/rigid_motion.hpp"

#include <gtest/gtest.h>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

Vec3 random_vector(RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

RigidMotion random_motion(RandomStream& random) {
  return {exp_rotation(random_vector(random, 1.5)), random_vector(random, 1000)};
}

Vec6 noise_of(RandomStream& random, const Vec6& sigma) {
  Vec6 noise;
  for (int i = 0; i < 6; ++i) noise(i) = sigma(i) * random.normal();
  return noise;
}

TEST(RigidMotion, InverseUndoesItAndProductsChain) {
  RandomStream random(1, 0);
  for (int i = 0; i < 100; ++i) {
    const RigidMotion a_from_b = random_motion(random), b_from_c = random_motion(random);
    const Vec3 in_c = random_vector(random, 500);
    EXPECT_LT((a_from_b.inverse() * (a_from_b * in_c) - in_c).norm(), 1e-10);
    EXPECT_LT(((a_from_b * b_from_c) * in_c - a_from_b * (b_from_c * in_c)).norm(), 1e-9);
  }
}

TEST(ExpRotation, AndItsLogarithmUndoEachOtherFromTinyToNearlyHalfATurn) {
  for (const double angle : {0.0, 1e-12, 1e-7, 1e-4, 0.3, 3.0, 3.14159}) {
    const Vec3 omega = angle * Vec3(2, -1, 2) / 3;
    EXPECT_LT((log_rotation(exp_rotation(omega)) - omega).norm(), 1e-9) << angle;
    const Quaternion negative(-exp_rotation(omega).coeffs());
    EXPECT_LT((log_rotation(negative) - omega).norm(), 1e-9) << "the same turn, the other sign: " << angle;
  }
}

TEST(LeftJacobian, IsTheDerivativeOfTheExponential) {
  for (const Vec3& omega : {Vec3(0.4, -0.9, 0.2), Vec3(1e-6, 2e-6, 0), Vec3(0, 0, 0)}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-6 * Vec3::Unit(axis);
      const Vec3 slope =
          log_rotation(exp_rotation(omega + step) * exp_rotation(omega - step).conjugate()) / 2e-6;
      EXPECT_LT((slope - left_jacobian(omega).col(axis)).norm(), 1e-7);
    }
  }
}

TEST(YawPitchRoll, TurnsAboutZThenYThenX) {
  const Quaternion turn = rotation_from_yaw_pitch_roll(rad_from_deg(90), 0, 0);
  EXPECT_LT((turn * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-12);
  const Quaternion all = rotation_from_yaw_pitch_roll(0.1, 0.2, 0.3);
  const Quaternion by_parts = rotation_from_yaw_pitch_roll(0.1, 0, 0) *
                              rotation_from_yaw_pitch_roll(0, 0.2, 0) *
                              rotation_from_yaw_pitch_roll(0, 0, 0.3);
  EXPECT_LT(rotation_angle(all, by_parts), 1e-12);
}

TEST(RotationAbout, LeavesThePivotWhereItIs) {
  const Vec3 pivot(10, 20, 600);
  EXPECT_LT((rotation_about(pivot, exp_rotation({0.1, 0.2, 0.3})) * pivot - pivot).norm(), 1e-12);
}

TEST(Difference, UndoesPerturbed) {
  RandomStream random(2, 0);
  const RigidMotion motion = random_motion(random);
  Vec6 error;
  error << 0.01, -0.02, 0.03, 1, -2, 3;
  EXPECT_LT((difference(perturbed(motion, error), motion) - error).norm(), 1e-10);
}

// Draws errors, pushes them through the exact operation and compares the spread with the stated one.
class Covariances : public testing::Test {
 protected:
  static constexpr int kDraws = 4000;
  // A covariance of 4,000 draws is known to √(2/4000) = 2.2 %; four of those.
  static constexpr double kTolerance = 0.09;

  static void expect_alike(const MatX& drawn, const MatX& stated) {
    const MatX scale = stated.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    EXPECT_LT((scale * (drawn - stated) * scale).cwiseAbs().maxCoeff(), kTolerance);
  }

  Vec6 sigma_a = (Vec6() << 2e-4, 3e-4, 1e-4, 0.1, 0.05, 0.2).finished();
  Vec6 sigma_b = (Vec6() << 1e-4, 2e-4, 4e-4, 0.15, 0.05, 0.1).finished();
  Mat6 covariance_a = sigma_a.cwiseAbs2().asDiagonal();
  Mat6 covariance_b = sigma_b.cwiseAbs2().asDiagonal();
  RandomStream random{5, 0};
  RigidMotion a_from_b = random_motion(random), b_from_c = random_motion(random);
};

TEST_F(Covariances, OfAPointMatchDraws) {
  const Vec3 in_b(100, -300, 600);
  Mat3 drawn = Mat3::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 error = perturbed(a_from_b, noise_of(random, sigma_a)) * in_b - a_from_b * in_b;
    drawn += error * error.transpose() / kDraws;
  }
  expect_alike(drawn, covariance_of_point(a_from_b, covariance_a, in_b));
}

TEST_F(Covariances, OfAProductMatchDraws) {
  Mat6 drawn = Mat6::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const RigidMotion noisy =
        perturbed(a_from_b, noise_of(random, sigma_a)) * perturbed(b_from_c, noise_of(random, sigma_b));
    const Vec6 error = difference(noisy, a_from_b * b_from_c);
    drawn += error * error.transpose() / kDraws;
  }
  expect_alike(drawn, covariance_of_product(a_from_b, covariance_a, b_from_c, covariance_b));
}

TEST_F(Covariances, OfAnInverseMatchDraws) {
  Mat6 drawn = Mat6::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vec6 error =
        difference(perturbed(a_from_b, noise_of(random, sigma_a)).inverse(), a_from_b.inverse());
    drawn += error * error.transpose() / kDraws;
  }
  expect_alike(drawn, covariance_of_inverse(a_from_b, covariance_a));
}

}  // namespace
}  // namespace asterism
