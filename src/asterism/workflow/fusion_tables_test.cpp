// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fusion_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asterism {
namespace {

FusionStudy study_by_hand() {
  FusionStudy study;
  study.body = "platform";
  study.point = "rim";
  study.runs = 20;
  study.times_s = {0, 0.05, 0.1};
  FusionRoad alone{200, 0, 38.6, 77, 61, 5.8, 1, 0.06, 0, {0.1, 5, 0.1}, {0.1, 4, 0.1}, {0.1, 6, 0.1}};
  FusionRoad with{200, 0, 0.7, 1.1, 0.8, 6.3, 0.94, 0.05, 0, {0.1, 0.7, 0.1}, {0, 0, 0}, {1, 1, 1}};
  study.drawn = {0.5, 2.75, alone, with};
  FusionRoad gone = alone;
  gone.lost = 200;
  gone.rms_mm = std::nan("");
  FusionRoad too_sure = with;
  too_sure.nees = 12;
  study.spells = {study.drawn, {2, 2.75, gone, too_sure}};
  study.offset = {0.02, 19, {"the platform does not move enough"}, 0.0201, 6e-5, 1.1, 0.97};
  return study;
}

TEST(FusionTables, TellTheCostOfEachLengthAndMarkACovarianceThatIsTooSure) {
  const auto tables = fusion_tables(study_by_hand());
  ASSERT_EQ(tables.size(), 2U);
  const ReportTable& cost = tables[0];
  ASSERT_EQ(cost.rows.size(), 2U);
  for (const auto& row : cost.rows) EXPECT_EQ(row.size(), cost.columns.size());
  EXPECT_EQ(std::get<double>(cost.rows[0][1]), 38.6);
  EXPECT_EQ(std::get<double>(cost.rows[0][5]), 0.7);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cost.rows[1][1]));  // no pose, no error
  EXPECT_EQ(std::get<double>(cost.rows[1][4]), 100);
  EXPECT_EQ(cost.verdicts, (std::vector<Verdict>{Verdict::Good, Verdict::Attention}));
  EXPECT_NE(cost.note.find("The read-out is an assumption"), std::string::npos);
  EXPECT_NE(cost.note.find("all these poses are PREDICTED"), std::string::npos);
}

TEST(FusionTables, TellTheOffsetInMillisecondsAndWhyARunDidNot) {
  const ReportTable offset = fusion_tables(study_by_hand())[1];
  ASSERT_EQ(offset.rows.size(), 1U);
  EXPECT_EQ(offset.rows[0].size(), offset.columns.size());
  EXPECT_DOUBLE_EQ(std::get<double>(offset.rows[0][1]), 20.1);
  EXPECT_EQ(offset.note, "1 of 20 runs did not tell it: the platform does not move enough.");
}

TEST(FusionCharts, DrawBothRoadsWithTheirBandsAndTheTolerance) {
  const auto charts = fusion_charts(study_by_hand(), 0.25);
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_EQ(charts[0].curves[1].y[1], 0.7);
  EXPECT_EQ(charts[0].curves[0].high[1], 6);
  EXPECT_EQ(charts[0].limits[0].second, 0.25);
  EXPECT_EQ(charts[1].curves[0].y[0], 38.6);
  EXPECT_TRUE(std::isnan(charts[1].curves[0].y[1]));  // lost: no cost in mm
  EXPECT_EQ(charts[1].curves[1].x[1], 2);
}

}  // namespace
}  // namespace asterism
