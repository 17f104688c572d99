// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/mesh_scale.hpp"

namespace asterism {
namespace {

/// Folders beside which, after the cell's own, meshes are sought: ASTERISM_DATA_PATH (joined by colons), and
/// where tools/setup puts what Debian has.
std::vector<std::filesystem::path> data_folders() {
  std::vector<std::filesystem::path> folders;
  const char* told = std::getenv("ASTERISM_DATA_PATH");
  std::istringstream list(told == nullptr ? "" : told);
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "data/meshes");
  folders.emplace_back("build/data/meshes");
  return folders;
}

std::filesystem::path mesh_place(const CellSection& section) {
  const std::string name = section.text("mesh");
  std::vector<std::filesystem::path> folders = {section.file.parent_path()};
  for (std::filesystem::path& folder : data_folders()) folders.push_back(std::move(folder));
  for (const std::filesystem::path& folder : folders) {
    if (std::filesystem::is_regular_file(folder / name)) return folder / name;
  }
  const char* hint = name == "turbine.off"
                         ? "; it is of Debian's libcgal-demo, and `tools/setup test` fetches it"
                         : "; it is sought beside the cell and in ASTERISM_DATA_PATH";
  throw InputError(toml_place(section.file, section.needed("mesh")),
                   fmt::format("mesh `{}` is not there{}", name, hint));
}

TriangleMesh mesh_of_file(const CellSection& section) {
  MeshScale scale;
  const std::vector<std::string>& words = length_unit_words();
  if (section.has("unit")) {
    const auto unit = std::find(words.begin(), words.end(), section.text("unit"));
    scale.unit = static_cast<LengthUnit>(unit - words.begin());
  }
  if (section.has("longest_mm")) scale.longest_mm = section.number("longest_mm");
  if (section.has("flip")) scale.flip = section.flag("flip");
  const std::filesystem::path file = mesh_place(section);
  const std::string where =
      fmt::format("{}: {}", toml_place(section.file, section.needed("mesh")), file.string());
  return checked_mesh(read_mesh(file), scale, where);
}

TriangleMesh casing_of(const CellSection& section) {
  section.must_be(forms::casing());
  CasingShape casing;
  read_options_of(section, describing_options(casing));
  if (casing.wall_mm >= std::min(casing.bottom_radius_mm, casing.top_radius_mm)) {
    section.refuse(fmt::format("`wall_mm` is {}; it must be less than the smaller radius", casing.wall_mm));
  }
  if (2 * casing.flange_height_mm >= casing.height_mm) {
    section.refuse(fmt::format("`flange_height_mm` is {}; two flanges must be lower than the casing's {} mm",
                               casing.flange_height_mm, casing.height_mm));
  }
  return mesh_of(casing);
}

/// All but name and surface; carried by `body` unless told otherwise.
Solid carried_solid(const CellSection& section, const std::string& body, const Places& places) {
  Solid solid;
  solid.body = section.has("body") ? section.text("body") : body;
  solid.carrier_from_solid = pose_on(solid.body, section, places);
  if (section.has("level")) solid.level = section.number("level");
  return solid;
}

std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace

Obstacle obstacle_of(const CellSection& section, const Places& places) {
  Obstacle obstacle;
  obstacle.shape = shape_of(section, forms::obstacle());
  obstacle.name = section.text("name");
  if (section.has("body")) obstacle.body = section.text("body");
  obstacle.carrier_from_shape = pose_on(obstacle.body, section, places);
  if (section.has("level")) obstacle.level = section.number("level");
  return obstacle;
}

Solid workpiece_of(const CellSection& section, const std::string& platform, const Places& places) {
  section.only_keys_of({forms::workpiece_by_mesh(), forms::workpiece_by_casing()});
  const bool from_file = section.has("mesh");
  if (!from_file && !section.has("casing")) {
    section.refuse("[workpiece] needs a surface: `mesh`, a file, or [workpiece.casing]");
  }
  section.must_be(from_file ? forms::workpiece_by_mesh() : forms::workpiece_by_casing());
  Solid solid = carried_solid(section, platform, places);
  solid.name = section.has("name") ? section.text("name") : "workpiece";
  solid.surface =
      shared(from_file ? mesh_of_file(section) : casing_of(section.section("casing", "a casing")));
  return solid;
}

Solid fixture_of(const CellSection& section, const Places& places) {
  TriangleMesh surface;
  if (section.has("mesh")) {
    section.must_be(forms::fixture_by_mesh());
    surface = mesh_of_file(section);
  } else if (section.has("casing")) {
    section.must_be(forms::fixture_by_casing());
    surface = casing_of(section.section("casing", "a casing"));
  } else {
    if (!section.has("shape")) {
      section.refuse(
          "a fixture needs a surface: `mesh`, a file, [fixture.casing], or a `shape` as in [[obstacle]]");
    }
    const Shape shape = shape_of(section, forms::fixture());
    if (!has_extent(shape)) section.refuse("its sizes must be positive");
    surface = mesh_of(shape);
  }
  Solid solid = carried_solid(section, "", places);
  solid.name = section.text("name");
  solid.surface = shared(std::move(surface));
  return solid;
}

}  // namespace asterism
