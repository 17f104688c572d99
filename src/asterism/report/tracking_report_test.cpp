// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/tracking_report.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/result.hpp"
#include "asterism/report/page.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

StereoRig rig() {
  StereoRig rig;
  rig.left = rig.right = Lens{2000, 2000, 0, 639.5, 479.5, {}, 0, 1280, 960};
  rig.right_from_left.translation = Vec3(-400, 0, 0);
  return rig;
}

const RigidMotion kTruth{exp_rotation({0.02, -0.1, 0.3}), Vec3(30, -40, 2000)};

Vec2 image_of(const Target& target, Side side) {
  const RigidMotion camera_from_body = rig().camera_from_tracker(side) * kTruth;
  const Disc disc{camera_from_body * target.position, camera_from_body.rotation * *target.normal, 6};
  return project_disc_centre(rig().lens(side), disc)->px;
}

Centre centre_at(const Vec2& px) {
  Centre centre;
  centre.ellipse.centre = px;
  return centre;
}

/// One body of three targets: the first labelled in both images, the second in the left image only and
/// without label, the third hidden. Two more frames: one predicted, one ambiguous.
TrackingReport small_report() {
  TrackingReport report;
  report.title = "A small run";
  report.rig = rig();
  Body body{"platform", {}};
  for (const Vec3& place : {Vec3(100, 0, 0), Vec3(0, 120, 0), Vec3(-90, -60, 30)}) {
    body.targets.push_back({"P" + std::to_string(body.targets.size() + 1), place, Vec3(0, 0, -1), 12.0, {}});
  }
  report.bodies = {body};

  TrackedFrame measured;
  measured.centres = {7, 0.25, {}, {}};
  measured.centres.left = {centre_at(image_of(body.targets[1], Side::Left) + Vec2(0.02, 0)),
                           centre_at(image_of(body.targets[0], Side::Left) + Vec2(0.01, -0.03))};
  measured.centres.right = {centre_at(image_of(body.targets[0], Side::Right))};
  measured.points = {{Vec3::Zero(), Mat3::Identity(), 0, 1, 0}};
  measured.labels = {{0, LabelStatus::Ok, {{0, 0}}, {}, 0, 0}};
  PoseEstimate estimate{kTruth, Mat6::Zero()};
  estimate.covariance.diagonal() << 1e-10, 2e-10, 3e-10, 1e-4, 2e-4, 3e-4;
  measured.poses = {{0, PoseStatus::Partial, estimate, 2, 0.0123456}};
  measured.filtered = measured.poses;

  TrackedFrame predicted;
  predicted.centres = {8, 0.26, {}, {}};
  predicted.poses = {{0, PoseStatus::Lost, {}, 0, std::numeric_limits<double>::quiet_NaN()}};
  predicted.filtered = {{0, PoseStatus::Predicted, estimate, 0, 0}};

  TrackedFrame ambiguous;
  ambiguous.centres = {9, 0.27, {}, {}};
  ambiguous.poses = {{0, PoseStatus::Ambiguous, {}, 0, 0}};
  report.frames = {measured, predicted, ambiguous};
  report.truth = {{kTruth}, {kTruth}, {std::nullopt}};
  return report;
}

