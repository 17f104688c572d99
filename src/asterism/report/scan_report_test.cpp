// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/scan_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;
using Keys = std::set<std::string>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ScanPlan small_plan(const std::vector<SurfaceSample>& samples) {
  ScanPlan plan;
  plan.samples = samples;
  plan.poses.resize(2);
  plan.poses[1].pitch_deg = 10;
  PlannedView first, second;
  first.workpiece_from_scanner.translation = Vec3(0, 0, 300);
  first.measures = {0, 2};
  second.platform_pose = 1;
  second.measures = {1};
  second.worst_sigma_mm = kNone;
  plan.views = {first, second};
  plan.bound = 2;
  plan.optimal = true;
  plan.in_words = "2 views, optimal";
  plan.limits = {{ScanLimit::Incidence, 12.5}};
  plan.covered_before = {2};
  return plan;
}

Cloud small_cloud() {
  Cloud cloud;
  cloud.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 65.535, 0)};
  cloud.normals = {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(0, 0, 0)};
  cloud.fields = {{"sigma_mm", {1, kNone, 2}}, {"scan", {0, 1, 1}}, {"mood", {1, 2, 3}}};
  return cloud;
}

/// Three places of a triangle; one round with everything, one with nothing.
ScanReport small_report() {
  ScanReport report;
  report.title = "Scans";
  report.part = "cone";
  report.surface.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  report.surface.triangles = {{0, 1, 2}};
  for (int i = 0; i < 3; ++i) report.samples.push_back({Vec3(i, 0, 0), Vec3::UnitZ(), 0, 1.0, 1.0});
  ScanReport::Round round;
  round.name = "platform at rest";
  round.plan = small_plan(report.samples);
  round.cloud = small_cloud();
  round.completeness = Completeness{{1, 0, 1}, {4, 0, 3}, 3, 2, {{1, Vec3(1, 0, 0), Vec3::UnitZ(), 0, {1}}}};
  round.deviation = Deviation{{0.5, kNone, -1}, {}, {{}}, 0.1, {1, 2, 0}};
  report.rounds = {round, {"empty", {}, {}, {}, {}}};
  report.options_json = R"({"seed": 1})";
  return report;
}

Json json_of(const ScanReport& report) { return Json::parse(scan_report_json(report)); }

