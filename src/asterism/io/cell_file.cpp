// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_file.hpp"

#include <fmt/format.h>

#include "asterism/core/result.hpp"
#include "asterism/io/builtin_cells.hpp"
#include "asterism/io/cell_layout.hpp"
#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_scan.hpp"
#include "asterism/io/cell_tables.hpp"

namespace asterism {
namespace {

template <class Options>
void read_part(const CellSection& root, const char* key, const Form& form, Options& options) {
  if (!root.has(key)) return;
  const CellSection section = root.section(key, form.of);
  section.must_be(form);
  read_options_of(section, describing_options(options));
}

void read_solids(const CellSection& root, const Places& places, Cell& cell) {
  for (const CellSection& one : root.sections("obstacle", "an obstacle"))
    cell.obstacles.push_back(obstacle_of(one, places));
  if (root.has("workpiece")) {
    const std::string platform = cell.platform ? cell.platform->body : "";
    cell.workpiece = workpiece_of(root.section("workpiece", "[workpiece]"), platform, places);
  }
  for (const CellSection& one : root.sections("fixture", "a fixture"))
    cell.fixtures.push_back(fixture_of(one, places));
}

Cell cell_of_toml(const std::filesystem::path& file, const toml::table& table) {
  const CellSection root{file, table, "a cell"};
  root.must_be(forms::cell());
  Cell cell;
  cell.name = root.has("name") ? root.text("name") : file.stem().string();
  const CellSection tracker = root.section("tracker", "[tracker]");
  cell.rig = rig_of_section(tracker);
  if (tracker.has("volume")) cell.volume = working_volume_of(tracker.section("volume", "[tracker.volume]"));
  Places places{cell.rig, {}};
  for (const CellSection& body : root.sections("body", "a body"))
    cell.movers.push_back(mover_of(body, places));
  if (root.has("platform")) cell.platform = platform_of(root.section("platform", "[platform]"));
  read_solids(root, places, cell);
  if (root.has("scanner")) cell.scanner = scanner_of(root.section("scanner", "[scanner]"));
  if (root.has("scan")) cell.scan_task = scan_task_of(root.section("scan", "[scan]"));
  if (root.has("robot")) cell.robot = robot_of(root.section("robot", "[robot]"), places);
  for (const CellSection& one : root.sections("scan_pass", "a scan pass"))
    cell.passes.push_back(scan_pass_of(one));
  read_part(root, "sensor", forms::sensor(), cell.sensor);
  read_part(root, "light", forms::light(), cell.light);
  read_part(root, "timing", forms::timing(), cell.timing);
  read_part(root, "noise", forms::noise(), cell.noise);
  for (const CellSection& one : root.sections("fault", "a fault")) cell.faults.push_back(fault_of(one));
  for (const CellSection& one : root.sections("lamp", "a lamp")) cell.lamps.push_back(lamp_of(one));
  if (root.has("verify")) cell.verification = verification_of(root.section("verify", "[verify]"));
  if (root.has("layout")) cell.layout = layout_task_of(root.section("layout", "[layout]"));
  check_cell(cell, file.string());
  return cell;
}

}  // namespace

Cell read_cell(const std::filesystem::path& file) { return cell_of_toml(file, parse_toml(file)); }

std::vector<std::string> builtin_cells() {
  std::vector<std::string> names;
  for (const BuiltinCell& cell : builtin_cell_texts()) names.emplace_back(cell.name);
  return names;
}

Cell cell_of(const std::string& name_or_file) {
  for (const BuiltinCell& cell : builtin_cell_texts()) {
    if (cell.name == name_or_file) return cell_of_toml(name_or_file, toml::parse(cell.toml));
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw InputError(name_or_file, fmt::format("is neither a file nor a built-in cell; built in are: {}",
                                               fmt::join(builtin_cells(), ", ")));
  }
  return read_cell(name_or_file);
}

}  // namespace asterism
