// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/registration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr double kNoise_mm = 0.025;

Mat6 pose_noise() {
  Mat6 m = Mat6::Zero();
  m.diagonal() << 4e-9, 4e-9, 4e-9, 4e-4, 4e-4, 4e-4;  // 0.0036°, 0.02 mm
  return m;
}

/// Places on a cylinder of 150 mm radius about z, or on a box-like corner of three faces, about 3 mm apart.
SurfaceSpot on_cylinder(RandomStream& random) {
  const double angle = random.uniform(0, 1.2), height = random.uniform(-100, 100);
  const Vec3 normal(std::cos(angle), std::sin(angle), 0);
  return {150 * normal + Vec3(0, 0, height), normal, kNoise_mm * kNoise_mm};
}
SurfaceSpot on_corner(RandomStream& random) {
  const int axis = static_cast<int>(random.below(3));
  Vec3 at(random.uniform(0, 150), random.uniform(0, 150), random.uniform(0, 150));
  at[axis] = 150;
  return {at, Vec3::Unit(axis), kNoise_mm * kNoise_mm};
}

/// Scans of one surface, each with the error of its pose and the scanner's noise; `wrong` has another error
/// on top.
std::vector<ScanSpots> scans_of(SurfaceSpot (*surface)(RandomStream&), std::uint64_t seed,
                                std::optional<std::size_t> wrong = {}, const Vec6& error = Vec6::Zero()) {
  std::vector<ScanSpots> scans;
  for (std::size_t scan = 0; scan < 5; ++scan) {
    RandomStream random(seed, scan);
    ScanSpots spots;
    spots.scan = static_cast<int>(scan);
    spots.noise = pose_noise();
    spots.origin = Vec3(300, 300, 100);
    Vec6 off;
    for (int i = 0; i < 6; ++i) off[i] = std::sqrt(spots.noise(i, i)) * random.normal();
    RigidMotion moved = rotation_about(spots.origin, exp_rotation(off.head<3>()));
    moved.translation += off.tail<3>();
    if (scan == wrong) {
      RigidMotion more = rotation_about(Vec3(75, 75, 75), exp_rotation(error.head<3>()));
      more.translation += error.tail<3>();
      moved = more * moved;
    }
    for (int i = 0; i < 1200; ++i) {
      SurfaceSpot spot = surface(random);
      spot.at += kNoise_mm * random.normal() * spot.normal;
      spots.spots.push_back({moved * spot.at, moved.rotation * spot.normal, spot.variance_mm2});
    }
    scans.push_back(std::move(spots));
  }
  return scans;
}

Vec6 turned(double deg) { return (Vec6() << rad_from_deg(deg) * Vec3(0, 0.6, 0.8), Vec3::Zero()).finished(); }
Vec6 shifted(double mm) { return (Vec6() << Vec3::Zero(), mm * Vec3(0.6, 0, 0.8)).finished(); }

TEST(RegisterScans, LetsHonestScansBe) {
  double chi2 = 0, degrees = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    for (const auto& found : register_scans(scans_of(on_corner, seed), {})) {
      ASSERT_TRUE(found);
      EXPECT_FALSE(found->disagrees) << found->shift_mm << " mm " << found->turn_deg << "°";
      EXPECT_TRUE(found->free.empty());
      chi2 += found->chi2;
      degrees += found->degrees;
    }
  }
  // 15 scans; the mean of the others is taken to be as uncertain as one scan, so χ² lies below its degrees.
  EXPECT_LT(chi2 / degrees, 1.3);
  EXPECT_GT(chi2 / degrees, 0.3);
}

TEST(RegisterScans, FlagsAPoseThatIsOffByAMillimetreOrHalfADegreeAndNoOther) {
  for (const Vec6& error : {shifted(1), turned(0.5)}) {
    const auto judged = register_scans(scans_of(on_corner, 7, 2, error), {});
    for (std::size_t scan = 0; scan < judged.size(); ++scan) {
      ASSERT_TRUE(judged[scan]);
      EXPECT_EQ(judged[scan]->disagrees, scan == 2) << scan;
    }
    // What the shape asks for takes the error back.
    // At the middle of its pairs, which lies 25 mm from where it was turned: 25 · 0.0087 = 0.22 mm at most.
    EXPECT_NEAR(judged[2]->shift_mm, error.tail<3>().norm(), 0.25);
    EXPECT_NEAR(judged[2]->turn_deg, deg_from_rad(error.head<3>().norm()), 0.05);
  }
}

TEST(RegisterScans, DoesNotJudgeWhatTheShapeLeavesFree) {
  // A turn about the cylinder's own axis by half a degree cannot be seen; one across it can.
  const auto at_axis = [](const Vec3& turn, const Vec3& slide) {
    Vec6 motion;
    motion << turn, slide - turn.cross(Vec3(0, 0, 0) - Vec3(75, 75, 75));
    return motion;
  };
  const Vec6 free = at_axis(rad_from_deg(0.5) * Vec3::UnitZ(), Vec3(0, 0, 1));
  auto judged = register_scans(scans_of(on_cylinder, 8, 2, free), {});
  ASSERT_TRUE(judged[2]);
  EXPECT_FALSE(judged[2]->disagrees);
  EXPECT_EQ(judged[2]->degrees, 4);
  ASSERT_EQ(judged[2]->free.size(), 2u);
  const std::string told = judged[2]->free[0] + "; " + judged[2]->free[1];
  EXPECT_NE(told.find("a turn about the axis (0.00, 0.00, 1.00) through (0, 0"), std::string::npos) << told;
  judged = register_scans(scans_of(on_cylinder, 8, 2, at_axis(Vec3::Zero(), Vec3(0.8, 0.6, 0))), {});
  EXPECT_TRUE(judged[2]->disagrees);
}

TEST(RegisterScan, CorrectsByWhatItKnowsBetter) {
  // The tracked pose is known to 1 mm only: the shape corrects it to its own precision, and says so.
  auto scans = scans_of(on_corner, 9, 2, shifted(0.8));
  scans[2].noise = Mat6::Zero();
  scans[2].noise.diagonal() << 1e-5, 1e-5, 1e-5, 1, 1, 1;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (i != 2) scans[i].noise *= 0.01;
  }
  const auto judged = register_scans(scans, {});
  ASSERT_TRUE(judged[2]);
  const Vec3 at(100, 100, 150);
  const Vec3 before = at + shifted(0.8).tail<3>();
  EXPECT_LT((motion_of(*judged[2]) * before - at).norm(), 0.1);
  EXPECT_LT(judged[2]->covariance(3, 3), 0.1);
  // An honest pose that is known better than the shape tells stays where it is.
  EXPECT_LT((motion_of(*judged[0]) * at - at).norm(), 0.02);
}

TEST(RegisterScan, NeedsEnoughPairs) {
  const FindSpot nothing = [](const SurfaceSpot&) { return std::nullopt; };
  const auto scans = scans_of(on_corner, 1);
  EXPECT_EQ(register_scan(scans[0].spots, nothing, pose_noise(), pose_noise(), Vec3::Zero(), {}).error(),
            RegistrationFailure::TooFewPairs);
}

TEST(RegisterScans, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto scans = scans_of(on_corner, 3);
  set_thread_count(1);
  const auto one = register_scans(scans, {});
  set_thread_count(3);
  const auto three = register_scans(scans, {});
  set_thread_count(0);
  EXPECT_EQ(one[1]->by_shape, three[1]->by_shape);
  EXPECT_EQ(one[4]->chi2, three[4]->chi2);
}

}  // namespace
}  // namespace asterism