Keys keys_of(const Json& object) {
  Keys keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

TEST(ScanReportJson, HasTheKeysThatThePageReads) {
  const Json json = json_of(small_report());
  EXPECT_EQ(json["schema"], "asterism-scan-report/1");
  EXPECT_EQ(keys_of(json), (Keys{"schema", "title", "subtitle", "links", "summary", "remarks", "scanner",
                                 "surface", "sample_lists", "rounds", "tolerance_mm", "view_s", "turn_s",
                                 "tables", "charts", "options"}));
  EXPECT_EQ(keys_of(json["scanner"]),
            (Keys{"stand_off_mm", "near_mm", "far_mm", "field_width_mm", "field_height_mm", "baseline_mm",
                  "max_incidence_deg", "good_incidence_deg"}));
  EXPECT_EQ(keys_of(json["sample_lists"][0]), (Keys{"places", "normals", "areas_mm2"}));
  const Json& round = json["rounds"][0];
  EXPECT_EQ(keys_of(round), (Keys{"name", "plan", "cloud", "completeness", "deviation"}));
  EXPECT_EQ(keys_of(round["plan"]),
            (Keys{"samples", "poses", "views", "bound", "optimal", "greedy_views", "candidates", "in_words",
                  "surface_mm2", "reachable_mm2", "coverable_mm2", "covered_before_mm2", "covered_mm2",
                  "limits", "covered_before", "tour_s", "nearest_neighbour_s", "remarks"}));
  EXPECT_EQ(keys_of(round["plan"]["poses"][0]), (Keys{"yaw_deg", "pitch_deg", "roll_deg"}));
  EXPECT_EQ(keys_of(round["plan"]["views"][0]),
            (Keys{"pose", "platform", "measures", "adds_mm2", "mean_incidence_deg", "beyond_good_incidence",
                  "worst_sigma_mm", "scanner_targets", "platform_targets", "starts_s"}));
  EXPECT_EQ(keys_of(round["plan"]["limits"][0]), (Keys{"limit", "area_mm2"}));
  EXPECT_EQ(keys_of(round["cloud"]),
            (Keys{"points", "drawn", "voxel_mm", "low_mm", "step_mm", "places", "normals", "fields"}));
  EXPECT_EQ(keys_of(round["cloud"]["fields"][0]), (Keys{"name", "whole", "values"}));
  EXPECT_EQ(keys_of(round["completeness"]),
            (Keys{"samples", "measured", "surface_mm2", "measured_mm2", "holes"}));
  EXPECT_EQ(keys_of(round["completeness"]["holes"][0]),
            (Keys{"area_mm2", "centre", "normal", "across_mm", "samples"}));
  EXPECT_EQ(keys_of(round["deviation"]), (Keys{"whole", "regions", "bin_mm", "histogram"}));
  EXPECT_EQ(
      keys_of(round["deviation"]["regions"][0]),
      (Keys{"region", "points", "beyond", "mean_mm", "rms_mm", "sigma_mm", "p05_mm", "median_mm", "p95_mm",
            "lowest_mm", "highest_mm", "in_tolerance", "below", "above", "predicted_rms_mm"}));
}

TEST(ScanReportJson, TellsSamplesOnceAndWhatIsMeasuredAsBits) {
  const Json json = json_of(small_report());
  EXPECT_EQ(json["sample_lists"].size(), 1U);
  const Json& plan = json["rounds"][0]["plan"];
  EXPECT_EQ(plan["samples"], 0);
  EXPECT_EQ(plan["views"][0]["measures"], "BQ==");  // 0b101
  EXPECT_EQ(plan["views"][1]["measures"], "Ag==");  // 0b010
  EXPECT_EQ(plan["covered_before"], "BA==");        // 0b100
  EXPECT_EQ(plan["views"][1]["worst_sigma_mm"], nullptr);
  EXPECT_EQ(plan["limits"][0]["limit"], std::string(text_of(ScanLimit::Incidence)));
  EXPECT_EQ(json["rounds"][0]["completeness"]["measured"], "BQ==");
  EXPECT_EQ(json["rounds"][0]["completeness"]["holes"][0]["samples"], "AQAAAA==");

  ScanReport other = small_report();
  other.rounds[0].plan->samples[1].at.z() = 1;
  const Json two = json_of(other);
  EXPECT_EQ(two["sample_lists"].size(), 2U);
  EXPECT_EQ(two["rounds"][0]["completeness"]["samples"], 1);
}

TEST(ScanReportJson, PacksTheCloudAndKeepsItsValuesInStep) {
  const Json json = json_of(small_report());
  const Json& cloud = json["rounds"][0]["cloud"];
  EXPECT_EQ(cloud["points"], 3);
  EXPECT_EQ(cloud["drawn"], 3);
  EXPECT_EQ(cloud["step_mm"], 0.001);
  // 0 0 0, 1000 0 0, 0 65535 0 steps of a µm, two bytes each.
  EXPECT_EQ(cloud["places"], "AAAAAAAA6AMAAAAAAAD//wAA");
  EXPECT_EQ(cloud["normals"], "AAB/AACBAAAA");  // 127, −127, none
  ASSERT_EQ(cloud["fields"].size(), 3U);        // what no page shows is left out
  EXPECT_EQ(cloud["fields"][0], Json({{"name", "deviation_mm"}, {"whole", false}, {"values", "ADgAfgC8"}}));
  EXPECT_EQ(cloud["fields"][1], Json({{"name", "sigma_mm"}, {"whole", false}, {"values", "ADwAfgBA"}}));
  EXPECT_EQ(cloud["fields"][2], Json({{"name", "scan"}, {"whole", true}, {"values", "AAABAAEA"}}));
}

TEST(ScanReportJson, IsWholeWithoutSurfaceOrRounds) {
  ScanReport report;
  const Json json = json_of(report);
  EXPECT_EQ(json["surface"], nullptr);
  EXPECT_EQ(json["rounds"], Json::array());
  EXPECT_EQ(json["options"], nullptr);
  report.rounds = {{"empty", {}, {}, {}, {}}};
  EXPECT_EQ(json_of(report)["rounds"][0]["cloud"], nullptr);
  report.rounds[0].cloud = Cloud{};
  EXPECT_EQ(json_of(report)["rounds"][0]["cloud"]["drawn"], 0);
}

TEST(ScanReportJson, SharesThePointsThatAreDrawnBetweenTheRounds) {
  ScanReport report;
  Cloud cloud;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 300; ++y) cloud.points.emplace_back(x, y, 0);
  report.rounds.resize(4);
  for (auto& round : report.rounds) round.cloud = cloud;
  const Json json = json_of(report);
  for (const Json& round : json["rounds"]) {
    EXPECT_EQ(round["cloud"]["points"], 120000);
    EXPECT_LE(round["cloud"]["drawn"], 60000);
    EXPECT_GT(round["cloud"]["drawn"], 20000);
  }
}

TEST(ScanReportJson, HoldsThatListsAgree) {
  const auto refuses = [](auto&& spoil) {
    ScanReport report = small_report();
    spoil(report, report.rounds[0]);
    EXPECT_THROW(static_cast<void>(scan_report_json(report)), ContractViolation);
  };
  refuses([](auto&, auto& round) { round.deviation->mm.pop_back(); });
  refuses([](auto&, auto& round) { round.cloud.reset(); });
  refuses([](auto&, auto& round) { round.cloud->normals.pop_back(); });
  refuses([](auto&, auto& round) { round.cloud->fields[0].values.pop_back(); });
  refuses([](auto&, auto& round) { round.plan->views[0].measures = {3}; });
  refuses([](auto&, auto& round) { round.plan->views[0].platform_pose = 2; });
  refuses([](auto&, auto& round) { round.plan->views[0].workpiece_from_scanner.translation.x() = kNone; });
  refuses([](auto&, auto& round) { round.completeness->holes[0].samples = {3}; });
  refuses([](auto& report, auto&) { report.samples.pop_back(); });
}

TEST(WriteScanReport, WritesOnePageInWhichNoNameIsMarkup) {
  const TestFolder folder;
  ScanReport report = small_report();
  report.rounds[0].name = "</script><b>";
  write_scan_report(folder / "report.html", report);
  const std::string page = folder.read("report.html");
  EXPECT_TELLS(page, "asterism-scan-report/1");
  EXPECT_TELLS(page, "\\u003c/script>\\u003cb>");
}

}  // namespace
}  // namespace asterism
