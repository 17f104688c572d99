// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/workflow/fuse_scans.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  FuseScansJob job;
  std::string unit = "mm", poses_unit = "mm", mesh_unit;
  std::optional<double> longest_mm;
};

void run(const Call& call, const FuseScansOptions& options, const Common& common) {
  FuseScansJob job = call.job;
  job.options = options;
  job.seed = common.seed;
  job.scans_mm_each = mm_of(length_unit_of(call.unit).value());
  job.poses_mm_each = mm_of(length_unit_of(call.poses_unit).value());
  job.mesh_scale.longest_mm = call.longest_mm;
  job.mesh_scale.unit = length_unit_of(call.mesh_unit);
  const FusedScans fused = fuse_scans(job, make_progress(common));
  for (const std::string& remark : fused.remarks) print_warning(remark);
  print_result(common, summary_of(fused, job), text_of(fused));
}

}  // namespace

void add_fuse(CLI::App& root, Common& common) {
  CLI::App* command = add_command(
      root, common, "fuse", "Scans and tracked poses: one cloud with an uncertainty at each point",
      "asterism fuse recording --out out/cloud.ply --report\n"
      "  asterism fuse scan rescan --out out/cloud.ply\n"
      "  asterism fuse scans --poses poses.csv --unit m --out cloud.ply --mesh part.stl --mesh-unit mm");
  auto call = std::make_shared<Call>();
  command
      ->add_option("scans", call->job.scans, "folders with scans.csv, the scans, and poses: all in one cloud")
      ->required();
  command->add_option("--out", call->job.out, "PLY file; fusion.json comes beside it")->required();
  command->add_option("--cell", call->job.cell,
                      "cell that tells the scanner, the part and its place; else cell.toml in the folder");
  command->add_option("--poses", call->job.poses,
                      "poses CSV, where it is neither track/poses.csv nor poses.csv");
  command->add_option("--reference", call->job.reference,
                      "body that carries the part; else the cell's platform");
  command->add_option(
      "--hand-eye", call->job.hand_eye,
      "where the scanner sits in its body, as `asterism hand-eye` tells; else as the cell says");
  command->add_option("--alignment", call->job.alignment, "where the part sits, as `asterism align` tells");
  const std::vector<std::string>& units = length_unit_words();
  command->add_option("--unit", call->unit, "of the scans' numbers")
      ->check(CLI::IsMember(units))
      ->capture_default_str();
  command
      ->add_option("--poses-unit", call->poses_unit,
                   "of the poses' lengths, if it is not that of their columns")
      ->check(CLI::IsMember(units))
      ->capture_default_str();
  command->add_option("--mesh", call->job.mesh, "the part's surface: STL, OBJ, OFF, PLY; else the cell's");
  command->add_option("--mesh-unit", call->mesh_unit, "of the mesh's numbers")->check(CLI::IsMember(units));
  command
      ->add_option("--longest-mm", call->longest_mm, "longest edge of the mesh's box, in place of its unit")
      ->check(CLI::PositiveNumber);
  command->add_flag("--flip", call->job.mesh_scale.flip, "the mesh's triangles face inwards");
  command->add_flag("--refine", call->job.refine,
                    "correct poses by the scans' shape, weighed against the tracker");
  command->add_flag("--report", call->job.report, "report.html beside the cloud");
  const auto options = step_options<FuseScansOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
