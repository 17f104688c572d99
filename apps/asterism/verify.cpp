// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/verify_cell.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "table_text.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string cell;
  std::vector<std::string> bodies;
  bool published = false;
  std::optional<double> tolerance_mm;
  VerifyJob job;
};

std::string text_of(const VerifiedCell& verified, const VerifyJob& job) {
  std::string text = fmt::format("\n{}, pose of {}: {} frames\n\n  {}\n", verified.cell, verified.body_name,
                                 verified.watched.times_s.size(), verified.verdict.words);
  for (const ReportTable& table : tables_of(verified)) text += text_of_table(table);
  text += "\n  seconds:";
  for (const auto& [stage, seconds] : verified.seconds) text += fmt::format(" {} {:.1f};", stage, seconds);
  text += "\n";
  if (!job.out.empty()) text += fmt::format("\n  report: {}/report.html\n", job.out.string());
  return text;
}

void run(const Call& call, const VerifyOptions& options, const Common& common) {
  Cell cell = cell_for(call.cell);
  if (call.tolerance_mm) cell.verification.tolerance_mm = *call.tolerance_mm;
  VerifyJob job = call.job;
  job.options = options;
  job.seed = common.seed;
  for (const std::string& file : call.bodies) job.layouts.push_back(layout_of_file(cell, file));
  if (call.published) {
    for (NamedLayout& layout : published_layouts()) job.layouts.push_back(std::move(layout));
  }
  const VerifiedCell verified = verify_cell(cell, job, make_progress(common));
  print_result(common, summary_of(verified, options), text_of(verified, job));
}

}  // namespace

void add_verify(CLI::App& root, Common& common) {
  CLI::App* command = add_command(
      root, common, "verify", "A cell in motion: what the tracker will see, and how accurate it will be",
      "asterism verify engine_casing --out out/verify\n"
      "  asterism verify cell.toml --bodies layouts/07/bodies.toml --tolerance-mm 0.1 --runs 20000");
  auto call = std::make_shared<Call>();
  command
      ->add_option("cell", call->cell,
                   fmt::format("cell file, or a built-in cell: {}", fmt::join(builtin_cells(), ", ")))
      ->required();
  command->add_option("--out", call->job.out, "folder for report.html, summary.json, errors.csv, sights.csv");
  command->add_option("--bodies", call->bodies, "bodies files with other layouts of the same body");
  command->add_flag("--published", call->published, "compare with the layouts of the paper's Tables 1 and 9");
  command->add_option("--tolerance-mm", call->tolerance_mm, "largest error allowed, in place of the cell's")
      ->check(CLI::PositiveNumber);
  const auto options = step_options<VerifyOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
