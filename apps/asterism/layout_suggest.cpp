// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/observe_layout.hpp"
#include "asterism/workflow/suggest_layout.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string subject, cell, body, out;
};

/// A folder is a recording; its own cell.toml, where it was simulated, says where targets may stand.
SuggestionSubject subject_of(const Call& call, SuggestOptions& options, const Common& common) {
  SuggestionSubject subject;
  if (!std::filesystem::is_directory(call.subject)) {
    if (!call.cell.empty()) {
      throw InputError("--cell",
                       fmt::format("`{}` is no recording's folder but a cell itself", call.subject));
    }
    subject.cell = cell_for(call.subject);
    if (!call.body.empty() && subject.cell.layout && subject.cell.layout->body != call.body) {
      throw InputError("--body", fmt::format("the cell's layout task is of `{}`", subject.cell.layout->body));
    }
    return subject;
  }
  const std::filesystem::path own = std::filesystem::path(call.subject) / "cell.toml";
  std::optional<Cell> cell;
  if (!call.cell.empty()) {
    cell = cell_for(call.cell);
  } else if (std::filesystem::exists(own)) {
    cell = read_cell(own);
  }
  ObserveJob job;
  job.body = call.body;
  return observe_layout(open_recording(call.subject), cell, job, options, make_progress(common));
}

void run(const Call& call, SuggestOptions options, const Common& common) {
  const SuggestionSubject subject = subject_of(call, options, common);
  const SuggestedChange suggested = suggest_layout(subject, options);
  for (const std::string& warning : suggested.warnings) print_warning(warning);
  if (!call.out.empty()) write_suggestion(call.out, suggested, options);
  print_result(common, json_of(suggested, options),
               text_of(suggested, static_cast<std::size_t>(options.alternatives)));
  if (suggested.suggestion.stuck) throw MeasurementError(suggested.verdict);
}

}  // namespace

void add_suggest_layout(CLI::App& layout, Common& common) {
  CLI::App* command =
      add_command(layout, common, "suggest", "Which single target to move, add or take away next",
                  "asterism layout suggest RECORDING --cell cell.toml --out out/next\n"
                  "  asterism layout suggest engine_casing --kinds move");
  auto call = std::make_shared<Call>();
  command
      ->add_option("subject", call->subject,
                   fmt::format("cell file, built-in cell ({}), or a recording's folder",
                               fmt::join(builtin_cells(), ", ")))
      ->required();
  command->add_option("--cell", call->cell,
                      "where targets of a recording may stand; else its own cell.toml, where it has one");
  command->add_option("--body", call->body, "whose targets; else those of the cell's layout task");
  command->add_option("--out", call->out, "folder for bodies.toml after the change and suggestion.json");
  const auto options = step_options<SuggestOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
