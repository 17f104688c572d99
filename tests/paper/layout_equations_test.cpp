// SPDX-License-Identifier: Apache-2.0
// Equations 10 to 31 of "Dynamic Positioning and Optimization of Magnetic Target Based on Binocular Vision"
// (Machines 2025, 13, 592), written out beside what is implemented. Eq. 18 is in equations_test.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/layout/frame.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/layout/objectives.hpp"
#include "asterism/optimization/crowding.hpp"
#include "asterism/optimization/variation.hpp"
#include "asterism/reproduction/schemes.hpp"

namespace asterism {
namespace {

const std::vector<Vec3>& scheme1() { return paper_table1()[0].targets; }

Eigen::Matrix4d homogeneous(const RigidMotion& motion) {
  Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
  t.topLeftCorner<3, 3>() = motion.rotation.toRotationMatrix();
  t.topRightCorner<3, 1>() = motion.translation;
  return t;
}

TEST(PaperLayoutEquations, Eq10To13ThreePointFrameKeepsTheNormalAndTheFirstAxis) {
  const auto& p = scheme1();
  const Vec3 v1 = p[1] - p[0], v2 = p[2] - p[0], n = v1.cross(v2);  // Eqs. 11, 12
  const auto frame = three_point_frame(p);
  ASSERT_TRUE(frame);
  EXPECT_LT((frame->rotation * Vec3::UnitX() - v1.normalized()).norm(), 1e-12);
  EXPECT_LT((frame->rotation * Vec3::UnitZ() - n.normalized()).norm(), 1e-12);
  EXPECT_EQ(frame->translation, p[0]);
  // Eq. 13 as printed is no rotation: its first two columns are not at right angles.
  EXPECT_NEAR(axes_as_printed(p).determinant(), 0.769, 5e-4);
}

TEST(PaperLayoutEquations, Eq14CentroidIsTheFramesOrigin) {
  Vec3 c = Vec3::Zero();
  for (const Vec3& p : scheme1()) c += p / 6;
  const auto frame = centroid_frame(scheme1());
  ASSERT_TRUE(frame);
  EXPECT_LT((frame->translation - c).norm(), 1e-12);
  EXPECT_NEAR(c.z(), 598.3333, 1e-4);
}

TEST(PaperLayoutEquations, Eq15To17LocalCoordinatesByTheTransposedAxes) {
  const auto& p = scheme1();
  const auto frame = centroid_frame(p, CentroidAxes::FromCentroid);
  ASSERT_TRUE(frame);
  const Vec3 c = frame->translation, v1 = p[1] - c, v2 = p[0] - c;  // Eq. 15
  const Vec3 n = v1.cross(v2).normalized();                         // Eq. 16
  EXPECT_LT((frame->rotation * Vec3::UnitZ() - n).norm(), 1e-12);
  Mat3 r;  // axes as columns, so that Eq. 17 needs Rᵀ
  r << v1.normalized(), n.cross(v1.normalized()), n;
  const std::vector<Vec3> local = local_coordinates(*frame, p);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT((local[i] - r.transpose() * (p[i] - c)).norm(), 1e-9);
}

TEST(PaperLayoutEquations, Eq19To22PosesAreHomogeneousTransforms) {
  const RigidMotion tracker_from_platform{rotation_from_yaw_pitch_roll(0.2, -0.1, 0.15), {100, -50, 2100}};
  const RigidMotion platform_from_targets{rotation_from_yaw_pitch_roll(-1.1, 0.05, 3.0), {0, 0, 598}};
  const RigidMotion tracker_from_targets = tracker_from_platform * platform_from_targets;
  EXPECT_LT((homogeneous(tracker_from_targets) -
             homogeneous(tracker_from_platform) * homogeneous(platform_from_targets))
                .norm(),
            1e-9);
}

TEST(PaperLayoutEquations, Eq20AttitudeIsYawPitchRoll) {
  // Eq. 20 is damaged in print (its middle factor is singular); Table 8 speaks of yaw, pitch and roll.
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Mat3 expected =
      (Eigen::AngleAxisd(0.3, z) * Eigen::AngleAxisd(-0.2, y) * Eigen::AngleAxisd(0.1, x)).toRotationMatrix();
  EXPECT_LT((rotation_from_yaw_pitch_roll(0.3, -0.2, 0.1).toRotationMatrix() - expected).norm(), 1e-12);
}

TEST(PaperLayoutEquations, Eq23To27NumberAndSpacing) {
  const auto& p = scheme1();
  double both_ways = 0, once = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < p.size(); ++j) {
      if (i != j) both_ways += (p[i] - p[j]).norm();
      if (i < j) once += (p[i] - p[j]).norm();
    }
  }
  const LayoutMetrics metrics = measure_layout(p);
  EXPECT_EQ(metrics.targets, 6);                                          // Eq. 23
  EXPECT_NEAR(metrics.mean_pair_distance_mm, both_ways / (6 * 5), 1e-9);  // Eq. 24
  EXPECT_NEAR(metrics.mean_pair_distance_mm / 2, once / (6 * 5), 1e-9);   // Eqs. 26 and 27 are half of it
}

TEST(PaperLayoutEquations, Eq28SpacingIsAConstraint) {
  const LayoutConstraint spacing = constraints_from("spacing >= 300").at(0);
  const LayoutMetrics metrics = measure_layout(scheme1());
  EXPECT_NEAR(metrics.min_pair_distance_mm, 222.5, 0.05);
  EXPECT_NEAR(violation_of(spacing, metrics.min_pair_distance_mm), 300 - metrics.min_pair_distance_mm, 1e-12);
  EXPECT_EQ(violation_of(spacing, 300), 0);
}

TEST(PaperLayoutEquations, Eq29CrowdingDistanceOfTheMiddleOfThree) {
  const std::vector<double> objectives = {0, 10, 1, 4, 4, 0};
  const std::vector<int> front = {0, 1, 2};
  std::vector<double> distance(3);
  crowding_distances(objectives, 2, front, distance);
  EXPECT_TRUE(std::isinf(distance[0]));
  EXPECT_DOUBLE_EQ(distance[1], (4.0 - 0) / 4 + (10.0 - 0) / 10);
  EXPECT_TRUE(std::isinf(distance[2]));
}

TEST(PaperLayoutEquations, Eq30ChildrenAreTheMeanOfTheirParentsOnlyWhenAskedFor) {
  VariationOptions options;
  options.crossover = Crossover::PaperAverage;
  options.crossover_probability = 1;
  const std::vector<double> mother = {1, -2, 3}, father = {3, 4, 3}, lowest(3, -10), highest(3, 10);
  std::vector<double> daughter, son;
  RandomStream random(1, 0);
  Variation(options).cross(mother, father, lowest, highest, daughter, son, random);
  EXPECT_EQ(daughter, (std::vector<double>{2, 1, 3}));
  EXPECT_EQ(VariationOptions().crossover, Crossover::SimulatedBinary);
}

TEST(PaperLayoutEquations, Eq31CostAndCoverageOfSection42) {
  const auto& p = paper_table9()[0].targets;
  const auto [f1, f2] = objectives_of(p);
  EXPECT_NEAR(f1, (p[0].norm() + p[1].norm() + p[2].norm() + p[3].norm()) / 4, 1e-9);
  EXPECT_NEAR(-f2,
              (p[0] - p[1]).norm() + (p[0] - p[2]).norm() + (p[0] - p[3]).norm() + (p[1] - p[2]).norm() +
                  (p[1] - p[3]).norm() + (p[2] - p[3]).norm(),
              1e-9);
}

}  // namespace
}  // namespace asterism
