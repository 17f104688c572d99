// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/speed_trade.hpp"

#include <gtest/gtest.h>

#include "asterism/core/parallel.hpp"
#include "asterism/evaluation/streak_check.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

SpeedTradeOptions small() {
  SpeedTradeOptions options;
  options.speeds_deg_s = {0, 60, 180};
  options.exposures_s = {0.001, 0.004, 0.01};
  options.rates_hz = {10, 100};
  options.frames = 10;
  options.image_frames = 0;
  return options;
}

const SpeedTradeRow& row(const SpeedTrade& trade, std::size_t speed, std::size_t exposure, std::size_t rate) {
  const std::size_t at =
      (speed * trade.options.exposures_s.size() + exposure) * trade.options.rates_hz.size();
  return trade.rows.at(at + rate);
}

TEST(SpeedTradeOf, SmearsInProportionToSpeedAndExposure) {
  const SpeedTrade trade = speed_trade_of(test_cell(), small(), {}, no_progress);
  for (const SpeedTradeRow& at_rest : std::span(trade.rows).first(6)) {
    EXPECT_EQ(at_rest.streak_px, 0);
    EXPECT_EQ(at_rest.measured.seen, at_rest.measured.frames);
    EXPECT_DOUBLE_EQ(at_rest.sigma_px, test_cell().noise.sigma_px);
  }
  const double once = row(trade, 1, 0, 1).streak_px;
  EXPECT_GT(once, 0.02);
  EXPECT_NEAR(row(trade, 1, 1, 1).streak_px, 4 * once, 1e-9);
  EXPECT_GT(row(trade, 1, 1, 1).sigma_px, row(trade, 1, 0, 1).sigma_px);
  EXPECT_GT(row(trade, 1, 1, 1).measured.rms_mm(), row(trade, 1, 0, 1).measured.rms_mm());
}

TEST(SpeedTradeOf, LosesWhatIsSmearedFartherThanIsFound) {
  SpeedTradeOptions options = small();
  options.speeds_deg_s = {180};
  options.longest_streak = 0.3;
  const SpeedTrade trade = speed_trade_of(test_cell(), options, {}, no_progress);
  const Outcome& longest = row(trade, 0, 2, 1).measured;
  EXPECT_LT(longest.seen, longest.frames);
  EXPECT_EQ(longest.seen + longest.lost + longest.flagged, longest.frames);
}

TEST(SpeedTradeOf, IsNeverSilentlyWrongHoweverFastAndSeldomItLooks) {
  const SpeedTrade trade = speed_trade_of(test_cell(), small(), {}, no_progress);
  for (const SpeedTradeRow& at : trade.rows) {
    EXPECT_EQ(at.measured.wrong + at.measured.too_sure, 0u) << at.speed_deg_s << " °/s, " << at.rate_hz;
    // At 10 Hz the swing of 180 °/s turns back within two frames: an unseen pose is carried on too surely.
    const bool beyond_the_model = at.speed_deg_s > 100 && at.rate_hz < 20;
    if (beyond_the_model) continue;
    EXPECT_EQ(at.filtered.wrong + at.filtered.too_sure, 0u) << at.speed_deg_s << " °/s, " << at.rate_hz;
  }
}

TEST(SpeedTradeOf, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto squares = [](int threads) {
    set_thread_count(threads);
    std::vector<double> all;
    for (const SpeedTradeRow& at : speed_trade_of(test_cell(), small(), {}, no_progress).rows)
      all.insert(all.end(), {at.measured.square_mm, at.filtered.square_mm, at.streak_px});
    set_thread_count(0);
    return all;
  };
  EXPECT_EQ(squares(1), squares(2));
}

TEST(SwingingCell, TurnsAboutThePivotAsFastAsAsked) {
  const Cell cell = swinging_cell(test_cell(), 90, 12);
  const auto& sweep = std::get<Sweep>(cell.movers[0].motion);
  const RigidMotion before = pose_at(cell.movers[0].motion, -5e-4);
  const RigidMotion after = pose_at(cell.movers[0].motion, 5e-4);
  EXPECT_NEAR(deg_from_rad(rotation_angle(before.rotation, after.rotation)) / 1e-3, 90, 0.01);
  EXPECT_LT((before * sweep.pivot_mm - after * sweep.pivot_mm).norm(), 1e-9);
}

TEST(StreakChecks, AgreeWithTheModelWhileDetectionFindsTheTargets) {
  SpeedTradeOptions options;
  options.image_frames = 4;
  const std::vector<StreakCheck> checks = streak_checks(test_cell(), options, {});
  ASSERT_GE(checks.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) {  // up to a fifth of the diameter
    const StreakCheck& check = checks[i];
    EXPECT_EQ(check.found, check.shown) << check.streak_px;
    EXPECT_LT(check.nees_share, 1.6) << check.streak_px;
    EXPECT_LT(check.along_px, 1.6 * check.model_along_px) << check.streak_px;
  }
  EXPECT_GT(checks.back().along_px, 3 * checks.front().along_px);
}

}  // namespace
}  // namespace asterism
