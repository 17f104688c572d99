// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/cell_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Two moments; in the second the part hides P2 from the right camera and nothing is determined.
CellReport small_report() {
  CellReport report;
  report.title = "Cell";
  report.rig.left = report.rig.right = Lens{2000, 2000, 0, 639.5, 479.5, {}, 0, 1280, 960};
  report.rig.right_from_left.translation = Vec3(-400, 0, 0);
  report.volume = WorkingVolume{};
  report.times_s = {0, 0.05};
  CellReport::BodyView body;
  body.name = "platform";
  body.targets = {{"P1", Vec3(1, 2, 3), Vec3::UnitZ(), 12.0, {}}, {"P2", Vec3(4, 5, 6), {}, {}, {}}};
  body.tracker_from_body = {{Quaternion::Identity(), Vec3(0, 0, 2000)},
                            {Quaternion::Identity(), Vec3(1, 0, 2000)}};
  body.sight = {{"..", ".."}, {"..", ".a"}};
  report.bodies = {body};
  CellReport::SolidView part;
  part.name = "part";
  part.role = "workpiece";
  part.carrier = 0;
  part.surface.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  part.surface.triangles = {{0, 1, 2}};
  part.error_mm = {0.1, 0.2, kNone};
  report.solids = {part};
  report.axes = {{"O_g", 0, {Quaternion::Identity(), Vec3(0, 0, 7)}}};
  report.visible = {2, 1};
  report.coverage = {0.75, kNone};
  const Mat3 covariance = (Mat3() << 1, 2, 3, 2, 4, 5, 3, 5, 6).finished();
  report.points = {
      {"rim", Vec3(7, 8, 9), {3.316, kNone}, {covariance, Mat3::Constant(kNone)}, {0.02, kNone}}};
  report.status = "OL";
  report.heats = {{"Visible", "roll (deg)", "pitch (deg)", "targets", {-15, 15}, {0}, {{6, kNone}}}};
  report.tables = {{"table-13", "Runs", "", {"Case", "Value"}, {{"a", 1.5}, {"b", std::monostate{}}}, {}}};
  report.charts = {{"speed",
                    "Speed",
                    "",
                    "deg/s",
                    "mm",
                    true,
                    false,
                    {{"raw", {1, 2}, {0.1, kNone}, {0.05, 0.05}, {0.2, 0.2}, true}},
                    {{"tolerance", 0.25}}}};
  report.options_json = R"({"seed": 1})";
  return report;
}

Json json_of(const CellReport& report) { return Json::parse(cell_report_json(report)); }

