// SPDX-License-Identifier: Apache-2.0
// The equations of "Dynamic Positioning and Optimization of Magnetic Target Based on Binocular Vision"
// (Machines 2025, 13, 592) as they are implemented here.

#include <gtest/gtest.h>

#include <vector>

#include "asterism/camera/two_view.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

constexpr double kFocalMm = 16, kPixelMm = 3.45e-3, kBaselineMm = 1000;

/// The paper's Figure 1: two parallel cameras, baseline b along x.
StereoRig parallel_rig() {
  const double f_px = kFocalMm / kPixelMm;
  StereoRig rig;
  rig.left = rig.right = {f_px, f_px, 0, 2047.5, 1499.5, {}, 0, 4096, 3000};
  rig.right_from_left.translation = Vec3(-kBaselineMm, 0, 0);
  return rig;
}

Vec2 image_of(const StereoRig& rig, Side side, const Vec3& in_tracker) {
  return project(rig.lens(side), rig.camera_from_tracker(side) * in_tracker)->px;
}

class PaperEquations : public testing::Test {
 protected:
  StereoRig rig = parallel_rig();
  Vec3 target{310, -140, 2130};
  Vec2 left = image_of(rig, Side::Left, target), right = image_of(rig, Side::Right, target);
  double x_left_mm = (left.x() - rig.left.cx) * kPixelMm, x_right_mm = (right.x() - rig.right.cx) * kPixelMm;
};

TEST_F(PaperEquations, Eq1To3DisparityIsBaselineTimesFocalLengthOverDepth) {
  const double disparity_mm = x_left_mm - x_right_mm;           // Eq. 1
  const double between_images_mm = kBaselineMm - disparity_mm;  // Eq. 2
  const double depth = target.z();
  EXPECT_NEAR(between_images_mm / (depth - kFocalMm), kBaselineMm / depth, 1e-12);  // Eq. 3
}

TEST_F(PaperEquations, Eq4DepthOfTheTriangulatedPoint) {
  const auto point = triangulate_pair(rig, left, Mat2::Identity() * 1e-4, right, Mat2::Identity() * 1e-4);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->in_tracker.z(), kBaselineMm * kFocalMm / (x_left_mm - x_right_mm), 1e-9);
}

TEST_F(PaperEquations, Eq5And6ProjectionByTheFocalLength) {
  EXPECT_NEAR(x_left_mm, kFocalMm * target.x() / target.z(), 1e-12);
  EXPECT_NEAR((left.y() - rig.left.cy) * kPixelMm, kFocalMm * target.y() / target.z(), 1e-12);
}

TEST_F(PaperEquations, Eq7To9PixelsFromTheWorldThroughTheSkewedMatrix) {
  Lens lens = rig.left;
  lens.skew = 1.7;  // the paper's γ stands in Eq. 9 only, as 1/dx γ u0 in front of f: in pixels, γ f
  Mat3 k;
  k << lens.fx, lens.skew, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1;
  const RigidMotion camera_from_world{exp_rotation({0.2, -0.1, 0.4}), {50, 80, 1900}};
  const Vec3 in_world(120, -75, 260);
  const Vec3 homogeneous = k * (camera_from_world * in_world);
  EXPECT_LT((project(lens, camera_from_world * in_world)->px - homogeneous.hnormalized()).norm(), 1e-9);
}

TEST_F(PaperEquations, Eq18LeastSquaresMotionIsAProperRotation) {
  const std::vector<Vec3> in_platform = {
      {200, -100, 590}, {-100, 300, 610}, {-200, 100, 600}, {0, -250, 605}};
  const RigidMotion world_from_platform{exp_rotation({0.3, 0.2, -0.5}), {10, 20, 2300}};
  std::vector<Vec3> in_world;
  for (const Vec3& p : in_platform) in_world.push_back(world_from_platform * p);
  const auto fit = fit_rigid_motion(in_world, in_platform);
  ASSERT_TRUE(fit);
  EXPECT_LT(difference(fit->a_from_b, world_from_platform).norm(), 1e-9);
}

}  // namespace
}  // namespace asterism