Json json_of(const TrackingReport& report) { return Json::parse(tracking_report_json(report)); }

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The data block of a page, as a browser cuts it out: up to the first closing tag.
Json data_block(const std::string& page) {
  const std::string open = "id=\"report-data\">";
  const std::size_t begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

class WriteReport : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("asterism_report_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST(TrackingReportJson, HoldsPosesTruthAndCovarianceOfTheNamedPoint) {
  TrackingReport report = small_report();
  report.error_points = {{"flange", Vec3(0, 0, 500)}};
  const Json body = json_of(report)["bodies"][0];
  const Json row = body["measured"][0];
  ASSERT_EQ(row.size(), 19U);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(row[k], kTruth.translation[k], 1e-5);
  EXPECT_NEAR(row[3], kTruth.rotation.w(), 1e-9);
  const auto& covariance = report.frames[0].poses[0].estimate->covariance;
  const Mat3 at_flange = covariance_of_point(kTruth, covariance, Vec3(0, 0, 500));
  EXPECT_NEAR(row[7], at_flange(0, 0), 1e-4 * at_flange(0, 0));
  EXPECT_NEAR(row[9], at_flange(0, 2), 1e-4 * std::abs(at_flange(0, 2)));
  EXPECT_NEAR(row[16], 2e-10, 1e-14);  // five digits of the rotation's yy
  EXPECT_EQ(body["truth"][0].size(), 7U);
  EXPECT_TRUE(body["truth"][2].is_null());
  EXPECT_EQ(body["point"]["name"], "flange");
}

TEST(TrackingReportJson, TellsAccuracyAtTheTargetCentroidWhenNoPointIsNamed) {
  const Json point = json_of(small_report())["bodies"][0]["point"];
  EXPECT_EQ(point["name"], "target centroid");
  EXPECT_NEAR(point["position_mm"][1], 20.0, 1e-5);
}

TEST(TrackingReportJson, GivesNoPoseThatIsNotTrusted) {
  const Json body = json_of(small_report())["bodies"][0];
  EXPECT_EQ(body["status"], "PLA");
  EXPECT_EQ(body["filtered_status"], "PRL");
  EXPECT_TRUE(body["measured"][1].is_null());
  EXPECT_TRUE(body["measured"][2].is_null());
  EXPECT_FALSE(body["filtered"][1].is_null());
}

TEST(TrackingReportJson, WritesNullWhereANumberIsNotFinite) {
  TrackingReport report = small_report();
  report.frames[0].poses[0].estimate->tracker_from_body.translation.x() =
      std::numeric_limits<double>::infinity();
  const std::string text = tracking_report_json(report);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const Json body = Json::parse(text)["bodies"][0];
  EXPECT_TRUE(body["measured"][0].is_null());
  EXPECT_TRUE(body["rms_px"][1].is_null());
}

TEST(TrackingReportJson, TellsWhichCameraSawEachTargetAndItsResidual) {
  const Json seen = json_of(small_report())["bodies"][0]["sightings"];
  EXPECT_EQ(seen[0]["seen"], "300");
  EXPECT_EQ(seen[1]["seen"], "100");
  EXPECT_EQ(seen[2]["seen"], "000");
  EXPECT_NEAR(seen[0]["left_px"][0][0], 0.01, 1e-4);
  EXPECT_NEAR(seen[0]["left_px"][0][1], -0.03, 1e-4);
  EXPECT_NEAR(seen[1]["left_px"][0][0], 0.02, 1e-4);
  EXPECT_TRUE(seen[1]["right_px"][0].is_null());
}

TEST(TrackingReportJson, RefusesTruthForOtherFramesThanThese) {
  TrackingReport report = small_report();
  report.truth.pop_back();
  EXPECT_THROW((void)tracking_report_json(report), ContractViolation);
}

TEST_F(WriteReport, MakesOnePageThatReadsBackAndNeedsNothingElse) {
  write_report(folder_ / "report.html", small_report());
  const std::string page = content_of(folder_ / "report.html");
  const Json data = data_block(page);
  EXPECT_EQ(data["title"], "A small run");
  EXPECT_EQ(data["frames"]["frame"], Json({7, 8, 9}));
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("type=\"module\""), std::string::npos);
  EXPECT_LT(page.size(), 1'200'000U);
}

TEST_F(WriteReport, KeepsMarkupInNamesFromEndingTheDataBlock) {
  TrackingReport report = small_report();
  report.bodies[0].name = "</script><script>alert(1)</script><!--";
  report.title = "not UTF-8: \xff";
  write_report(folder_ / "report.html", report);
  const Json data = data_block(content_of(folder_ / "report.html"));
  EXPECT_EQ(data["bodies"][0]["name"], report.bodies[0].name);
}

TEST_F(WriteReport, LeavesTheOlderFileAndNoPieceWhenItCannotWrite) {
  const auto path = folder_ / "report.html";
  std::filesystem::create_directories(path / "in the way");
  try {
    write_report(path, small_report());
    FAIL() << "a folder was overwritten";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("report.html: is a folder"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::exists(path / "in the way"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report.html.partial"));
}

TEST_F(WriteReport, NamesTheFileThatCannotBeMade) {
  std::ofstream(folder_ / "file") << "no folder";
  EXPECT_THROW(write_report(folder_ / "file" / "report.html", small_report()), InputError);
}

TEST_F(WriteReport, SaysSoWhenTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  std::filesystem::create_symlink("/dev/full", folder_ / "report.html.partial");
  EXPECT_THROW(write_report(folder_ / "report.html", small_report()), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report.html"));
}

TEST(PageWithData, NeedsTheDataBlock) {
  EXPECT_THROW((void)page_with_data("<html></html>", "{}"), ContractViolation);
}

}  // namespace
}  // namespace asterism
