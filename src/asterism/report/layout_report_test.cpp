// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/layout_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/report/layout_words.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Four targets seen in two poses; in the second the right camera misses P2, so that nothing is determined.
LayoutDesign design(const std::string& name) {
  LayoutDesign design;
  design.name = name;
  design.origin = "found";
  for (int i = 0; i < 4; ++i) {
    design.targets.push_back(
        {"P" + std::to_string(i + 1), Vec3(100.0 * i, 10.0 * i * i, 0), Vec3::UnitZ(), 12.0, {}});
  }
  design.quantities = {{"targets", "", false, 4.0},
                       {"worst-error-1-lost", "mm", false, {}},
                       {"identifiability", "mm", true, 0.27}};
  design.objectives = {design.quantities[0], design.quantities[2]};
  design.constraints = {{"visible", "", true, 5, 3.0, 2},
                        {"worst-error-1-lost", "mm", false, 0.2, {}, kInfinity},
                        {"spacing", "mm", true, 100, 100.5, 0}};
  design.identifiability = {0.27, {0, 1, 2, 3}, {2, 3, 0, 1}, true};
  design.visibility.seen = {{0b1111, 0b1111}, {0b1111, 0b1101}};
  design.accuracy.after = {{WorstError{0.0432, 0, 0, {}}, 0.04, 1, {0.0432, kInfinity}},
                           {std::nullopt, 0, 2, {kInfinity, kInfinity}}};
  return design;
}

LayoutReport small_report() {
  LayoutReport report;
  report.title = "Layouts";
  report.cell.rig.left = report.cell.rig.right = Lens{2000, 2000, 0, 639.5, 479.5, {}, 0, 1280, 960};
  report.cell.rig.right_from_left.translation = Vec3(-400, 0, 0);
  report.cell.volume = WorkingVolume{};
  const Body body{"platform", design("").targets};
  report.cell.movers.push_back({body, at_rest({Quaternion::Identity(), Vec3(0, 0, 2000)})});
  report.cell.obstacles = {{"casing", Frustum{100, 80, 50}, "platform", {}, {}},
                           {"cable", Capsule{}, "", {}, {}}};
  LayoutTask task;
  task.body = "platform";
  task.surface.patches = {{"rim", Annulus{Vec3(0, 0, 10), 200, 300, 0, rad_from_deg(90)}},
                          {"wall", CylinderSide{}},
                          {"tray", Plate{}},
                          {"room", CylinderRoom{}}};
  task.surface.keep_outs = {{"clamp", Box{Vec3(1, 2, 3)}, {}}};
  task.points = {{"flange", Vec3(0, 0, 300)}};
  report.cell.layout = task;
  report.pose_times_s = {0, 0.5};
  report.found = {design("4 targets")};
  report.given = {design("present")};
  report.knee = 0;
  report.history = {{0, 100, 0.5, 0.25, 0.1}};
  return report;
}

TEST(LayoutReportJson, HoldsLayoutsWithTheirMeasuresAndWhatTheyBreak) {
  const Json json = Json::parse(layout_report_json(small_report()));
  EXPECT_EQ(json["schema"], "asterism-layout-report/1");
  ASSERT_EQ(json["layouts"].size(), 2U);
  const Json& layout = json["layouts"][0];
  EXPECT_EQ(layout["seen"], Json({"33", "31", "33", "33"}));
  EXPECT_EQ(layout["error_mm"], Json({0.0432, nullptr}));
  EXPECT_EQ(layout["values"].size(), json["measures"].size());
  EXPECT_EQ(layout["values"][2], nullptr);  // the objectives come first
  EXPECT_EQ(json["measures"][2]["label"], "worst error after any one loss");
  EXPECT_EQ(json["measures"][1]["better"], "more");
  EXPECT_EQ(json["measures"][1]["objective"], true);
  EXPECT_EQ(json["measures"][2]["objective"], false);
  EXPECT_FALSE(layout["reference"]);
  EXPECT_TRUE(json["layouts"][1]["reference"]);
  EXPECT_EQ(json["knee"], 0);
}

TEST(LayoutReportJson, HoldsTheCellAsFarAsItBearsOnLayouts) {
  const Json json = Json::parse(layout_report_json(small_report()));
  EXPECT_EQ(json["motion"]["pose"].size(), 2U);
  EXPECT_EQ(json["motion"]["pose"][1][2], 2000);
  EXPECT_EQ(json["patches"][0]["kind"], "ring");
  EXPECT_NEAR(json["patches"][0]["to_deg"], 90, 1e-9);
  EXPECT_EQ(json["patches"].size(), 4U);
  EXPECT_EQ(json["keep_outs"][0]["shape"], "box");
  ASSERT_EQ(json["obstacles"].size(), 1U);  // the cable does not move with the platform
  EXPECT_EQ(json["volume"]["far_size_mm"], Json({2600, 2000}));
  EXPECT_EQ(json["points"][0]["name"], "flange");
}

TEST(LayoutReportJson, IsWholeWithoutAnyLayout) {
  LayoutReport report = small_report();
  report.found.clear();
  report.given.clear();
  report.knee = -1;
  report.cell.volume.reset();
  const Json json = Json::parse(layout_report_json(report));
  EXPECT_EQ(json["layouts"].size(), 0U);
  EXPECT_EQ(json["knee"], nullptr);
  EXPECT_EQ(json["volume"], nullptr);
}

TEST(LayoutReportJson, RefusesAKneeThatIsNoneOfTheLayouts) {
  LayoutReport report = small_report();
  report.knee = 1;
  EXPECT_THROW(static_cast<void>(layout_report_json(report)), ContractViolation);
}

TEST(WriteLayoutReport, WritesOnePageWithTheDataInside) {
  const TestFolder folder;
  LayoutReport report = small_report();
  report.found[0].name = "</script><b>";
  write_layout_report(folder / "report.html", report);
  const std::string page = folder.read("report.html");
  EXPECT_TELLS(page, "asterism-layout-report/1");
  EXPECT_TELLS(page, "\\u003c/script>\\u003cb>");
}

TEST(BrokenConstraints, SayWhatIsAskedAndByHowMuchItIsMissed) {
  EXPECT_EQ(
      broken_constraints(design("")),
      (std::vector<std::string>{"visible is 3, at least 5 asked: 2 missing",
                                "worst error after any one loss cannot be told, at most 0.200 mm asked"}));
}

TEST(NotesOn, SayWhereTheWorstIsAndWhatTheLayoutCanBeTakenFor) {
  const LayoutReport report = small_report();
  const auto notes = notes_on(report.found[0], *report.cell.layout, report.pose_times_s);
  EXPECT_EQ(notes,
            (std::vector<std::string>{
                "Worst error 0.0432 mm, at 0.00 s at flange. Worst error: not determined in 1 of 2 poses.",
                "Worst error after any one loss: not determined in 2 of 2 poses.",
                "Both cameras see at least 3 of its 4 targets; fewest at 0.50 s.",
                "P1, P2, P3, P4 fit as P3, P4, P1, P2 within 0.270 mm RMS."}));
}

TEST(TextOfValue, KeepsThreeDigitsThatCount) {
  EXPECT_EQ(text_of_value(0.04321), "0.0432");
  EXPECT_EQ(text_of_value(12345.6), "12346");
  EXPECT_EQ(text_of_value(7), "7");
  EXPECT_EQ(text_of_value(0.99999), "1.00");
  EXPECT_EQ(text_of_value(1e-15), "0");
  EXPECT_EQ(text_of_value(-1.5), "-1.50");
  EXPECT_EQ(text_of_value({}), "–");
}

}  // namespace
}  // namespace asterism
