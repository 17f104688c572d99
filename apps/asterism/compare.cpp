// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/cloud_tables.hpp"
#include "asterism/workflow/compare_cloud.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "table_text.hpp"

namespace asterism::app {
namespace {

struct Call {
  CompareJob job;
  std::string unit, mesh_unit;
  std::optional<double> longest_mm;
};

std::string text_of(const ComparedCloud& compared, const CompareJob& job) {
  std::string text =
      fmt::format("\n{}: {} points against {}\n\n  complete: {:.1f} % of {:.4g} m², {} areas missing\n",
                  job.cloud.string(), compared.points, compared.part, 100 * compared.completeness.share(),
                  1e-6 * compared.completeness.surface_mm2, compared.completeness.holes.size());
  text += text_of_table(deviation_table(compared.deviation, job.options.deviation));
  if (!compared.completeness.holes.empty()) text += text_of_table(hole_table(compared.completeness));
  if (!job.out.empty()) text += fmt::format("\n  cloud with deviations: {}\n", job.out.string());
  if (!job.report.empty()) text += fmt::format("  report: {}\n", job.report.string());
  return text;
}

void run(const Call& call, const CompareOptions& options, const Common& common) {
  CompareJob job = call.job;
  job.options = options;
  job.seed = common.seed;
  job.unit = length_unit_of(call.unit);
  job.mesh_scale.unit = length_unit_of(call.mesh_unit);
  job.mesh_scale.longest_mm = call.longest_mm;
  const ComparedCloud compared = compare_cloud(job, make_progress(common));
  for (const std::string& remark : compared.remarks) print_warning(remark);
  print_result(common, summary_of(compared, job), text_of(compared, job));
}

}  // namespace

void add_compare(CLI::App& root, Common& common) {
  CLI::App* command = add_command(
      root, common, "compare", "A cloud against a surface: how far off, how much of it, what is missing",
      "asterism compare cloud.ply --mesh part.stl --tolerance-mm 0.1 --out cloud_with_deviation.ply\n"
      "  asterism compare cloud.ply --cell turbine_casing --report out/compare.html");
  auto call = std::make_shared<Call>();
  command->add_option("cloud", call->job.cloud, "PLY file; its points stand in the part's frame")->required();
  command->add_option(
      "--cell", call->job.cell,
      fmt::format("cell whose part is the surface: a file, or {}", fmt::join(builtin_cells(), ", ")));
  command->add_option("--mesh", call->job.mesh, "or the surface itself: STL, OBJ, OFF, PLY");
  const std::vector<std::string>& units = length_unit_words();
  command->add_option("--unit", call->unit, "of the cloud's numbers; else mm")->check(CLI::IsMember(units));
  command->add_option("--mesh-unit", call->mesh_unit, "of the mesh's numbers; else mm")
      ->check(CLI::IsMember(units));
  command
      ->add_option("--longest-mm", call->longest_mm, "longest edge of the mesh's box, in place of its unit")
      ->check(CLI::PositiveNumber);
  command->add_flag("--flip", call->job.mesh_scale.flip, "the mesh's triangles face inwards");
  command->add_flag("--without-normals", call->job.without_normals, "pass the cloud's normals over");
  command->add_option("--out", call->job.out,
                      "PLY file: the cloud in mm with a field deviation_mm (it is kept in memory)");
  command->add_option("--report", call->job.report, "HTML file (the cloud is kept in memory)");
  const auto options = step_options<CompareOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
