// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/hand_eye.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

const RigidMotion kScanner = {exp_rotation({0.4, -1.2, 2.1}), {15, -40, 85}};
const RigidMotion kArtefact = {exp_rotation({0.1, 0.2, 0.3}), {300, 200, 1900}};

Mat6 diagonal(double rad, double mm) {
  Mat6 m = Mat6::Zero();
  m.diagonal() << rad * rad, rad * rad, rad * rad, mm * mm, mm * mm, mm * mm;
  return m;
}

Vec6 drawn(const Mat6& covariance, RandomStream& random) {
  Vec6 error;
  for (int i = 0; i < 6; ++i) error[i] = std::sqrt(covariance(i, i)) * random.normal();
  return error;
}

/// Views from where the scanner was turned by up to half a radian about each of the axes.
std::vector<HandEyeView> views(std::size_t count, const Vec3& axes, double noise, std::uint64_t draw) {
  std::vector<HandEyeView> all;
  RandomStream places(1, 0), errors(2, draw);
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 turn, shift;
    for (int axis = 0; axis < 3; ++axis) {
      turn[axis] = axes[axis] * places.uniform(-0.5, 0.5);
      shift[axis] = places.uniform(-100, 100);
    }
    HandEyeView view;
    const RigidMotion reference_from_scanner =
        kArtefact * RigidMotion{exp_rotation({std::numbers::pi, 0, 0}), {0, 0, 300}} *
        RigidMotion{exp_rotation(turn), shift};
    view.of_body = diagonal(1e-4, 0.02);
    view.of_artefact = diagonal(2e-4, 0.03);
    view.reference_from_body =
        perturbed(reference_from_scanner * kScanner.inverse(), noise * drawn(view.of_body, errors));
    view.scanner_from_artefact =
        perturbed(reference_from_scanner.inverse() * kArtefact, noise * drawn(view.of_artefact, errors));
    all.push_back(view);
  }
  return all;
}

TEST(HandEye, FindsTheScannerInItsBody) {
  const auto found = hand_eye(views(6, Vec3::Ones(), 0, 0));
  ASSERT_TRUE(found);
  EXPECT_LT(difference(found->body_from_scanner, kScanner).norm(), 1e-8);
  EXPECT_LT(difference(found->reference_from_artefact, kArtefact).norm(), 1e-8);
}

TEST(HandEye, StatesItsCovarianceHonestly) {
  constexpr int kDraws = 1000;
  double nees = 0, chi2 = 0, degrees = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto found = hand_eye(views(10, Vec3::Ones(), 1, static_cast<std::uint64_t>(draw)));
    ASSERT_TRUE(found);
    const Vec6 error = difference(found->body_from_scanner, kScanner);
    nees += error.dot(*solve_positive(found->covariance, error)) / kDraws;
    chi2 += found->chi2 / kDraws;
    degrees = found->degrees;
  }
  EXPECT_NEAR(nees, 6, 0.33);        // three sigmas: 3 √(12/1000)
  EXPECT_NEAR(chi2, degrees, 0.93);  // 48 degrees: 3 √(96/1000)
}

TEST(HandEye, NamesMotionsThatDoNotTellIt) {
  EXPECT_EQ(hand_eye(views(2, Vec3::Ones(), 1, 0)).error(), HandEyeFailure::TooFewViews);
  EXPECT_EQ(hand_eye(views(6, Vec3::Zero(), 1, 0)).error(), HandEyeFailure::NoTurn);
  EXPECT_EQ(hand_eye(views(6, Vec3(0, 1, 0), 1, 0)).error(), HandEyeFailure::OneAxis);
  EXPECT_NE(text_of(HandEyeFailure::OneAxis).find("second"), std::string::npos);
}

TEST(HandEye, DoesNotChangeWhenTheTrackerIsMoved) {
  auto all = views(8, Vec3::Ones(), 1, 3);
  const auto before = hand_eye(all);
  const RigidMotion elsewhere = {exp_rotation({0.5, 0.6, -0.7}), {1000, -200, 30}};
  for (HandEyeView& view : all) view.reference_from_body = elsewhere * view.reference_from_body;
  const auto after = hand_eye(all);
  ASSERT_TRUE(before && after);
  // Stated variances are alike along all axes, so turning them changes nothing but rounding and the step at
  // which the search stops.
  EXPECT_LT(difference(before->body_from_scanner, after->body_from_scanner).norm(), 1e-6);
}

}  // namespace
}  // namespace asterism
