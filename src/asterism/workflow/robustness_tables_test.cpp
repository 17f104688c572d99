// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/robustness_tables.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

Outcome outcome(std::size_t kept, std::size_t wrong) {
  Outcome made;
  made.frames = kept + wrong;
  made.kept = kept;
  made.wrong = wrong;
  made.seen = made.poses = kept + wrong;
  made.square_mm = 0.04 * static_cast<double>(made.seen);
  made.nees = 6.0 * static_cast<double>(made.poses);
  return made;
}

RobustnessTable robustness() {
  RobustnessTable table;
  FaultOutcome none;
  none.fault = "none";
  none.runs = 2;
  none.measured = none.filtered = outcome(10, 0);
  FaultOutcome knocked = none;
  knocked.fault = "a target knocked by 1 mm";
  knocked.knocks = 2;
  knocked.found = 1;
  knocked.named = 8;
  FaultOutcome bad = none;
  bad.fault = "bad";
  bad.measured = outcome(9, 1);
  table.rows = {none, knocked, bad};
  return table;
}

SpeedTrade trade() {
  SpeedTrade made;
  made.options.speeds_deg_s = {0, 60};
  made.options.exposures_s = {0.001, 0.01};
  made.options.rates_hz = {10, 50};
  for (const double speed : made.options.speeds_deg_s) {
    for (const double exposure : made.options.exposures_s) {
      for (const double rate : made.options.rates_hz) {
        const bool lost = speed > 0 && exposure > 0.005;
        Outcome none;
        none.frames = none.lost = 10;
        const Outcome all = lost ? none : outcome(10, 0);
        made.rows.push_back({speed, exposure, rate, 3, 0.02, all, all});
      }
    }
  }
  made.checks.push_back({2, 0.001, 12, 0, 0, 0, 0, 0, 0.01, 0.01});
  return made;
}

void expect_whole(const ReportTable& table) {
  EXPECT_FALSE(table.id.empty());
  EXPECT_TRUE(table.verdicts.empty() || table.verdicts.size() == table.rows.size()) << table.id;
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.id;
}

TEST(RobustnessTables, HaveACellForEachColumn) {
  expect_whole(robustness_table(robustness()));
  expect_whole(knock_table(robustness()));
  expect_whole(speed_trade_table(trade()));
  expect_whole(streak_table(trade()));
}

TEST(RobustnessTables, MarkWhatWasSilentlyWrongAndWhatWasNotFound) {
  const ReportTable faults = robustness_table(robustness());
  EXPECT_EQ(faults.verdicts, (std::vector<Verdict>{Verdict::Good, Verdict::Good, Verdict::Bad}));
  EXPECT_EQ(std::get<double>(faults.rows[2][9]), 1);
  EXPECT_NEAR(std::get<double>(faults.rows[0][10]), 0.2, 1e-12);
  const ReportTable knocks = knock_table(robustness());
  ASSERT_EQ(knocks.rows.size(), 2u);
  EXPECT_EQ(knocks.verdicts[1], Verdict::Attention);
  EXPECT_NEAR(std::get<double>(knocks.rows[1][2]), 80, 1e-9);
}

TEST(SpeedTradeCharts, EndACurveWhereThereIsNoPose) {
  const auto charts = speed_trade_charts(trade(), 0.25);
  ASSERT_EQ(charts.size(), 2u);
  ASSERT_EQ(charts[0].curves.size(), 2u);
  EXPECT_EQ(charts[0].curves[0].x, (std::vector<double>{0, 60}));
  EXPECT_EQ(charts[0].curves[1].x, (std::vector<double>{0}));
  EXPECT_EQ(charts[0].limits[0].second, 0.25);
  EXPECT_EQ(charts[1].curves.size(), 3u);  // two rates and the raw error
}

}  // namespace
}  // namespace asterism
