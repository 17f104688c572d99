// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "asterism/core/output_file.hpp"
#include "asterism/io/mesh_bytes.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/mesh_formats.hpp"
#include "asterism/io/mesh_words.hpp"
#include "asterism/io/ply_numbers.hpp"

namespace asterism {
namespace {

void read_row(PlyNumbers& from, const PlyElement& element, std::vector<double>& row,
              std::vector<std::vector<double>>& lists) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.count) {
      row[i] = from.next(property.value);
      continue;
    }
    lists[i].clear();
    for (std::size_t many = from.list_size(property); many > 0; --many)
      lists[i].push_back(from.next(property.value));
  }
}

std::optional<std::size_t> place_of(const PlyElement& element, std::initializer_list<const char*> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    for (const char* name : names) {
      if (element.properties[i].name == name) return i;
    }
  }
  return std::nullopt;
}

void add_vertex(TriangleMesh& mesh, const PlyNumbers& from, const Vec3& place) {
  if (!place.allFinite()) from.refuse("a coordinate is not a finite number");
  mesh.vertices.push_back(place);
}

void add_face(TriangleMesh& mesh, const PlyNumbers& from, const std::vector<double>& list,
              std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  for (const double index : list) {
    if (!(index >= 0) || index >= static_cast<double>(vertices) || index != std::floor(index)) {
      from.refuse(
          fmt::format("a face has corner {}, counted from 0; the file has {} vertices", index, vertices));
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (corners.size() < 3) {
    from.refuse(fmt::format("a face has {} corners; it must have three or more", corners.size()));
  }
  add_fan(mesh, corners);
}

TriangleMesh mesh_from(PlyNumbers from, const PlyHeader& header) {
  std::size_t vertices = 0;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
  }
  TriangleMesh mesh;
  for (const PlyElement& element : header.elements) {
    from.check_count(element);
    const auto x = place_of(element, {"x"}), y = place_of(element, {"y"}), z = place_of(element, {"z"});
    const auto list = place_of(element, {"vertex_indices", "vertex_index"});
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    if (is_vertex && !(x && y && z)) from.refuse("element `vertex` lacks one of x, y, z");
    if (is_face && !(list && element.properties[*list].count)) {
      from.refuse("element `face` has no list `vertex_indices`");
    }
    std::vector<double> row(element.properties.size());
    std::vector<std::vector<double>> lists(element.properties.size());
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      read_row(from, element, row, lists);
      if (is_vertex) add_vertex(mesh, from, {row[*x], row[*y], row[*z]});
      if (is_face) add_face(mesh, from, lists[*list], vertices);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh mesh_of_ply(std::string_view bytes, const std::filesystem::path& file) {
  const PlyHeader header = ply_header_of(bytes, file);
  ByteStream stream(bytes, file);
  stream.take(header.bytes);
  return mesh_from(PlyNumbers(stream, header), header);
}

void write_ply(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) append_number(bytes, vertex(axis));
  }
  for (const auto& triangle : mesh.triangles) {
    append_number(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) append_number(bytes, static_cast<std::int32_t>(corner));
  }
  write_file(file, bytes);
}

}  // namespace asterism
