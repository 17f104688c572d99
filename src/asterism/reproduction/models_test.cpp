// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/random.hpp"
#include "asterism/reproduction/disturbance.hpp"
#include "asterism/reproduction/next_generation.hpp"
#include "asterism/reproduction/papers_cell.hpp"
#include "asterism/reproduction/papers_run.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/reproduction/scan_rings.hpp"
#include "asterism/reproduction/sorting_claims.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

TEST(FitRings, FindsRingsStepTiltAndCone) {
  std::vector<Vec3> stations;
  const Quaternion tilt = exp_rotation({0, rad_from_deg(-7), 0});
  for (const double z : {-40.0, 210.0}) {
    for (int i = 0; i < 24; ++i) {
      const double angle = rad_from_deg(15.0 * i), radius = 500 + 0.2 * z;
      stations.push_back(tilt * Vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  stations.pop_back();
  const ScanRings rings = fit_rings(stations);
  EXPECT_NEAR(rings.tilt_deg, -7, 1e-3);
  EXPECT_EQ(rings.step_deg, 15);
  EXPECT_NEAR(rings.slope, 0.2, 1e-5);
  EXPECT_NEAR(rings.radius_at_zero_mm, 500, 0.01);
  EXPECT_EQ(rings.points, 47U);
  EXPECT_EQ(rings.pattern_points, 48U);
  EXPECT_LT(rings.residual_mm, 0.02);
}

TEST(DisturbIsotropic, AgreesWithTheFirstOrderRotationError) {
  for (const PublishedLayout& layout : paper_table9()) {
    const PoseErrorSample sample = disturb_isotropic(layout.targets, 0.1, 8000, 3, 0);
    double squares = 0;
    for (const double error : sample.rotation_deg) squares += error * error;
    const double rms = std::sqrt(squares / static_cast<double>(sample.rotation_deg.size()));
    // Four standard errors; the spread of a square is at most √2 of its mean.
    EXPECT_NEAR(rms, rms_rotation_deg(layout.targets, 0.1),
                4 * rms * std::sqrt(2.0 / 8000) / 2 * std::sqrt(3.0));
  }
}

TEST(DisturbImages, ErrsMoreAlongTheSightLinesThanAnIsotropicNoiseOfTheSameSidewaysSpread) {
  const auto& targets = paper_table1()[0].targets;
  const Summary images = summarize(disturb_images(targets, 0.2, 2000, 1, 0).translation_mm);
  const double lateral_mm = 0.2 / std::sqrt(2.0) * 2000 * 3.45e-3 / 16;
  const Summary isotropic = summarize(disturb_isotropic(targets, lateral_mm, 2000, 1, 0).translation_mm);
  EXPECT_GT(images.mean, 1.5 * isotropic.mean);
}

TEST(WatchRing, SeesAllTargetsAtRestAndFourAtWorst) {
  const std::vector<SightOfRing> sights = watch_ring({}, {});
  ASSERT_EQ(sights.size(), 601U);
  EXPECT_EQ(sights.front().visible, 8);
  EXPECT_NEAR(sights.front().coverage, std::sqrt(0.75), 1e-12);  // cos 30°
  int fewest = 8, exactly_four = 0;
  double lowest = 1, highest = 0, off_axis = 0;
  for (const SightOfRing& sight : sights) {
    fewest = std::min(fewest, sight.visible);
    exactly_four += sight.visible == 4;
    lowest = std::min(lowest, sight.coverage);
    highest = std::max(highest, sight.coverage);
    off_axis = std::max(off_axis, sight.off_axis_rad);
  }
  EXPECT_EQ(fewest, 4);
  EXPECT_NEAR(exactly_four, 28, 1);  // a frame may lie on the limit of 60° itself
  EXPECT_NEAR(lowest, 0.606, 5e-4);
  EXPECT_NEAR(highest, 0.994, 5e-4);
  EXPECT_LT(deg_from_rad(off_axis), 5.6);
}

TEST(WatchRing, CoversNothingOutsideTheCone) {
  const std::vector<SightOfRing> sights = watch_ring({.cone_half_angle_rad = rad_from_deg(1)}, {});
  EXPECT_TRUE(
      std::any_of(sights.begin(), sights.end(), [](const SightOfRing& s) { return s.coverage == 0; }));
}

TEST(RigFromPlatform, LooksAtTheMiddleOfTheTargetsFromBothCameras) {
  const Vec3 middle = rig_from_platform() * Vec3(0, 0, 600);
  EXPECT_NEAR(middle.x(), 500, 1e-9);  // half the baseline right of the left camera
  EXPECT_NEAR(middle.y(), 0, 1e-9);
  EXPECT_NEAR(middle.z(), 2000, 1e-9);
}

TEST(TournamentOdds, AddUpAndFollowTheDraws) {
  const std::vector<Scheme> schemes = schemes_of_table9();
  const std::vector<double> odds = tournament_odds(schemes);
  const double expected[] = {0.32, 0.20, 0.04, 0.12, 0.32};
  std::vector<int> picked(5, 0);
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    for (const std::size_t parent : draw_parents(schemes, static_cast<std::uint64_t>(run))) ++picked[parent];
  }
  for (std::size_t s = 0; s < 5; ++s) {
    EXPECT_NEAR(odds[s], expected[s], 1e-12);
    const double error = std::sqrt(odds[s] * (1 - odds[s]) / (5.0 * kRuns));
    EXPECT_NEAR(picked[s] / (5.0 * kRuns), odds[s], 4 * error);
  }
}

TEST(SortAsTable3, ComparesEveryPairInEveryObjective) {
  const std::vector<double> points = {0, 2, 1, 1, 2, 0, 2, 2};
  const CountedSort sorted = sort_as_table3(points, 2);
  EXPECT_EQ(sorted.rank, (std::vector<int>{0, 0, 0, 1}));
  EXPECT_EQ(sorted.comparisons, 4 * 3 * 2 * 2);
}

TEST(PapersRun, FindsTheExtremesOfItsProblem) {
  const OptimizationResult result = papers_run(1);
  double least_f1 = INFINITY, most_coverage = 0;
  for (const Candidate& candidate : result.front) {
    least_f1 = std::min(least_f1, candidate.objectives[0]);
    most_coverage = std::max(most_coverage, -candidate.objectives[1]);
  }
  // The extremes: 580 mm with all four at (0, 0, 580), 9562.08 mm at the corners.
  // 5000 evaluations of the plain algorithm come near.
  EXPECT_GE(least_f1, 580);
  EXPECT_LT(least_f1, 600);
  EXPECT_LE(most_coverage, 9562.09);
  EXPECT_GT(most_coverage, 8500);
}

}  // namespace
}  // namespace asterism
