// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/measurability.hpp"

#include <gtest/gtest.h>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

/// A flat place at the origin that faces up, and a view on it.
SurfaceSample upwards(const Vec3& at) { return {at, Vec3::UnitZ(), 0, 1, 1}; }

TriangleMesh plate(double half_mm, const Vec3& middle) {
  TriangleMesh mesh;
  for (const Vec3& corner : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}) {
    mesh.vertices.push_back(middle + half_mm * corner);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

LimitMask fails_at(const Vec3& at, double tilt_deg = 0) {
  const double tilt = rad_from_deg(tilt_deg);
  const RigidMotion view = looking_at(Vec3::Zero(), {std::sin(tilt), 0, std::cos(tilt)}, 300, 0);
  return failing_limits(Scanner{}, view.inverse(), upwards(at));
}

TEST(FailingLimits, AreThoseOfTable8) {
  EXPECT_EQ(fails_at({0, 0, 0}), 0U);
  EXPECT_EQ(fails_at({0, 0, 99}), 0U);
  EXPECT_EQ(fails_at({0, 0, 101}), mask_of(ScanLimit::Range));
  EXPECT_EQ(fails_at({0, 0, -101}), mask_of(ScanLimit::Range));
  EXPECT_EQ(fails_at({0, 0, 0}, 59), 0U);
  EXPECT_EQ(fails_at({0, 0, 0}, 61), mask_of(ScanLimit::Incidence));
}

TEST(FailingLimits, TakeTheFieldAsWideAsItIsThere) {
  // Level views have the scanner's x across the line of sight: 350 mm wide along it, 310 mm across.
  const RigidMotion view = looking_at(Vec3::Zero(), Vec3::UnitZ(), 300, 0);
  const Vec3 x = view.rotation * Vec3::UnitX(), y = view.rotation * Vec3::UnitY();
  const auto fails = [&](const Vec3& at) { return failing_limits(Scanner{}, view.inverse(), upwards(at)); };
  EXPECT_EQ(fails(174 * x), 0U);
  EXPECT_EQ(fails(176 * x), mask_of(ScanLimit::Field));
  EXPECT_EQ(fails(154 * y), 0U);
  EXPECT_EQ(fails(156 * y), mask_of(ScanLimit::Field));
  // 90 mm deeper the field is 1.3 times as wide.
  EXPECT_EQ(fails(1.29 * 175 * x - Vec3(0, 0, 90)), 0U);
  EXPECT_EQ(fails(1.31 * 175 * x - Vec3(0, 0, 90)), mask_of(ScanLimit::Field));
}

TEST(MeasuredSamples, NeedBothProjectorAndCameraToSeeThem) {
  const std::vector<SurfaceSample> samples = {upwards({0, 0, 0})};
  const std::vector<Viewpoint> views = {{looking_at(Vec3::Zero(), Vec3::UnitZ(), 300, 0)}};
  const Vec3 x = views[0].workpiece_from_scanner.rotation * Vec3::UnitX();
  const auto seen = [&](const TriangleMesh& before) {
    return bit_at(measured_samples(views, samples, Scanner{}, RayScene(before), {}).row(0), 0);
  };
  EXPECT_TRUE(seen({}));
  // Halfway up the two ways are 40 mm to either side of the axis.
  EXPECT_FALSE(seen(plate(10, 40 * x + Vec3(0, 0, 150))));
  EXPECT_FALSE(seen(plate(10, -40 * x + Vec3(0, 0, 150))));
  EXPECT_TRUE(seen(plate(10, Vec3(0, 0, 150))));
}

TEST(MeasuredSamples, AreTheSameOneByOneAndOnAnyNumberOfThreads) {
  const TriangleMesh part = surface_of_revolution({{250, 0}, {300, 0}, {330, 200}, {250, 200}}, 90);
  const auto samples = sample_surface(part, 1000, {}, 1);
  const auto views = views_of_surface(samples, 150, 300, rad_from_deg(35), 1);
  const RayScene scene(part);
  const Scanner scanner;
  const BitRows rows = measured_samples(views, samples, scanner, scene, {});
  std::size_t seen = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const RigidMotion& view = views[v].workpiece_from_scanner;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const bool expected = failing_limits(scanner, view.inverse(), samples[s]) == 0 &&
                            in_sight(scanner, view, samples[s], scene);
      ASSERT_EQ(bit_at(rows.row(v), s), expected) << v << ", " << s;
      seen += expected ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 1000U);
  set_thread_count(1);
  const BitRows alone = measured_samples(views, samples, scanner, scene, {});
  set_thread_count(0);
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_TRUE(std::equal(rows.row(v).begin(), rows.row(v).end(), alone.row(v).begin()));
  }
}

TEST(MeasuredSamples, LeaveOutOnlyLimitsThatAreAsked) {
  const std::vector<SurfaceSample> samples = {upwards({0, 0, 150})};
  const std::vector<Viewpoint> views = {{looking_at(Vec3::Zero(), Vec3::UnitZ(), 300, 0)}};
  AskedLimits asked;
  EXPECT_FALSE(
      bit_at(measured_samples(views, samples, Scanner{}, RayScene(TriangleMesh{}), asked).row(0), 0));
  asked.on[static_cast<std::size_t>(ScanLimit::Range)] = false;
  EXPECT_TRUE(bit_at(measured_samples(views, samples, Scanner{}, RayScene(TriangleMesh{}), asked).row(0), 0));
}

TEST(TakeOutHidden, LeavesWhatStandsInTheOpen) {
  const std::vector<SurfaceSample> samples = {upwards({0, 0, 0}), upwards({100, 0, 0})};
  const std::vector<Viewpoint> views = {{looking_at(Vec3::Zero(), Vec3::UnitZ(), 300, 0)}};
  BitRows rows = measured_samples(views, samples, Scanner{}, RayScene(TriangleMesh{}), {});
  EXPECT_EQ(count_bits(rows.row(0)), 2U);
  take_out_hidden(views, samples, Scanner{}, RayScene(plate(30, {0, 0, 20})), rows);
  EXPECT_FALSE(bit_at(rows.row(0), 0));
  EXPECT_TRUE(bit_at(rows.row(0), 1));
}

TEST(IsClear, KeepsTheHousingOffTheSurface) {
  const SurfaceTree surface(plate(500, {0, 0, 0}));
  EXPECT_TRUE(is_clear(Scanner{}, {0, 0, 111}, surface));
  EXPECT_FALSE(is_clear(Scanner{}, {0, 0, 109}, surface));
}

}  // namespace
}  // namespace asterism
