// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/mesh_bytes.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/mesh_formats.hpp"
#include "asterism/io/mesh_words.hpp"

namespace asterism {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50, kNormal = 12;

void add_corner(TriangleMesh& mesh, const Vec3& place) {
  if (mesh.vertices.size() % 3 == 0) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.vertices.push_back(place);
}

TriangleMesh mesh_of_binary(std::string_view bytes, std::uint32_t count, const std::filesystem::path& file) {
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * static_cast<std::size_t>(count));
  mesh.triangles.reserve(count);
  for (std::size_t at = kHeader; at < bytes.size(); at += kFacet) {
    for (std::size_t number = 0; number < 9; number += 3) {
      Vec3 place;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place(static_cast<int>(axis)) = number_at<float>(bytes.substr(at + kNormal + 4 * (number + axis)));
      }
      if (!place.allFinite()) {
        throw InputError(fmt::format("{}: byte {}", file.string(), at + kNormal + 4 * number),
                         "a coordinate is not a finite number");
      }
      add_corner(mesh, place);
    }
  }
  return mesh;
}

/// Only the corners count; the normals follow from them, and are nonsense in many files.
TriangleMesh mesh_of_text(std::string_view text, const std::filesystem::path& file) {
  MeshWords words(text, file, 0);
  words.skip_line();  // solid NAME
  TriangleMesh mesh;
  bool ended = false;
  std::size_t corners = 0;  // of this facet
  while (words.next_line()) {
    const std::string_view keyword = words.word_in_line();
    if (keyword == "vertex") {
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis) place(axis) = words.number(words.word_in_line());
      add_corner(mesh, place);
      ++corners;
    } else if (keyword == "endloop") {
      if (corners != 3) words.refuse(fmt::format("a facet has {} corners; it must have three", corners));
      corners = 0;
    } else if (keyword == "endsolid" || keyword == "solid") {
      ended = keyword == "endsolid";
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endfacet") {
      words.refuse(fmt::format("`{}` is no word of an STL file", keyword.substr(0, 40)));
    }
    words.skip_line();
  }
  if (!ended || corners != 0) words.refuse("the file ends without `endsolid`: it is cut off");
  return mesh;
}

}  // namespace

TriangleMesh mesh_of_stl(std::string_view bytes, const std::filesystem::path& file) {
  const std::uint32_t count =
      bytes.size() >= kHeader ? number_at<std::uint32_t>(bytes.substr(kHeader - 4)) : 0;
  const std::size_t told = kHeader + kFacet * static_cast<std::size_t>(count);
  if (bytes.size() >= kHeader && bytes.size() == told) return mesh_of_binary(bytes, count, file);
  // Binary files may begin with this word as well, but not with a text after it.
  const std::string_view begin = bytes.substr(0, 1024);
  const bool is_text = begin.starts_with("solid") && begin.find('\0') == std::string_view::npos;
  if (is_text) return mesh_of_text(bytes, file);
  throw InputError(
      file.string(),
      bytes.size() < kHeader
          ? fmt::format("is no STL file: it has {} bytes, a binary one begins with {}", bytes.size(), kHeader)
          : fmt::format("says that it holds {} triangles, which take {} bytes; it has "
                        "{}: it is cut off or damaged",
                        count, told, bytes.size()));
}

void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::string bytes = "binary STL";
  bytes.resize(kHeader - 4, ' ');
  append_number(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  bytes.reserve(kHeader + kFacet * mesh.triangles.size());
  const auto append = [&](const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) append_number(bytes, static_cast<float>(v(axis)));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = area_vector(mesh, t);
    append(normal.norm() > 0 ? normal.normalized() : normal);
    for (int k = 0; k < 3; ++k) append(mesh.corner(t, k));
    append_number(bytes, std::uint16_t{0});
  }
  write_file(file, bytes);
}

}  // namespace asterism
