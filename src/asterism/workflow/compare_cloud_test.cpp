// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/compare_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/workflow/cloud_tables.hpp"

namespace asterism {
namespace {

/// A drum of radius 100 from z = 0 to 80, and a cloud 0.05 mm above its upper face.
TriangleMesh drum() { return surface_of_revolution({{0, 0}, {100, 0}, {100, 80}, {0, 80}}, 90); }

Cloud over_the_top(std::size_t count) {
  Cloud cloud;
  RandomStream random(1, 0);
  while (cloud.size() < count) {
    const Vec3 point(200 * random.uniform() - 100, 200 * random.uniform() - 100, 80.05);
    if (point.head<2>().norm() > 99) continue;
    cloud.points.push_back(point);
    cloud.normals.emplace_back(0, 0, 1);
  }
  return cloud;
}

class CompareCloud : public testing::Test {
 protected:
  CompareCloud() {
    write_ply(folder / "drum.ply", drum());
    write_cloud(folder / "cloud.ply", over_the_top(30000));
    job.cloud = folder / "cloud.ply";
    job.mesh = folder / "drum.ply";
    job.options.samples = 4000;
  }
  std::string refusal() const {
    try {
      (void)compare_cloud(job, no_progress);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  TestFolder folder;
  CompareJob job;
};

TEST_F(CompareCloud, TellsHowFarOffAndHowMuchIsMissing) {
  const ComparedCloud compared = compare_cloud(job, no_progress);
  EXPECT_EQ(compared.part, "drum");
  EXPECT_EQ(compared.points, 30000U);
  EXPECT_NEAR(compared.deviation.whole.mean_mm, 0.05, 1e-9);
  // The upper face of a drum of these sizes: R / (2 R + 2 h) = 0.278; 4000 places, evenly by area.
  EXPECT_NEAR(compared.completeness.share(), 100.0 / 360, 0.01);
  ASSERT_GE(compared.completeness.holes.size(), 2U);  // the lower face, the belt
  EXPECT_TRUE(compared.remarks.empty());
  EXPECT_EQ(compared.cloud.size(), 0U);  // not kept where it is not written
}

TEST_F(CompareCloud, WritesTheCloudWithItsDeviationsAndAPage) {
  job.out = folder / "with.ply";
  job.report = folder / "page.html";
  (void)compare_cloud(job, no_progress);
  const Cloud cloud = read_cloud(job.out);
  ASSERT_NE(cloud.field("deviation_mm"), nullptr);
  EXPECT_NEAR(cloud.field("deviation_mm")->front(), 0.05, 1e-7);  // single precision
  EXPECT_EQ(cloud.normals.size(), cloud.size());
  EXPECT_GT(std::filesystem::file_size(job.report), 1000U);
}

TEST_F(CompareCloud, TakesTheCloudsUnitAndSaysWhichOneWouldFit) {
  Cloud cloud = over_the_top(3000);
  for (Vec3& point : cloud.points) point *= 1e-3;
  write_cloud(job.cloud, cloud);
  EXPECT_NE(refusal().find("in m it would fit: say --unit m"), std::string::npos) << refusal();
  job.unit = LengthUnit::Metre;
  EXPECT_NEAR(compare_cloud(job, no_progress).deviation.whole.mean_mm, 0.05, 1e-9);
  for (Vec3& point : cloud.points) point *= 1e3 / 25.4;
  write_cloud(job.cloud, cloud);
  job.unit.reset();
  // An inch is no hundredth: told where not one point lies near the surface.
  job.options.deviation.within_mm = 1;
  EXPECT_NE(refusal().find("say --unit inch"), std::string::npos) << refusal();
}

TEST_F(CompareCloud, RefusesWhatCannotBeCompared) {
  job.cell = "paper_cell";
  EXPECT_NE(refusal().find("one of --cell and --mesh"), std::string::npos);
  job.cell.clear();
  write_ply(folder / "flipped.ply", flipped(drum()));
  job.mesh = folder / "flipped.ply";
  EXPECT_NE(refusal().find("inside out"), std::string::npos) << refusal();
  job.mesh = folder / "drum.ply";
  Cloud cloud = over_the_top(500);
  for (Vec3f& normal : cloud.normals) normal = -normal;
  write_cloud(job.cloud, cloud);
  EXPECT_NE(refusal().find("100 % of the cloud's normals face against"), std::string::npos) << refusal();
  job.without_normals = true;
  EXPECT_EQ(refusal(), "");
  for (Vec3& point : cloud.points) point.x() += 700;
  write_cloud(job.cloud, cloud);
  EXPECT_NE(refusal().find("not one of 500 points lies within 5 mm"), std::string::npos) << refusal();
}

TEST_F(CompareCloud, RemarksThatASurfaceIsOpen) {
  TriangleMesh open = drum();
  open.triangles.resize(open.triangles.size() - 10);
  write_ply(job.mesh, open);
  const ComparedCloud compared = compare_cloud(job, no_progress);
  ASSERT_EQ(compared.remarks.size(), 1U);
  EXPECT_NE(compared.remarks[0].find("the surface is open"), std::string::npos);
}

TEST_F(CompareCloud, SaysInItsTablesAndItsJsonWhatItFound) {
  const ComparedCloud compared = compare_cloud(job, no_progress);
  const ReportTable deviation = deviation_table(compared.deviation, job.options.deviation);
  ASSERT_EQ(deviation.rows.size(), 1U);
  EXPECT_EQ(deviation.rows[0].size(), deviation.columns.size());
  EXPECT_EQ(std::get<double>(deviation.rows[0][1]), 30000);
  const ReportTable holes = hole_table(compared.completeness, 1);
  ASSERT_EQ(holes.rows.size(), 1U);
  EXPECT_EQ(holes.rows[0].size(), holes.columns.size());
  EXPECT_NE(holes.note.find("The largest 1 of"), std::string::npos);
  const ReportChart chart = deviation_chart(compared.deviation, job.options.deviation);
  ASSERT_EQ(chart.curves.size(), 1U);
  double sum = 0;
  for (const double share : chart.curves[0].y) sum += share;
  EXPECT_NEAR(sum, 100, 1e-9);
  const auto json = summary_of(compared, job);
  EXPECT_NEAR(json["deviation"]["mean_mm"].get<double>(), 0.05, 1e-9);
  EXPECT_EQ(json["completeness"]["holes"].size(), compared.completeness.holes.size());
  EXPECT_EQ(json["options"]["samples"].get<int>(), 4000);
}

}  // namespace
}  // namespace asterism
