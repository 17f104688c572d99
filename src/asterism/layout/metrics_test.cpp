// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {
namespace {

TEST(MeasureLayout, GivesThePapersTable2) {
  const std::vector<double> radius = {311.6667, 343.1917, 313.7331};
  const std::vector<double> symmetry = {29.2128, 20.3948,
                                        40.6970};  // the paper prints 40.679: digits swapped
  for (std::size_t s = 0; s < 3; ++s) {
    const LayoutMetrics metrics = measure_layout(paper_table1()[s].targets);
    EXPECT_NEAR(metrics.max_radius_mm, radius[s], 1e-3);
    EXPECT_NEAR(metrics.symmetry_mm, symmetry[s], 1e-3);
    EXPECT_EQ(metrics.targets, 6);
  }
}

TEST(MeasureLayout, GivesThePapersTable10WhereItIsRight) {
  const std::vector<double> origin = {661.4641, 778.7963, 850.5667, 669.2338, 857.9556};
  const std::vector<double> coverage = {2663.1306, 4780.4978, 5736.6551, 3005.7685, 5828.3542};
  for (std::size_t s = 0; s < 5; ++s) {
    const LayoutMetrics metrics = measure_layout(paper_table9()[s].targets);
    EXPECT_NEAR(metrics.mean_distance_to_origin_mm, origin[s], 1e-3);
    EXPECT_NEAR(metrics.pair_distance_sum_mm, coverage[s], 1e-3);
    EXPECT_NEAR(metrics.mean_pair_distance_mm, coverage[s] / 6, 1e-3);
  }
}

TEST(MeasureLayout, FindsTable9sFourthSchemeCoplanarAndTheOthersFlat) {
  EXPECT_LT(measure_layout(paper_table9()[3].targets).thickness_mm, 1e-9);
  EXPECT_LT(measure_layout(paper_table9()[3].targets).off_plane_mm, 1e-9);
  for (const std::size_t s : {0U, 1U, 2U, 4U}) {
    const LayoutMetrics metrics = measure_layout(paper_table9()[s].targets);
    EXPECT_GT(metrics.thickness_mm, 4.0);
    EXPECT_LT(metrics.thickness_mm, 7.0);
    EXPECT_LE(metrics.thickness_mm, metrics.off_plane_mm);
  }
}

TEST(MeasureLayout, KnowsTheSmallestSpacingsOfThePapersLayouts) {
  EXPECT_NEAR(measure_layout(paper_table1()[0].targets).min_pair_distance_mm, 222.5, 0.1);
  EXPECT_NEAR(measure_layout(paper_table1()[1].targets).min_pair_distance_mm, 144.6, 0.5);
  EXPECT_NEAR(measure_layout(paper_table1()[2].targets).min_pair_distance_mm, 200.8, 0.5);
}

TEST(MeasureLayout, StaysTheSameWhenTheWholeLayoutIsMoved) {
  const RigidMotion moved = {exp_rotation({0.4, -1.1, 0.7}), Vec3(10, -2000, 300)};
  for (const auto& layout : paper_table1()) {
    std::vector<Vec3> elsewhere;
    for (const Vec3& target : layout.targets) elsewhere.push_back(moved * target);
    const LayoutMetrics a = measure_layout(layout.targets);
    const LayoutMetrics b = measure_layout(elsewhere);
    EXPECT_NEAR(a.max_radius_mm, b.max_radius_mm, 1e-9);
    EXPECT_NEAR(a.pair_distance_sum_mm, b.pair_distance_sum_mm, 1e-9);
    EXPECT_NEAR(a.thickness_mm, b.thickness_mm, 1e-9);
    EXPECT_NEAR(a.enclosing_sphere.radius_mm, b.enclosing_sphere.radius_mm, 1e-9);
    EXPECT_LT((moved * a.enclosing_sphere.centre_mm - b.enclosing_sphere.centre_mm).norm(), 1e-8);
  }
}

TEST(MeasureLayout, NeedsTwoTargets) {
  EXPECT_THROW(measure_layout(std::vector<Vec3>{{1, 2, 3}}), ContractViolation);
}

TEST(MinimumEnclosingSphere, OfACubeGoesThroughItsCorners) {
  std::vector<Vec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  const Sphere sphere = minimum_enclosing_sphere(cube);
  EXPECT_NEAR(sphere.radius_mm, std::sqrt(0.75), 1e-12);
  EXPECT_LT((sphere.centre_mm - Vec3(0.5, 0.5, 0.5)).norm(), 1e-12);
}

TEST(MinimumEnclosingSphere, OfAnObtuseTriangleHasItsLongestSideAcross) {
  const Sphere sphere = minimum_enclosing_sphere(std::vector<Vec3>{{0, 0, 0}, {10, 0, 0}, {4, 1, 0}});
  EXPECT_NEAR(sphere.radius_mm, 5, 1e-12);
}

TEST(MinimumEnclosingSphere, OfOnePointHasNoRadius) {
  EXPECT_EQ(minimum_enclosing_sphere(std::vector<Vec3>{{3, 4, 5}}).radius_mm, 0);
}

/// The smallest over all spheres through two, three or four of the points that hold the others.
double least_by_trial(const std::vector<Vec3>& points) {
  double least = 1e300;
  const auto n = static_cast<unsigned>(points.size());
  for (unsigned mask = 1; mask < 1U << n; ++mask) {
    std::vector<Vec3> some;
    for (unsigned i = 0; i < n; ++i) {
      if ((mask >> i) & 1U) some.push_back(points[i]);
    }
    if (some.size() > 4) continue;
    const Sphere sphere = minimum_enclosing_sphere(some);
    const bool holds_all = std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      return (p - sphere.centre_mm).norm() <= sphere.radius_mm + 1e-9;
    });
    if (holds_all) least = std::min(least, sphere.radius_mm);
  }
  return least;
}

TEST(MinimumEnclosingSphere, EqualsATrialOfAllSmallSets) {
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    RandomStream random(11, trial);
    std::vector<Vec3> points;
    const double flat = trial % 3 == 0 ? 0.0 : 1.0;
    const auto side = [&] { return trial % 2 == 0 ? std::floor(4 * random.uniform()) : random.uniform(); };
    for (int i = 0; i < 9; ++i) points.emplace_back(side(), side(), flat * side());
    const Sphere sphere = minimum_enclosing_sphere(points);
    for (const Vec3& p : points) EXPECT_LE((p - sphere.centre_mm).norm(), sphere.radius_mm + 1e-9);
    EXPECT_NEAR(sphere.radius_mm, least_by_trial(points), 1e-9) << trial;
  }
}

}  // namespace
}  // namespace asterism
