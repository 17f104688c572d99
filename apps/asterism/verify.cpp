// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include <nlohmann/json.hpp>
#include <optional>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/verify_cell.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string cell;
  std::vector<std::string> bodies;
  bool published = false;
  std::optional<double> tolerance_mm;
  VerifyJob job;
};

std::string text_of(const ReportTable::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.6g}", *number);
  return "–";
}

/// How many columns of a terminal a text takes: bytes that go on a character are none.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return left ? text + space : space + text;
}

std::string text_of(const ReportTable& table) {
  std::vector<std::vector<std::string>> rows = {table.columns};
  for (const auto& row : table.rows) {
    auto& texts = rows.emplace_back();
    for (const ReportTable::Value& value : row) texts.push_back(text_of(value));
  }
  std::string text = "\n" + table.title + "\n";
  for (const auto& row : rows) {
    text += " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, width_of(other[i]));
      text += " " + padded(row[i], width + 1, i == 0);
    }
    text += "\n";
  }
  return text + (table.note.empty() ? "" : "  " + table.note + "\n");
}

std::string text_of(const VerifiedCell& verified, const VerifyJob& job) {
  std::string text = fmt::format("\n{}, pose of {}: {} frames\n\n  {}\n", verified.cell, verified.body_name,
                                 verified.watched.times_s.size(), verified.verdict.words);
  for (const ReportTable& table : tables_of(verified)) text += text_of(table);
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
