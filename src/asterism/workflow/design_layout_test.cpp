// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/design_layout.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/cell_file.hpp"

namespace asterism {
namespace {

Cell quick_cell() {
  Cell cell = cell_of("engine_casing");
  cell.layout->poses = 20;
  return cell;
}

DesignJob quick_job(const TestFolder& folder) {
  DesignJob job;
  job.out = folder.path();
  job.options.places = 60;
  job.options.optimizer.population = 20;
  job.options.optimizer.generations = 4;
  return job;
}

bool always(const Optimizer& /*optimizer*/) { return true; }

TEST(LayoutOfFile, IsNamedByItsFileOrItsFolder) {
  const TestFolder folder;
  const Cell cell = quick_cell();
  write_bodies(folder / "07/bodies.toml", bodies_of(cell));
  write_bodies(folder / "new feet.toml", {bodies_of(cell)[0]});
  EXPECT_EQ(layout_of_file(cell, folder / "07/bodies.toml").name, "07");
  EXPECT_EQ(layout_of_file(cell, folder / "new feet.toml").name, "new feet");
  EXPECT_EQ(layout_of_file(cell, folder / "07/bodies.toml").targets.size(), 6U);
}

TEST(LayoutOfFile, SaysWhichBodyIsMissing) {
  const TestFolder folder;
  Cell cell = quick_cell();
  write_bodies(folder / "bodies.toml", bodies_of(cell));
  cell.layout->body = "table";
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(layout_of_file(cell, folder / "bodies.toml")); }),
               "bodies.toml: has no body `table`");
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(present_layout(cell)); }), "has no body `table`");
  cell.layout.reset();
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(present_layout(cell)); }), "has no [layout]");
}

TEST(ScoreLayouts, GivesEachItsNameAndTheSameAsASearchGives) {
  const Cell cell = quick_cell();
  const auto designs = score_layouts(cell, {present_layout(cell), published_layouts()[2]}, {});
  ASSERT_EQ(designs.size(), 2U);
  EXPECT_EQ(designs[0].name, "as it stands");
  // The built-in cell carries scheme S3 of Table 1.
  EXPECT_NEAR(*designs[0].value_of(LayoutQuantity::Spacing), *designs[1].value_of(LayoutQuantity::Spacing),
              1e-9);
}

TEST(SearchLayouts, StopsWhereItIsToldAndGoesOnToTheSameFront) {
  const TestFolder folder, other;
  const Cell cell = quick_cell();
  DesignJob job = quick_job(folder);
  const LayoutProblem problem(cell, job.options);
  const DesignedLayouts whole = search_layouts(cell, problem, job, always);
  EXPECT_FALSE(whole.stopped);
  EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));

  job.out = other.path();
  const DesignedLayouts part = search_layouts(cell, problem, job, [](const Optimizer& optimizer) {
    return optimizer.history().empty() || optimizer.history().back().generation < 2;
  });
  EXPECT_TRUE(part.stopped);
  EXPECT_EQ(summary_of(part, cell, job.options)["ended"], "stopped");
  EXPECT_TELLS(other.read("report.html"), "can be resumed");
  job.resume = true;
  const DesignedLayouts rest = search_layouts(cell, problem, job, always);
  EXPECT_EQ(rest.result.front_checksum, whole.result.front_checksum);
  EXPECT_EQ(rest.evaluations, whole.evaluations);
  EXPECT_EQ(other.read("front.csv"), folder.read("front.csv"));
}

}  // namespace
}  // namespace asterism