TEST(CellReportJson, HoldsBodiesWithTheirPosesAndWhyATargetIsNotSeen) {
  const Json json = json_of(small_report());
  EXPECT_EQ(json["schema"], "asterism-cell-report/1");
  const Json& body = json["bodies"][0];
  EXPECT_EQ(body["pose"][1], Json({1.0, 0.0, 2000.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(body["sight"], Json::parse(R"([["..", ".."], ["..", ".a"]])"));
  EXPECT_EQ(body["targets"][0]["normal"][2], 1);
  EXPECT_FALSE(body["targets"][1].contains("normal"));
}

TEST(CellReportJson, HoldsSurfacesAsNumbersInBase64) {
  const Json json = json_of(small_report());
  const Json& part = json["solids"][0];
  // Nine floats of which the fourth and the eighth are one; the numbers 0, 1, 2.
  EXPECT_EQ(part["vertices"], "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA");
  EXPECT_EQ(part["triangles"], "AAAAAAEAAAACAAAA");
  EXPECT_EQ(part["error_mm"], Json({0.1, 0.2, nullptr}));
  EXPECT_EQ(part["carrier"], 0);
}

TEST(CellReportJson, SaysNothingWhereNothingIsDetermined) {
  const Json json = json_of(small_report());
  const Json& point = json["points"][0];
  EXPECT_EQ(point["predicted_mm"], Json({3.316, nullptr}));
  EXPECT_EQ(point["covariance_mm2"], Json::parse("[[1, 2, 3, 4, 5, 6], null]"));
  EXPECT_EQ(point["without_mm"], Json::array());
  EXPECT_EQ(json["coverage"], Json({0.75, nullptr}));
  EXPECT_EQ(json["heats"][0]["value"], Json::parse("[[6, null]]"));
  EXPECT_EQ(json["tables"][0]["rows"], Json::parse(R"([["a", 1.5], ["b", null]])"));
  EXPECT_EQ(json["charts"][0]["curves"][0]["y"], Json({0.1, nullptr}));
}

TEST(CellReportJson, IsWholeWithoutTrackingPartOrVolume) {
  CellReport report = small_report();
  report.volume.reset();
  report.solids.clear();
  report.points.clear();
  report.status.clear();
  report.coverage.clear();
  report.options_json.clear();
  const Json json = json_of(report);
  EXPECT_EQ(json["volume"], nullptr);
  EXPECT_EQ(json["status"], "");
  EXPECT_EQ(json["coverage"], Json::array());
  EXPECT_EQ(json["options"], nullptr);
}

TEST(CellReportJson, TellsThatALargeSurfaceIsDrawnWithFewerTriangles) {
  CellReport report = small_report();
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= 50; ++i) profile.push_back({500, 10.0 * i});
  for (int i = 50; i >= 0; --i) profile.push_back({480, 10.0 * i});
  report.solids[0].surface = surface_of_revolution(profile, 400);  // 81 600 triangles
  report.solids[0].error_mm.clear();
  const Json json = json_of(report);
  ASSERT_EQ(json["remarks"].size(), 1U);
  EXPECT_TELLS(json["remarks"][0].get<std::string>(), "part has 81600 triangles; the view draws");
  EXPECT_LE(json["solids"][0]["triangles"].get<std::string>().size(), 60000U * 3 * 4 * 4 / 3 + 4);
}

TEST(CellReportJson, HoldsThatLengthsAgree) {
  const auto refuses = [](auto&& spoil) {
    CellReport report = small_report();
    spoil(report);
    EXPECT_THROW(static_cast<void>(cell_report_json(report)), ContractViolation);
  };
  refuses([](CellReport& r) { r.body = 1; });
  refuses([](CellReport& r) { r.bodies[0].tracker_from_body.pop_back(); });
  refuses([](CellReport& r) { r.bodies[0].sight.pop_back(); });
  refuses([](CellReport& r) { r.bodies[0].sight[1][0] += '.'; });
  refuses([](CellReport& r) { r.solids[0].error_mm.pop_back(); });
  refuses([](CellReport& r) { r.solids[0].carrier = 1; });
  refuses([](CellReport& r) { r.axes[0].carrier = -2; });
  refuses([](CellReport& r) { r.points[0].predicted_mm.push_back(0); });
  refuses([](CellReport& r) { r.points[0].measured_mm.push_back(0); });
  refuses([](CellReport& r) { r.points[0].without_mm.push_back(0); });
  refuses([](CellReport& r) { r.visible.clear(); });
  refuses([](CellReport& r) { r.status = "O"; });
  refuses([](CellReport& r) { r.heats[0].value[0].pop_back(); });
  refuses([](CellReport& r) { r.tables[0].rows[0].pop_back(); });
  refuses([](CellReport& r) { r.tables[0].verdicts = {Verdict::Good}; });
  refuses([](CellReport& r) { r.charts[0].curves[0].y.pop_back(); });
  refuses([](CellReport& r) { r.charts[0].curves[0].high.clear(); });
  refuses([](CellReport& r) { r.charts[0].curves[0].x[0] = kNone; });
}

TEST(WriteCellReport, WritesOnePageInWhichNoNameIsMarkup) {
  const TestFolder folder;
  CellReport report = small_report();
  report.solids[0].name = "</script><b>";
  write_cell_report(folder / "report.html", report);
  const std::string page = folder.read("report.html");
  EXPECT_TELLS(page, "asterism-cell-report/1");
  EXPECT_TELLS(page, "\\u003c/script>\\u003cb>");
}

}  // namespace
}  // namespace asterism
