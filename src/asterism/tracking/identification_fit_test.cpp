// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

const std::vector<UncertainPoint> kTargets = {{{200, -100, 590}, Mat3::Zero()},
                                              {{-100, 300, 610}, Mat3::Zero()},
                                              {{-200, 100, 600}, Mat3::Zero()},
                                              {{0, -250, 605}, Mat3::Zero()}};
const std::vector<Correspondence> kLabels = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
const RigidMotion kThere{exp_rotation(Vec3(0.3, -0.4, 1.1)), Vec3(120, -80, 2300)};

/// Depth is four times worse than the rest.
std::vector<UncertainPoint> draw(RandomStream& random) {
  const Vec3 sigma(0.05, 0.05, 0.2);
  std::vector<UncertainPoint> scene;
  for (const auto& target : kTargets) {
    const Vec3 noise(random.normal(), random.normal(), random.normal());
    scene.push_back({kThere * target.position + sigma.cwiseProduct(noise), sigma.cwiseAbs2().asDiagonal()});
  }
  return scene;
}

TEST(FitLabels, FindsTheMotionExactlyWithoutNoise) {
  std::vector<UncertainPoint> scene;
  for (const auto& target : kTargets) scene.push_back({kThere * target.position, Mat3::Identity()});
  const auto fit = fit_labels(kLabels, kTargets, scene);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->tracker_from_body, kThere).norm(), 1e-9);
  EXPECT_LT(fit->rms_mm, 1e-9);
}

TEST(FitLabels, IsHonestAboutItsCovarianceAndItsResiduals) {
  constexpr int kDraws = 2000;
  double chi_square = 0;
  double distance = 0;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(21, static_cast<std::uint64_t>(i));
    const auto fit = fit_labels(kLabels, kTargets, draw(random));
    ASSERT_TRUE(fit);
    const Vec6 error = difference(fit->tracker_from_body, kThere);
    chi_square += fit->chi_square / kDraws;
    distance += error.dot(fit->information * error) / kDraws;
  }
  // Both have 6 degrees of freedom: σ of the mean = √(2·6 / 2000) = 0.077; four of them.
  EXPECT_NEAR(chi_square, 6, 0.31);
  EXPECT_NEAR(distance, 6, 0.31);
}

TEST(FitLabels, NeedsThreePointsOffOneLine) {
  RandomStream random(22, 0);
  const auto scene = draw(random);
  EXPECT_EQ(fit_labels(std::span(kLabels).first(2), kTargets, scene).error(), RigidFitFailure::TooFewPoints);
  const std::vector<UncertainPoint> line = {
      {{0, 0, 0}, Mat3::Zero()}, {{1, 0, 0}, Mat3::Zero()}, {{3, 0, 0}, Mat3::Zero()}};
  std::vector<UncertainPoint> seen = line;
  for (auto& point : seen) point.covariance = Mat3::Identity();
  EXPECT_EQ(fit_labels(std::span(kLabels).first(3), line, seen).error(), RigidFitFailure::Collinear);
}

TEST(ChiSquareLimit, IsNearTheQuantileOfThatTail) {
  for (const double degrees : {3.0, 6.0, 12.0, 30.0}) {
    // P(z > 3) = 0.00135; the approximation is good to two per cent there.
    const double exact = chi_square_quantile(1 - 0.001349898, degrees);
    EXPECT_NEAR(chi_square_limit(3, degrees) / exact, 1, 0.02) << degrees;
  }
}

TEST(LogBallVolume, KnowsTheBallsOfTwoAndThreeDimensions) {
  EXPECT_NEAR(std::exp(log_ball_volume(2, 3)), 9 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(std::exp(log_ball_volume(3, 2)), 32.0 / 3.0 * std::numbers::pi, 1e-9);
}

TEST(LogAccidentalFits, EqualsTheCountAmongRandomPoints) {
  // Triangles of 60, 80 and 100 mm among points at random in a cube, counted by trying all triples. The
  // cube is closed on itself so that its faces take nothing away.
  constexpr double kSide = 600;
  constexpr double kSigma = 2;
  constexpr double kLimit = 9;  // of χ² with 3 degrees of freedom: above its mean, so counted as it is
  constexpr int kPoints = 60;
  constexpr int kTrials = 900;
  const std::vector<UncertainPoint> triangle = {
      {{0, 0, 0}, Mat3::Zero()}, {{60, 0, 0}, Mat3::Zero()}, {{0, 80, 0}, Mat3::Zero()}};
  const std::vector<Correspondence> labels(kLabels.begin(), kLabels.begin() + 3);
  const auto wrapped = [&](const Vec3& from, const Vec3& to) -> Vec3 {
    const Vec3 apart = to - from;
    return from + apart - kSide * (apart / kSide).array().round().matrix();
  };
  int counted = 0;
  double expected = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomStream random(23, static_cast<std::uint64_t>(trial));
    std::vector<Vec3> points;
    for (int i = 0; i < kPoints; ++i) {
      points.push_back(kSide * Vec3(random.uniform(), random.uniform(), random.uniform()));
    }
    for (const Vec3& a : points) {
      for (const Vec3& far_b : points) {
        const Vec3 b = wrapped(a, far_b);
        if (std::abs((b - a).norm() - 60) > 15) continue;
        for (const Vec3& far_c : points) {
          const Vec3 c = wrapped(a, far_c);
          if (std::abs((c - a).norm() - 80) > 15 || std::abs((c - b).norm() - 100) > 15) continue;
          std::vector<UncertainPoint> scene;
          for (const Vec3& p : {a, b, c}) scene.push_back({p, kSigma * kSigma * Mat3::Identity()});
          auto fit = fit_labels(labels, triangle, scene);
          if (!fit || fit->chi_square > kLimit) continue;
          ++counted;
          fit->chi_square = kLimit;
          const Clutter clutter{kPoints, (kPoints - 1) / (kSide * kSide * kSide)};
          expected = kTrials * std::exp(log_accidental_fits(*fit, 3, 3, clutter));
        }
      }
    }
  }
  ASSERT_GT(counted, 100);
  // Four Poisson standard deviations; (N − 1)(N − 2) stands as (N − 1)².
  EXPECT_NEAR(counted, expected, 4 * std::sqrt(expected) + 0.05 * expected);
}

TEST(LogAccidentalFits, FallWithEachTargetAndRiseWithDensity) {
  RandomStream random(24, 0);
  const auto scene = draw(random);
  const auto four = fit_labels(kLabels, kTargets, scene);
  const auto three = fit_labels(std::span(kLabels).first(3), kTargets, scene);
  ASSERT_TRUE(four && three);
  const Clutter few{60, 1e-8};
  const Clutter many{600, 1e-7};
  EXPECT_LT(log_accidental_fits(*four, 4, 6, few), log_accidental_fits(*three, 3, 6, few) - 10);
  EXPECT_GT(log_accidental_fits(*four, 4, 6, many),
            log_accidental_fits(*four, 4, 6, few) + 3 * std::log(10.0));
}

}  // namespace
}  // namespace asterism
