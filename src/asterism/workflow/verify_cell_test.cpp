// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/verify_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

Cell small_cell() {
  Cell cell = test_cell();
  cell.timing = {12, 10};
  cell.platform = Platform{};
  cell.noise.sigma_px = 0.015;
  cell.verification.points = {{"tip", Vec3(400, 0, 900)}};
  return cell;
}

VerifyJob quick_job() {
  VerifyJob job;
  job.options.repeats = 2;
  job.options.runs = 60;
  job.options.moments = 2;
  job.options.budget_blocks = 2;
  job.options.faults = job.options.fusion = job.options.speed = false;
  return job;
}

std::string message_of_nothing(const Cell& cell) {
  try {
    static_cast<void>(verify_cell(cell, quick_job(), no_progress));
  } catch (const MeasurementError& error) {
    return error.what();
  }
  return "threw nothing";
}

TEST(VerifyCell, PassesOrFailsByTheToleranceInWords) {
  Cell cell = small_cell();
  const VerifiedCell good = verify_cell(cell, quick_job(), no_progress);
  EXPECT_TRUE(good.verdict.pass);
  EXPECT_TELLS(good.verdict.words, "PASS: at tip the error stays below");
  EXPECT_GT(good.verdict.below_95_mm, 0.02);
  cell.verification.tolerance_mm = 0.01;
  const VerifiedCell bad = verify_cell(cell, quick_job(), no_progress);
  EXPECT_FALSE(bad.verdict.pass);
  EXPECT_TELLS(bad.verdict.words, "FAIL: at tip");
  EXPECT_EQ(good.verdict.below_95_mm, bad.verdict.below_95_mm);
}

TEST(VerifyCell, IsNotFailedByTheLargestOfManyDraws) {
  Cell cell = small_cell();
  VerifyJob job = quick_job();
  job.options.repeats = 12;
  job.options.faults = job.options.fusion = job.options.speed = false;
  const VerifiedCell good = verify_cell(cell, job, no_progress);
  ASSERT_GT(good.verdict.largest_mm, good.verdict.below_95_mm) << "else the tolerance below means nothing";
  cell.verification.tolerance_mm = 0.9999 * good.verdict.largest_mm;
  const VerifiedCell still = verify_cell(cell, job, no_progress);
  EXPECT_GT(still.verdict.beyond, 0);
  EXPECT_LE(still.verdict.beyond, kMayLieBeyond);
  EXPECT_TRUE(still.verdict.pass) << still.verdict.words;
}

TEST(VerifyCell, WritesWholeFilesThatTellTheSame) {
  const TestFolder folder;
  VerifyJob job = quick_job();
  job.out = folder.path();
  const VerifiedCell verified = verify_cell(small_cell(), job, no_progress);
  const Json summary = Json::parse(folder.read("summary.json"));
  EXPECT_EQ(summary["verdict"]["words"], verified.verdict.words);
  EXPECT_EQ(summary["budget"]["shares"].size(), kErrorSources);
  EXPECT_EQ(summary["options"]["runs"], 60);
  const std::string errors = folder.read("errors.csv"), sights = folder.read("sights.csv");
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1 + 12 * 3);
  EXPECT_EQ(std::count(sights.begin(), sights.end(), '\n'), 1 + 12 * 6 * 2);
  EXPECT_TELLS(folder.read("report.html"), "asterism-cell-report");
}

TEST(VerifyCell, ComparesLayoutsRunByRun) {
  Cell cell = small_cell();
  cell.layout = LayoutTask{};
  cell.layout->body = "platform";
  cell.layout->surface.patches.push_back({"room", CylinderRoom{{0, 0, 580}, 350, 40, 0}});
  VerifyJob job = quick_job();
  NamedLayout narrow{"narrow", cell.movers[0].body.targets};
  for (Target& target : narrow.targets) target.position.head<2>() *= 0.4;
  job.layouts = {narrow};
  const VerifiedCell verified = verify_cell(cell, job, no_progress);
  ASSERT_EQ(verified.runs.size(), 2U);
  const LayoutComparison& rotation = verified.comparisons.front();
  EXPECT_LT(rotation.pairs.at(0).all.difference, 0);  // the present layout errs less
  EXPECT_LT(rotation.pairs.at(0).all_p_holm, 0.05);
  const auto tables = tables_of(verified);
  const bool told = std::any_of(tables.begin(), tables.end(), [](const ReportTable& table) {
    return !table.rows.empty() && table.rows[0].back() == ReportTable::Value("as it stands is better");
  });
  EXPECT_TRUE(told);
}

TEST(VerifyCell, SaysWhyTheTrackerSeesNothing) {
  Cell cell = small_cell();
  for (Target& target : cell.movers[0].body.targets) target.normal = Vec3(0, 0, -1);
  const std::string message = message_of_nothing(cell);
  EXPECT_TELLS(message, "the tracker sees nothing: the pose of platform is determined in none of 12 frames");
  EXPECT_TELLS(message, std::string(text_of(SightFailure::TooOblique)) + " 144");
}

TEST(VerifyCell, RefusesLayoutsOfWhatHasNoLayoutTask) {
  VerifyJob job = quick_job();
  job.layouts = {{"other", test_cell().movers[0].body.targets}};
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(verify_cell(small_cell(), job, no_progress)); }),
               "[layout]");
}

TEST(VerifyCell, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto summary = [](int threads) {
    set_thread_count(threads);
    const VerifyJob job = quick_job();
    Json json = summary_of(verify_cell(small_cell(), job, no_progress), job.options);
    set_thread_count(0);
    json.erase("seconds");
    return json.dump();
  };
  EXPECT_EQ(summary(1), summary(4));
}

}  // namespace
}  // namespace asterism
