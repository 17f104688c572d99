// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/triangulation.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "asterism/tracking/scene_for_tests.hpp"

namespace asterism {
namespace {

struct Scene {
  StereoRig rig;
  std::vector<Vec3> truth;
  std::vector<Centre> left, right;
};

Scene scattered(int count, double sigma_px, int coefficients = 0) {
  Scene s{scene::rig(coefficients), {}, {}, {}};
  RandomStream random(21, static_cast<std::uint64_t>(count));
  const Body origin{"point", {{"0", Vec3::Zero(), {}, {}, {}}}};
  while (static_cast<int>(s.truth.size()) < count) {
    const RigidMotion at{Quaternion::Identity(), Vec3(random.uniform(-300, 900), random.uniform(-500, 500),
                                                      random.uniform(1700, 2700))};
    s.truth.push_back(at.translation);
    for (auto* side : {&s.left, &s.right}) {
      const Side which = side == &s.left ? Side::Left : Side::Right;
      Ellipse image;
      image.centre = project(s.rig.lens(which), s.rig.camera_from_tracker(which) * at.translation)->px;
      image.semi_major = image.semi_minor =
          6.0 * s.rig.lens(which).fx / (s.rig.camera_from_tracker(which) * at.translation).z();
      side->push_back(scene::centre(image, sigma_px, random));
    }
  }
  return s;
}

TEST(Triangulate, KeepsEveryTruePairAndSaysWhereItIs) {
  for (const int coefficients : {0, 5}) {
    const Scene s = scattered(200, 0.02, coefficients);
    const auto points = triangulate(s.left, s.right, s.rig, {});
    std::vector<int> found(200);
    for (const Point& point : points) {
      if (point.left != point.right) continue;
      ++found[static_cast<std::size_t>(point.left)];
      const Vec3 error = point.in_tracker - s.truth[static_cast<std::size_t>(point.left)];
      EXPECT_LT(error.dot(point.covariance.inverse() * error), 30) << "point " << point.left;
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), 200);
  }
}

TEST(Triangulate, KeepsGhostsForIdentificationToRemove) {
  const Scene s = scattered(200, 0.02);
  const auto points = triangulate(s.left, s.right, s.rig, {});
  EXPECT_GT(points.size(), 230u);  // about N² · 2 · gate / height / 2 of them
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT(std::pair(points[i - 1].left, points[i - 1].right), std::pair(points[i].left, points[i].right));
  }
}

TEST(Triangulate, GateFollowsTheCentresCovariance) {
  Scene s = scattered(1, 0.0);
  TriangulationOptions options;
  options.rig_error_px = 0;
  s.left[0].covariance = s.right[0].covariance = 0.05 * 0.05 * Mat2::Identity();
  s.left[0].ellipse.centre.y() += 0.15;  // about three sigmas of the left, two of both
  EXPECT_EQ(triangulate(s.left, s.right, s.rig, options).size(), 1u);
  s.left[0].covariance = s.right[0].covariance = 0.01 * 0.01 * Mat2::Identity();
  EXPECT_EQ(triangulate(s.left, s.right, s.rig, options).size(), 0u);
  options.rig_error_px = 0.1;
  const auto forgiven = triangulate(s.left, s.right, s.rig, options);
  ASSERT_EQ(forgiven.size(), 1u);
  const Vec3 error = forgiven[0].in_tracker - s.truth[0];
  EXPECT_LT(error.dot(forgiven[0].covariance.inverse() * error), 12);  // widened to match the misfit
}

TEST(Triangulate, DropsPointsOutsideTheDepthRangeAndBehindTheCameras) {
  const Scene s = scattered(50, 0.02);
  TriangulationOptions options;
  options.min_depth_mm = 2000;
  options.max_depth_mm = 2400;
  for (const Point& point : triangulate(s.left, s.right, s.rig, options)) {
    EXPECT_GE(point.in_tracker.z(), 2000);
    EXPECT_LE(point.in_tracker.z(), 2400);
  }
  Scene diverging = scattered(1, 0.0);
  diverging.left[0].ellipse.centre.x() = 100;  // the rays meet behind
  diverging.right[0].ellipse.centre.x() = 1900;
  options = {};
  options.gate_sigmas = 100;
  options.rig_error_px = 1;
  EXPECT_TRUE(triangulate(diverging.left, diverging.right, diverging.rig, options).empty());
}

TEST(Triangulate, CanAskThatBothImagesTellTheSameSize) {
  Scene s = scattered(1, 0.0);
  TriangulationOptions options;
  options.max_size_ratio = 1.3;
  EXPECT_EQ(triangulate(s.left, s.right, s.rig, options).size(), 1u);
  s.left[0].ellipse.semi_major *= 2;
  EXPECT_TRUE(triangulate(s.left, s.right, s.rig, options).empty());
}

TEST(Triangulate, OfTenThousandBlobsTakesTheBrightestAndTheBestMeetingInShortTime) {
  Scene s = scattered(30, 0.02);
  RandomStream random(22, 0);
  for (int i = 0; i < 10000; ++i) {
    for (auto* side : {&s.left, &s.right}) {
      Ellipse image;
      image.centre = {random.uniform(0, 2048), random.uniform(0, 1536)};
      side->push_back(scene::centre(image, 0.02, random));
      side->back().amplitude = 20;
    }
  }
  const auto start = std::chrono::steady_clock::now();
  const auto points = triangulate(s.left, s.right, s.rig, {});
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.5);
  EXPECT_LE(points.size(), 5000u);
  for (int target = 0; target < 30; ++target) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const Point& point) {
      return point.left == target && point.right == target;
    }));
  }
}

TEST(Triangulate, OfNoCentresMakesNoPoints) {
  const Scene s = scattered(3, 0.02);
  EXPECT_TRUE(triangulate({}, s.right, s.rig, {}).empty());
  EXPECT_TRUE(triangulate(s.left, {}, s.rig, {}).empty());
}

}  // namespace
}  // namespace asterism
