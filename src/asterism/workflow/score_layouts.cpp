// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/report/layout_report.hpp"
#include "asterism/report/layout_words.hpp"
#include "asterism/workflow/design_layout.hpp"

namespace asterism {
namespace {

const LayoutTask& task_of(const Cell& cell) {
  if (cell.layout) return *cell.layout;
  throw InputError(
      cell.name.empty() ? "cell" : cell.name,
      "has no [layout] that tells whose targets are to be placed and where; docs/formats.md has its keys");
}

NamedLayout published(const std::string& name, const std::vector<Vec3>& places) {
  NamedLayout layout{name, {}};
  for (const Vec3& place : places) {
    layout.targets.push_back({fmt::format("P{}", layout.targets.size() + 1), place, {}, {}, {}});
  }
  return layout;
}

SummaryRow row_of(const LayoutDesign& design) {
  const auto value = [&](LayoutQuantity quantity) { return text_of_value(design.value_of(quantity)); };
  const std::vector<std::string> broken = broken_constraints(design);
  const bool determined = design.value_of(LayoutQuantity::WorstErrorOneLost).has_value();
  return {design.name, determined ? value(LayoutQuantity::WorstErrorOneLost) : "not determined",
          determined ? "mm" : "",
          fmt::format("worst error after any one loss; identifiability margin {} mm, {} of {} targets always "
                      "visible{}{}",
                      value(LayoutQuantity::Identifiability), value(LayoutQuantity::Visible),
                      design.targets.size(),
                      broken.empty() ? "" : "; breaks: ", fmt::format("{}", fmt::join(broken, "; "))),
          broken.empty() ? Verdict::Good : Verdict::Bad};
}

}  // namespace

NamedLayout present_layout(const Cell& cell) {
  const LayoutTask& task = task_of(cell);
  for (const Mover& mover : cell.movers) {
    if (mover.body.name == task.body) return {"as it stands", mover.body.targets};
  }
  throw InputError(cell.name, fmt::format("has no body `{}`, whose layout its [layout] asks for", task.body));
}

NamedLayout layout_of_file(const Cell& cell, const std::filesystem::path& file) {
  const LayoutTask& task = task_of(cell);
  std::vector<Body> bodies = read_bodies(file);
  const auto found =
      std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) { return body.name == task.body; });
  // layouts/07/bodies.toml is told by its folder.
  const std::filesystem::path named = file.stem() == "bodies" && file.has_parent_path()
                                          ? std::filesystem::absolute(file).parent_path().filename()
                                          : file.stem();
  if (found != bodies.end()) return {named.string(), std::move(found->targets)};
  if (bodies.size() == 1) return {named.string(), std::move(bodies.front().targets)};
  throw InputError(file.string(), fmt::format("has no body `{}`, whose layout is asked for", task.body));
}

std::vector<NamedLayout> published_layouts() {
  std::vector<NamedLayout> layouts;
  for (const auto* table : {&paper_table1(), &paper_table9()}) {
    for (const PublishedLayout& layout : *table) layouts.push_back(published(layout.name, layout.targets));
  }
  return layouts;
}

std::vector<LayoutDesign> score_layouts(const Cell& cell, const std::vector<NamedLayout>& layouts,
                                        const DesignerOptions& options) {
  static_cast<void>(task_of(cell));
  std::vector<LayoutDesign> designs;
  for (const NamedLayout& layout : layouts) {
    LayoutDesign design = evaluate_layout(cell, layout.targets, options);
    design.name = layout.name;
    designs.push_back(std::move(design));
  }
  return designs;
}

void write_scores(const std::filesystem::path& out, const Cell& cell,
                  const std::vector<LayoutDesign>& designs, const DesignerOptions& options) {
  LayoutReport report;
  report.title = fmt::format("Layouts of {}", task_of(cell).body);
  report.subtitle =
      fmt::format("{}: {} layout{} scored", cell.name, designs.size(), designs.size() == 1 ? "" : "s");
  for (const LayoutDesign& design : designs) report.summary.push_back(row_of(design));
  report.cell = cell;
  report.pose_times_s = LayoutModel(cell, options).times_s;
  report.given = designs;
  DesignerOptions shown = options;
  report.options_json = json_of_options(describing(shown)).dump();
  write_layout_report(out / "report.html", report);
}

}  // namespace asterism
