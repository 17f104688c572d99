// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/body_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/toml_file.hpp"

namespace asterism {
namespace {

/// Normals written with few digits are off by 1e-4 or so: made exact here, refused by check_bodies beyond.
Vec3 nearly_unit(const Vec3& normal) {
  return std::abs(normal.norm() - 1.0) < 1e-3 ? normal.normalized() : normal;
}

Mat3 covariance_of(const std::filesystem::path& file, const toml::node& node) {
  const auto c = toml_numbers(file, node, "covariance_mm2", 6);
  Mat3 covariance;
  covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  const double least = covariance.allFinite() ? symmetric_eigen(covariance).values(0) : -1;
  if (!(least >= -1e-9 * covariance.trace())) {
    throw InputError(toml_place(file, node),
                     "`covariance_mm2` (xx xy xz yy yz zz) is no covariance: it has a negative "
                     "eigenvalue");
  }
  return covariance;
}

Target target_of(const std::filesystem::path& file, const toml::table& table) {
  refuse_unknown_keys(file, table, "a target",
                      {"id", "position_mm", "normal", "diameter_mm", "covariance_mm2"});
  const auto needed = [&](const char* key) -> const toml::node& {
    if (const toml::node* node = table.get(key)) return *node;
    throw InputError(toml_place(file, table), fmt::format("a target has no `{}`", key));
  };
  const auto vector_of = [&](const toml::node& node, const char* key) {
    const auto numbers = toml_numbers(file, node, key, 3);
    return Vec3(numbers[0], numbers[1], numbers[2]);
  };
  Target target;
  target.id = toml_text(file, needed("id"), "id");
  target.position = vector_of(needed("position_mm"), "position_mm");
  if (const auto* node = table.get("normal")) target.normal = nearly_unit(vector_of(*node, "normal"));
  if (const auto* node = table.get("diameter_mm"))
    target.diameter_mm = toml_number(file, *node, "diameter_mm");
  if (const auto* node = table.get("covariance_mm2")) target.covariance = covariance_of(file, *node);
  return target;
}

/// The tables of an array of tables; empty when the key is not there.
std::vector<const toml::table*> tables_of(const std::filesystem::path& file, const toml::table& table,
                                          const std::string& key) {
  std::vector<const toml::table*> tables;
  const toml::node* node = table.get(key);
  if (node == nullptr) return tables;
  const toml::array* array = node->as_array();
  if (array != nullptr) {
    for (const toml::node& element : *array) tables.push_back(element.as_table());
  }
  if (array == nullptr || std::count(tables.begin(), tables.end(), nullptr) > 0) {
    throw InputError(toml_place(file, *node), fmt::format("`{}` must be tables, each begun by [[{}]]", key,
                                                          key == "target" ? "body.target" : key));
  }
  return tables;
}

std::vector<Body> bodies_of_toml(const std::filesystem::path& file) {
  const toml::table root = parse_toml(file);
  refuse_unknown_keys(file, root, "a bodies file", {"body"});
  std::vector<Body> bodies;
  for (const toml::table* table : tables_of(file, root, "body")) {
    refuse_unknown_keys(file, *table, "a body", {"name", "target"});
    const toml::node* name = table->get("name");
    if (name == nullptr) throw InputError(toml_place(file, *table), "a body has no `name`");
    Body& body = bodies.emplace_back(Body{toml_text(file, *name, "name"), {}});
    for (const toml::table* target : tables_of(file, *table, "target")) {
      body.targets.push_back(target_of(file, *target));
    }
  }
  return bodies;
}

std::vector<Body> bodies_of_csv(const std::filesystem::path& file) {
  const CsvTable table(file, {"body", "id", "x_mm", "y_mm", "z_mm"});
  std::vector<Body> bodies;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& name = table.text(row, "body");
    if (name.empty()) table.refuse(row, "body", "is empty; a name is needed");
    auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const Body& other) { return other.name == name; });
    if (body == bodies.end()) body = bodies.insert(bodies.end(), Body{name, {}});
    Target target;
    target.id = table.text(row, "id");
    target.position = {table.number(row, "x_mm"), table.number(row, "y_mm"), table.number(row, "z_mm")};
    if (table.optional_number(row, "nx")) {
      target.normal =
          nearly_unit({table.number(row, "nx"), table.number(row, "ny"), table.number(row, "nz")});
    }
    target.diameter_mm = table.optional_number(row, "diameter_mm");
    body->targets.push_back(std::move(target));
  }
  return bodies;
}

/// NDI's tool definition: the number of markers at byte 28, their places as float32 triples from byte 72.
std::vector<Body> bodies_of_rom(const std::filesystem::path& file, const std::string& bytes) {
  constexpr std::size_t kCountAt = 28;
  constexpr std::size_t kPlacesAt = 72;
  constexpr std::uint32_t kMostMarkers = 20;
  static_assert(std::endian::native == std::endian::little, "the file's numbers are little-endian");
  std::uint32_t count = 0;
  if (bytes.size() >= kPlacesAt) std::memcpy(&count, bytes.data() + kCountAt, 4);
  if (count < 1 || count > kMostMarkers || bytes.size() < kPlacesAt + 12 * std::size_t{count}) {
    throw InputError(file.string(),
                     "is no whole NDI tool file: it must name 1 to 20 markers and hold their places");
  }
  Body body{file.stem().string(), {}};
  for (std::size_t marker = 0; marker < count; ++marker) {
    Eigen::Vector3f place;
    std::memcpy(place.data(), bytes.data() + kPlacesAt + 12 * marker, 12);
    body.targets.push_back({fmt::format("M{}", marker + 1), place.cast<double>(), {}, {}, {}});
  }
  return {body};
}

std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::vector<Body> read_bodies(const std::filesystem::path& file) {
  std::vector<Body> bodies;
  if (const std::string bytes = read_file(file); bytes.starts_with("NDI")) {
    bodies = bodies_of_rom(file, bytes);
  } else if (file.extension() == ".rom") {
    throw InputError(file.string(), "is no NDI tool file: it does not begin with `NDI`");
  } else {
    bodies = file.extension() == ".csv" ? bodies_of_csv(file) : bodies_of_toml(file);
  }
  if (bodies.empty()) throw InputError(file.string(), "holds no body; each begins with [[body]]");
  check_bodies(bodies, file.string());
  return bodies;
}

void write_bodies(const std::filesystem::path& file, const std::vector<Body>& bodies) {
  check_bodies(bodies, file.string());
  std::string text;
  for (const Body& body : bodies) {
    text += fmt::format("{}[[body]]\nname = {}\n", text.empty() ? "" : "\n", toml_string(body.name));
    for (const Target& target : body.targets) {
      const Vec3& p = target.position;
      text += fmt::format("[[body.target]]\nid = {}\nposition_mm = [{:.6f}, {:.6f}, {:.6f}]\n",
                          toml_string(target.id), p.x(), p.y(), p.z());
      if (const auto& n = target.normal)
        text += fmt::format("normal = [{:.9f}, {:.9f}, {:.9f}]\n", n->x(), n->y(), n->z());
      if (target.diameter_mm) text += fmt::format("diameter_mm = {:.6g}\n", *target.diameter_mm);
      if (const auto& c = target.covariance) {
        text += fmt::format("covariance_mm2 = [{:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}]\n", (*c)(0, 0),
                            (*c)(0, 1), (*c)(0, 2), (*c)(1, 1), (*c)(1, 2), (*c)(2, 2));
      }
    }
  }
  write_file(file, text);
}

}  // namespace asterism
