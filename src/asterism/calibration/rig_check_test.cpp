// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/rig_check.hpp"

#include <gtest/gtest.h>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

struct Seen {
  std::vector<LengthObservation> lengths;
  std::vector<EpipolarObservation> epipolar;
};

Seen seen_by_rig(double scale, double drift_px, double bent_px) {
  Seen seen;
  RandomStream random(5, 0);
  for (int i = 0; i < 60; ++i) {
    const Vec3 a(random.uniform(-500, 500), random.uniform(-300, 300), random.uniform(1500, 2500));
    const Vec3 noise(0.03 * random.normal(), 0.03 * random.normal(), 0.03 * random.normal());
    const Vec3 b = a + Vec3(600, 0, 0);
    const Mat3 covariance = 0.5 * 0.03 * 0.03 * Mat3::Identity();
    seen.lengths.push_back({"bar", 1.0 * i, 600, scale * a, scale * b + noise, covariance, covariance});
    const Vec2 px(random.uniform(0, 2000), random.uniform(0, 1500));
    const double corner = px.x() > 2000 / 1.5 && px.y() > 1000 ? bent_px : 0.0;
    seen.epipolar.push_back({1.0 * i, px, drift_px * (i / 59.0 - 0.5) + corner + 0.02 * random.normal()});
  }
  return seen;
}

RigCheck checked(const Seen& seen) { return check_rig(seen.lengths, seen.epipolar, 2000, 1500, {}); }

TEST(CheckRig, CallsASoundRigGood) {
  const RigCheck check = checked(seen_by_rig(1, 0, 0));
  EXPECT_EQ(check.verdict, RigVerdict::Good);
  EXPECT_TRUE(check.reasons.empty());
  EXPECT_NEAR(check.length_rms_mm, 0.03, 0.008);
  EXPECT_NEAR(check.lengths.at(0).rms_of_sigma, 1.0, 0.3);
}

TEST(CheckRig, TellsAScaleErrorInPartsPerMillion) {
  const RigCheck check = checked(seen_by_rig(1.0004, 0, 0));
  EXPECT_EQ(check.verdict, RigVerdict::Bad);
  EXPECT_NEAR(check.scale_ppm, 400, 4 * check.scale_sigma_ppm);
  EXPECT_NE(check.reasons.at(0).find("too long"), std::string::npos);
}

TEST(CheckRig, SeesTheEpipolarErrorDrift) {
  const RigCheck check = checked(seen_by_rig(1, 0.4, 0));
  EXPECT_EQ(check.verdict, RigVerdict::Bad);
  EXPECT_NEAR(check.drift_px, 0.4, 4 * check.drift_sigma_px);
}

TEST(CheckRig, SaysInWhichPartOfTheImageSightLinesMiss) {
  const RigCheck check = checked(seen_by_rig(1, 0, 0.5));
  EXPECT_EQ(check.verdict, RigVerdict::Bad);
  EXPECT_NE(check.reasons.at(0).find("bottom right"), std::string::npos);
}

TEST(CheckRig, DoubtsWhatItSawTooSeldom) {
  Seen seen = seen_by_rig(1, 0, 0);
  seen.lengths.resize(4);
  EXPECT_EQ(checked(seen).verdict, RigVerdict::Doubtful);
}

TEST(CheckRig, HasNothingToSayWithoutALength) {
  EXPECT_THROW((void)check_rig({}, {}, 100, 100, {}), MeasurementError);
}

}  // namespace
}  // namespace asterism
