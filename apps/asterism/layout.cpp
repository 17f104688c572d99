// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/report/layout_words.hpp"
#include "asterism/workflow/design_layout.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "processes.hpp"
#include "signals.hpp"

namespace asterism::app {
namespace {

using Q = LayoutQuantity;

struct EvaluateCall {
  std::string cell, out;
  std::vector<std::string> bodies;
  bool published = false;
};

struct OptimizeCall {
  std::string cell, mode = "default";
  DesignJob job;
};

/// One line of the table: what counts first.
std::string line_of(const std::string& name, const LayoutDesign& design) {
  const auto value = [&](Q quantity) { return text_of_value(design.value_of(quantity)); };
  return fmt::format("  {:<22} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8} {:>9}", name, design.targets.size(),
                     value(Q::Visible), value(Q::WorstError), value(Q::WorstErrorOneLost),
                     value(Q::Identifiability), value(Q::Spacing), value(Q::Thickness));
}

std::string head() {
  return fmt::format("  {:<22} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8} {:>9}\n", "", "targets", "least", "worst",
                     "after one", "margin", "spacing", "thickness") +
         fmt::format("  {:<22} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8} {:>9}\n", "layout", "", "visible",
                     "error mm", "loss mm", "mm", "mm", "mm");
}

std::string verdict_on(const LayoutDesign& design) {
  std::string text;
  for (const std::string& broken : broken_constraints(design)) text += "      ✗ " + broken + "\n";
  return text;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_warning(warning);
}

void evaluate(const EvaluateCall& call, const DesignerOptions& options, const Common& common) {
  const Cell cell = cell_for(call.cell);
  std::vector<NamedLayout> layouts = {present_layout(cell)};
  for (const std::string& file : call.bodies) layouts.push_back(layout_of_file(cell, file));
  if (call.published) {
    for (NamedLayout& layout : published_layouts()) layouts.push_back(std::move(layout));
  }
  const std::vector<LayoutDesign> designs = score_layouts(cell, layouts, options);
  if (!call.out.empty()) write_scores(call.out, cell, designs, options);

  nlohmann::ordered_json json = {{"cell", cell.name}, {"body", cell.layout->body}};
  std::string text = fmt::format("\n{}, layouts of {}\n\n", cell.name, cell.layout->body) + head();
  for (const LayoutDesign& design : designs) {
    json["layouts"].push_back(json_of_design(design));
    text += line_of(design.name, design) +
            (broken_constraints(design).empty() ? "  holds all\n" : "  breaks\n") + verdict_on(design);
  }
  DesignerOptions shown = options;
  json["options"] = json_of_options(describing(shown));
  if (!call.out.empty()) text += fmt::format("\n  report: {}/report.html\n", call.out);
  print_result(common, json, text);
}

/// Of each number of targets the layout with the least error after a loss, and the knee.
std::vector<std::size_t> rows_to_print(const DesignResult& result) {
  std::map<std::size_t, std::size_t> best;
  const auto error = [&](std::size_t i) {
    return result.front[i].value_of(Q::WorstErrorOneLost).value_or(std::numeric_limits<double>::infinity());
  };
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    const auto [found, added] = best.emplace(result.front[i].targets.size(), i);
    if (!added && error(i) < error(found->second)) found->second = i;
  }
  std::vector<std::size_t> rows;
  for (const auto& [targets, i] : best) rows.push_back(i);
  const auto knee = static_cast<std::size_t>(result.knee);
  if (result.knee >= 0 && std::find(rows.begin(), rows.end(), knee) == rows.end()) rows.push_back(knee);
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::string text_of(const DesignedLayouts& designed, const Cell& cell, const DesignJob& job) {
  const DesignResult& result = designed.result;
  std::string text =
      fmt::format("\n{}, layouts of {}: {} candidates in {:.1f} s, {} on the front\n\n", cell.name,
                  cell.layout->body, designed.evaluations, designed.searching_s, result.front_found) +
      head();
  for (const std::size_t i : rows_to_print(result)) {
    const bool knee = static_cast<int>(i) == result.knee;
    text += line_of(fmt::format("{:02}", i + 1), result.front[i]) + (knee ? "  ← the knee\n" : "\n");
  }
  const auto tell = [&](const LayoutDesign& design) {
    text += line_of(design.name, design) + "\n" + verdict_on(design);
  };
  if (result.present) tell(*result.present);
  for (const LayoutDesign& design : result.published) tell(design);
  if (result.closest) {
    text += line_of("closest to feasible", *result.closest) + "\n" + verdict_on(*result.closest);
  }
  if (!result.why.empty()) text += "\n  " + result.why + "\n";
  return text +
         fmt::format("\n  all {} that are told: {}/report.html\n", result.front.size(), job.out.string());
}

void finish(const DesignedLayouts& designed, const Cell& cell, const DesignJob& job, const Common& common) {
  print_warnings(designed.result.warnings);
  print_result(common, summary_of(designed, cell, job.options), text_of(designed, cell, job));
  if (designed.stopped) {
    print_warning("stopped before its end; the same command with --resume goes on");
    throw Interrupted();
  }
  if (!designed.result.infeasible.empty()) throw MeasurementError(designed.result.infeasible);
}

void optimize(const OptimizeCall& call, const StepOptions& given, const Common& common) {
  DesignJob job = call.job;
  if (call.mode == "deb2002") job.options.optimizer = deb2002();
  given.apply(describing(job.options));
  job.options.optimizer.seed = common.seed;

  Processes processes;
  Cell cell;
  std::optional<LayoutProblem> problem;
  try {
    processes.together([&] {
      cell = cell_for(call.cell);
      problem.emplace(cell, job.options);
    });
  } catch (const Processes::Dismissed&) {
    return;
  }
  if (!processes.leads()) return processes.serve(*problem, job.options.optimizer);
  const auto show = make_search_progress(common);
  const GoOn go_on = [&](const Optimizer& optimizer) {
    show(optimizer);
    return !stop_wanted();
  };
  finish(search_layouts(cell, *problem, job, go_on, processes.workers(*problem, job.options.optimizer)), cell,
         job, common);
}

std::string cell_help() {
  return fmt::format("cell file, or a built-in cell: {}", fmt::join(builtin_cells(), ", "));
}

void add_evaluate_layout(CLI::App& layout, Common& common) {
  CLI::App* command = add_command(layout, common, "evaluate", "Scores the present layout and others",
                                  "asterism layout evaluate engine_casing --published\n"
                                  "  asterism layout evaluate cell.toml --bodies new.toml --out out/scores");
  auto call = std::make_shared<EvaluateCall>();
  command->add_option("cell", call->cell, cell_help())->required();
  command->add_option("--bodies", call->bodies, "bodies files with other layouts of the same body");
  command->add_flag("--published", call->published, "score the layouts of the paper's Tables 1 and 9 too");
  command->add_option("--out", call->out, "folder for report.html");
  const auto options = step_options<DesignerOptions>(*command);
  on_call(*command, common, [=, &common] { evaluate(*call, options(), common); });
}

void add_optimize_layout(CLI::App& layout, Common& common) {
  CLI::App* command =
      add_command(layout, common, "optimize", "Searches for layouts: from a cell to a front of them",
                  "asterism layout optimize engine_casing --out out/layouts\n"
                  "  asterism layout optimize cell.toml --objectives targets,worst-error-1-lost "
                  "--constraints 'identifiability >= 3' --out out/layouts\n"
                  "  mpirun -np 4 asterism layout optimize cell.toml --islands 4 --out out/layouts");
  auto call = std::make_shared<OptimizeCall>();
  command->add_option("cell", call->cell, cell_help())->required();
  command->add_option("--out", call->job.out, "folder for the results")->required();
  command->add_flag("--resume", call->job.resume, "go on from the checkpoint in --out");
  command
      ->add_option("--checkpoint-seconds", call->job.checkpoint_seconds, "between two; 0 = each generation")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--mode", call->mode,
                   "deb2002: NSGA-II as published, without the archive; options given beside it go before")
      ->check(CLI::IsMember({"default", "deb2002"}))
      ->capture_default_str();
  const StepOptions options(*command, describing(call->job.options));
  on_call(*command, common, [=, &common] { optimize(*call, options, common); });
}

}  // namespace

void add_layout(CLI::App& root, Common& common) {
  CLI::App* layout = root.add_subcommand(
      "layout", "Where to put the targets: scores layouts, finds new ones, suggests what to change next");
  layout->footer(
      "Example:\n  asterism layout optimize engine_casing --out out/layouts\n"
      "`asterism layout evaluate --help`, `… optimize --help` and `… suggest --help` show their options.");
  layout->require_subcommand(1);
  add_evaluate_layout(*layout, common);
  add_optimize_layout(*layout, common);
  add_suggest_layout(*layout, common);
}

}  // namespace asterism::app
