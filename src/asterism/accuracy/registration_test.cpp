// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/registration.hpp"

#include <gtest/gtest.h>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/visibility/scene_for_tests.hpp"

namespace asterism {
namespace {

constexpr double kSigma = 0.1;
const Vec3 kPart(0, 0, 900);

/// The figures are known to three decimals.
constexpr double kDigits = 0.0006;

TEST(RegistrationErrorMm, IsKnownForTheSixTargetLayouts) {
  const std::vector<double> expected = {0.117, 0.119, 0.118};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(registration_error_mm(scene::kTable1[i], kPart, kSigma).value(), expected[i], kDigits) << i;
  }
}

TEST(RegistrationErrorMm, IsKnownForTheFourTargetLayouts) {
  const std::vector<double> expected = {0.140, 0.106, 0.101, 0.131, 0.101};
  const std::vector<double> after_loss = {0.195, 0.140, 0.135, 0.179, 0.133};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(registration_error_mm(scene::kTable9[i], kPart, kSigma).value(), expected[i], kDigits) << i;
    EXPECT_NEAR(registration_error_after_loss_mm(scene::kTable9[i], kPart, kSigma).value(), after_loss[i],
                kDigits)
        << i;
  }
}

TEST(RegistrationErrorMm, IsThatOfTheWholeCovariance) {
  for (const scene::Layout& layout : scene::kTable1) {
    const Mat6 covariance = inverse_positive(registration_information(layout, kSigma)).value();
    const double whole = std::sqrt(covariance_of_point({}, covariance, kPart).trace());
    EXPECT_NEAR(registration_error_mm(layout, kPart, kSigma).value(), whole, 1e-10);
    EXPECT_NEAR(registration_rotation_error_rad(layout, kSigma).value(),
                std::sqrt(covariance.topLeftCorner<3, 3>().trace()), 1e-12);
  }
}

TEST(RegistrationErrorMm, IsThatOfTheMeanAtTheMean) {
  const scene::Layout& layout = scene::kTable1[0];
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : layout) mean += p / 6;
  EXPECT_NEAR(registration_error_mm(layout, mean, kSigma).value(), std::sqrt(3.0 / 6) * kSigma, 1e-12);
}

TEST(RegistrationRotationErrorRad, IsKnownForTheFourTargetLayouts) {
  const std::vector<double> expected_deg = {.0235, .0129, .0111, .0206, .0110};
  for (std::size_t i = 0; i < expected_deg.size(); ++i) {
    const double error = registration_rotation_error_rad(scene::kTable9[i], kSigma).value();
    EXPECT_NEAR(deg_from_rad(error), expected_deg[i], 6e-5) << i;
  }
}

TEST(RegistrationErrorMm, DoesNotDependOnWhereTheLayoutStands) {
  const RigidMotion moved{rotation_from_yaw_pitch_roll(0.3, -1.2, 2.1), {1000, -2000, 500}};
  scene::Layout elsewhere;
  for (const Vec3& p : scene::kTable1[1]) elsewhere.push_back(moved * p);
  EXPECT_NEAR(registration_error_mm(elsewhere, moved * kPart, kSigma).value(),
              registration_error_mm(scene::kTable1[1], kPart, kSigma).value(), 1e-10);
}

TEST(RegistrationErrorMm, IsUnknownWhenTheTargetsLieOnALine) {
  const std::vector<Vec3> line = {{0, 0, 0}, {100, 100, 50}, {200, 200, 100}, {-400, -400, -200}};
  EXPECT_FALSE(registration_error_mm(line, kPart, kSigma).has_value());
  EXPECT_FALSE(registration_rotation_error_rad(line, kSigma).has_value());
  const std::vector<Vec3> two_off = {{0, 0, 0}, {100, 0, 0}, {200, 0, 0}, {300, 100, 0}};
  EXPECT_TRUE(registration_error_mm(two_off, kPart, kSigma).has_value());
  // Without the last they are on a line.
  EXPECT_FALSE(registration_error_after_loss_mm(two_off, kPart, kSigma).has_value());
}

}  // namespace
}  // namespace asterism
