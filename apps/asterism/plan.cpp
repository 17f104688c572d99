// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/plan_scans.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string cell, out, complete;
};

void run(const Call& call, const PlanOptions& options, const Common& common) {
  PlanJob job;
  job.out = call.out;
  job.complete = call.complete;
  job.options = options;
  job.seed = common.seed;
  const ScanPlan plan = plan_cell(cell_for(call.cell), job, make_progress(common));
  std::string text = text_of(plan);
  if (!call.out.empty()) text += fmt::format("\n  plan: {}\n", call.out);
  print_result(common, summary_of(plan), text);
}

}  // namespace

void add_plan(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "plan", "From where to scan a part, and how to turn the platform for it",
                  "asterism plan engine_casing --out plan.json\n"
                  "  asterism plan cell.toml --out rescan.json --complete cloud.ply --platform-steps 5");
  auto call = std::make_shared<Call>();
  command
      ->add_option("cell", call->cell,
                   fmt::format("cell file, or a built-in cell: {}", fmt::join(builtin_cells(), ", ")))
      ->required();
  command->add_option("--out", call->out, "file for the plan (JSON)");
  command->add_option("--complete", call->complete,
                      "a cloud (PLY) in the workpiece's frame: only what it does not measure is planned");
  const auto options = step_options<PlanOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
