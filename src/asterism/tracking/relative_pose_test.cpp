// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/relative_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

Mat6 covariance(double turn_rad, double shift_mm) {
  Mat6 c = Mat6::Zero();
  c.diagonal() << turn_rad * turn_rad, 2 * turn_rad * turn_rad, turn_rad * turn_rad, shift_mm * shift_mm,
      shift_mm * shift_mm, 9 * shift_mm * shift_mm;
  return c;
}

RigidMotion drawn(const RigidMotion& truth, const Mat6& c, RandomStream& random) {
  Vec6 error;
  for (int i = 0; i < 6; ++i) error(i) = std::sqrt(c(i, i)) * random.normal();
  return perturbed(truth, error);
}

TEST(RelativePose, CovarianceHoldsOverTwoThousandDraws) {
  const RigidMotion a{exp_rotation({0.4, -1.0, 0.3}), Vec3(100, 50, 2300)};
  const RigidMotion b{exp_rotation({-1.4, 0.2, 0.9}), Vec3(-300, 150, 1900)};
  const Mat6 of_a = covariance(2e-4, 0.02), of_b = covariance(4e-4, 0.01);
  double nees = 0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(71, static_cast<std::uint64_t>(i));
    const PoseEstimate relative =
        relative_pose({drawn(a, of_a, random), of_a}, {drawn(b, of_b, random), of_b});
    const Vec6 error = difference(relative.tracker_from_body, a.inverse() * b);
    nees += error.dot(*solve_positive(relative.covariance, error)) / kDraws;
  }
  EXPECT_NEAR(nees, 6.0, 0.24);  // three sigmas: 3 √(12/2000)
}

TEST(RelativePose, DoesNotChangeWhenTheTrackerIsMoved) {
  const RigidMotion a{exp_rotation({0.4, -1.0, 0.3}), Vec3(100, 50, 2300)};
  const RigidMotion b{exp_rotation({-1.4, 0.2, 0.9}), Vec3(-300, 150, 1900)};
  const RigidMotion elsewhere{exp_rotation({0.1, 0.2, 3.0}), Vec3(-900, 20, 77)};
  const PoseEstimate one = relative_pose({a, Mat6::Zero()}, {b, Mat6::Zero()});
  const PoseEstimate other = relative_pose({elsewhere * a, Mat6::Zero()}, {elsewhere * b, Mat6::Zero()});
  EXPECT_LT(difference(one.tracker_from_body, other.tracker_from_body).norm(), 1e-9);
}

TEST(RelativePose, OfABodyToItselfIsNoMotion) {
  const RigidMotion a{exp_rotation({0.4, -1.0, 0.3}), Vec3(100, 50, 2300)};
  EXPECT_LT(
      difference(relative_pose({a, Mat6::Zero()}, {a, Mat6::Zero()}).tracker_from_body, RigidMotion{}).norm(),
      1e-9);
}

}  // namespace
}  // namespace asterism
