// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/cell/paper_layouts.hpp"

namespace asterism {
namespace {

TEST(ThreePointFrame, StandsOnTheFirstTargetWithTheSecondOnX) {
  const auto& targets = paper_table1()[0].targets;
  const auto frame = three_point_frame(targets);
  ASSERT_TRUE(frame);
  const auto local = local_coordinates(*frame, targets);
  EXPECT_NEAR(local[0].norm(), 0, 1e-9);
  EXPECT_NEAR((local[1] - Vec3((targets[1] - targets[0]).norm(), 0, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(local[2].z(), 0, 1e-9);
  EXPECT_GT(local[2].y(), 0);
}

// Axes and local coordinates by an independent computation, to the four decimals it was printed with.
TEST(CentroidFrame, GivesTheAxesOfSection23ForTable1) {
  const std::vector<Mat3> expected = [] {
    std::vector<Mat3> axes(3);
    axes[0] << -0.639975, -0.768136, -0.019971, 0.76797, -0.638537, -0.049928, 0.025599, -0.04729, 0.998553;
    axes[1] << -0.672293, -0.739645, -0.030785, 0.739522, -0.66913, -0.073297, 0.033615, -0.072043, 0.996835;
    axes[2] << -0.599521, -0.800359, 0.0, 0.799361, -0.598773, -0.049938, 0.039968, -0.029939, 0.998752;
    return axes;
  }();
  const std::vector<Vec3> first = {
      {-159.951, -192.1129, -3.3285}, {-162.9189, -263.9894, -6.8972}, {-207.7339, -113.0233, -0.9155}};
  for (std::size_t s = 0; s < 3; ++s) {
    const auto& targets = paper_table1()[s].targets;
    const auto frame = centroid_frame(targets);
    ASSERT_TRUE(frame);
    EXPECT_LT((frame->rotation.toRotationMatrix() - expected[s]).norm(), 2e-6) << "S" << s + 1;
    EXPECT_LT((local_coordinates(*frame, targets)[0] - first[s]).norm(), 1e-4) << "S" << s + 1;
  }
}

TEST(CentroidFrame, OfEquations15And16PointsTheOtherWay) {
  const auto& targets = paper_table1()[0].targets;
  const auto between = centroid_frame(targets, CentroidAxes::BetweenTargets);
  const auto central = centroid_frame(targets, CentroidAxes::FromCentroid);
  ASSERT_TRUE(between && central);
  EXPECT_LT((between->rotation * Vec3::UnitZ()).dot(central->rotation * Vec3::UnitZ()), -0.99);
  const double apart = deg_from_rad(rotation_angle(between->rotation, central->rotation));
  EXPECT_GT(apart, 178.0);
  const auto local = local_coordinates(*central, targets);
  EXPECT_NEAR(local[1].y(), 0, 1e-9);  // the second target lies on x
  EXPECT_NEAR(local[1].z(), 0, 1e-9);
}

TEST(CentroidFrame, KeepsLocalCoordinatesWhenTheWholeLayoutIsMoved) {
  const RigidMotion moved = {exp_rotation({0.4, -1.1, 0.7}), Vec3(10, -2000, 300)};
  for (const CentroidAxes axes : {CentroidAxes::BetweenTargets, CentroidAxes::FromCentroid}) {
    for (const auto& layout : paper_table1()) {
      std::vector<Vec3> elsewhere;
      for (const Vec3& target : layout.targets) elsewhere.push_back(moved * target);
      const auto here = local_coordinates(*centroid_frame(layout.targets, axes), layout.targets);
      const auto there = local_coordinates(*centroid_frame(elsewhere, axes), elsewhere);
      for (std::size_t i = 0; i < here.size(); ++i) EXPECT_LT((here[i] - there[i]).norm(), 1e-9);
    }
  }
}

TEST(CentroidFrame, NamesWhyThereIsNone) {
  const std::vector<Vec3> on_a_line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 5, 0}};
  EXPECT_EQ(centroid_frame(on_a_line).error(), RigidFitFailure::Collinear);
  EXPECT_EQ(three_point_frame(on_a_line).error(), RigidFitFailure::Collinear);
  EXPECT_EQ(centroid_frame(std::span(on_a_line).first(2)).error(), RigidFitFailure::TooFewPoints);
}

TEST(AxesAsPrinted, AreNoRotation) {
  const std::vector<double> determinant = {0.769, 0.764, 0.447};
  const std::vector<double> between_deg = {50.3, 49.8, 26.6};  // the angle between the first two columns
  for (std::size_t s = 0; s < 3; ++s) {
    const Mat3 printed = axes_as_printed(paper_table1()[s].targets);
    EXPECT_NEAR(printed.determinant(), determinant[s], 5e-4);
    EXPECT_NEAR(deg_from_rad(std::acos(printed.col(0).dot(printed.col(1)))), between_deg[s], 0.05);
  }
}

}  // namespace
}  // namespace asterism
