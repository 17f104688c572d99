// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/fusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

const std::vector<WorkPoint> kPoints = {{"pivot", {0, 0, 600}}, {"rim", {0, 500, 600}}};
void silent(std::string_view, std::size_t, std::size_t) {}

Cell cell_with_platform() {
  Cell cell = test_cell();
  cell.timing = {60, 20};
  cell.platform = Platform{};
  cell.platform->pivot_mm = {0, 0, 600};
  cell.platform->read_out.latency_s = 0.02;
  return cell;
}

FusionOptions few_runs(int runs) {
  FusionOptions options;
  options.runs = runs;
  options.others_s = {0.2, 1};
  return options;
}

TEST(FusionOf, HoldsThePoseThroughHalfASecondOfDarkness) {
  const Cell cell = cell_with_platform();
  const FusionStudy study = fusion_of(cell, kPoints, few_runs(8), silent);
  EXPECT_EQ(study.body, "platform");
  EXPECT_EQ(study.point, "rim");
  ASSERT_EQ(study.spells.size(), 3U);
  EXPECT_EQ(study.spells[0].occlusion_s, 0.2);
  EXPECT_EQ(study.spells[1].occlusion_s, 0.5);

  const FusionSpell& half = study.spells[1];
  EXPECT_EQ(half.with_read_out.frames, 8U * 10U);
  EXPECT_EQ(half.with_read_out.lost, 0U);
  EXPECT_LT(half.with_read_out.rms_mm, 0.8);  // the read-out's own at the rim: 0.6 mm
  EXPECT_GT(half.alone.rms_mm, 10 * half.with_read_out.rms_mm);
  // Too sure by no more than chance: 80 frames of 8 runs that hang together, about a quarter of them free.
  EXPECT_LT(half.with_read_out.nees / 6, 1.4);
  EXPECT_GT(half.with_read_out.nees / 6, 0.5);
  EXPECT_GT(half.with_read_out.in_95_percent, 0.88);
  EXPECT_LT(half.with_read_out.after_rms_mm, 0.1);

  // Alone the body is lost half a second after the last pose; what the read-out carries is not.
  EXPECT_EQ(study.spells[2].alone.lost, 8U * 10U);
  EXPECT_EQ(study.spells[2].with_read_out.lost, 0U);
}

TEST(FusionOf, TellsTheLatencyWithAnHonestSigma) {
  const FusionStudy study = fusion_of(cell_with_platform(), kPoints, few_runs(8), silent);
  EXPECT_EQ(study.offset.told, 8);
  EXPECT_NEAR(study.offset.mean_s, 0.02, 2 * study.offset.sigma_s);
  EXPECT_LT(study.offset.sigma_s, 3e-4);
  EXPECT_LT(study.offset.rms_in_sigma, 1.8);  // χ²(8)/8 is below 1.8² with 0.999
  EXPECT_LT(study.offset.base_nees, 1.8);
}

TEST(FusionOf, DrawsBothRoadsOverTheWholeMotion) {
  const FusionStudy study = fusion_of(cell_with_platform(), kPoints, few_runs(4), silent);
  ASSERT_EQ(study.times_s.size(), 60U);
  ASSERT_EQ(study.drawn.alone.by_frame_mm.size(), 60U);
  EXPECT_DOUBLE_EQ(study.drawn.from_s, 1.25);
  const std::size_t last_blind = 34;
  EXPECT_GT(study.drawn.alone.by_frame_mm[last_blind], study.drawn.alone.by_frame_mm[last_blind - 5]);
  EXPECT_LT(study.drawn.alone.by_frame_mm[last_blind + 1], 0.3);
  EXPECT_LE(study.drawn.with_read_out.low_mm[last_blind], study.drawn.with_read_out.high_mm[last_blind]);
}

TEST(FusionOf, GivesTheSameBitsOnAnyNumberOfThreads) {
  FusionOptions options = few_runs(3);
  options.others_s = {};
  set_thread_count(1);
  const FusionStudy one = fusion_of(cell_with_platform(), kPoints, options, silent);
  set_thread_count(4);
  const FusionStudy four = fusion_of(cell_with_platform(), kPoints, options, silent);
  set_thread_count(0);
  EXPECT_EQ(one.drawn.with_read_out.rms_mm, four.drawn.with_read_out.rms_mm);
  EXPECT_EQ(one.offset.mean_s, four.offset.mean_s);
}

TEST(FusionOf, SaysInWordsThatAPlatformAtRestDoesNotTellItsLatency) {
  Cell cell = cell_with_platform();
  cell.movers[0].motion = at_rest(pose_at(cell.movers[0].motion, 0));
  const FusionStudy study = fusion_of(cell, kPoints, few_runs(2), silent);
  EXPECT_EQ(study.offset.told, 0);
  ASSERT_EQ(study.offset.untold.size(), 2U);
  EXPECT_EQ(study.offset.untold[0],
            "the platform does not move enough while both speak for its latency to be told");
}

TEST(FusionOf, RefusesAMotionWithoutRoomAndACellWithoutPlatform) {
  Cell cell = cell_with_platform();
  cell.timing.frames = 25;
  try {
    static_cast<void>(fusion_of(cell, kPoints, few_runs(1), silent));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "test cell: its 25 frames at 20 Hz leave no room for an occlusion of 0.5 s with ten frames "
                 "before and 0.5 s after it; let `timing` be longer");
  }
  cell.platform.reset();
  EXPECT_THROW(static_cast<void>(fusion_of(cell, kPoints, few_runs(1), silent)), InputError);
  cell = cell_with_platform();
  cell.rig.right_from_left.translation.x() *= -1;  // the right camera looks away
  cell.rig.right_from_left.rotation = exp_rotation({0, 3, 0});
  EXPECT_THROW(static_cast<void>(fusion_of(cell, kPoints, few_runs(1), silent)), MeasurementError);
}

TEST(FilterSuitedTo, IsThatOfTheMotionsAcceleration) {
  Sweep sweep;  // about z through the origin: acceleration 15° (2π 0.5)² sin
  sweep.yaw = {rad_from_deg(15), 0.5, 0};
  const FilterOptions suited = filter_suited_to(sweep, 4, 0.5, {});
  const double rms = 15 * std::pow(std::numbers::pi, 2) / std::sqrt(2.0) / std::sqrt(3.0);  // of one axis
  EXPECT_NEAR(suited.rate_wander_deg_s, std::sqrt(0.75 * 0.5) * rms, 0.02 * rms);
  EXPECT_DOUBLE_EQ(suited.speed_wander_mm_s, 0.1);
  EXPECT_EQ(suited.coast_max_s, FilterOptions{}.coast_max_s);
}

}  // namespace
}  // namespace asterism
