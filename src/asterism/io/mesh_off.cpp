// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/io/mesh_formats.hpp"
#include "asterism/io/mesh_words.hpp"

namespace asterism {
namespace {

/// Colours, normals and textures stand behind the coordinates of their vertex, in its line.
bool is_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

}  // namespace

TriangleMesh mesh_of_off(std::string_view text, const std::filesystem::path& file) {
  MeshWords words(text, file, '#');
  const std::string_view header = words.word();
  if (!is_header(header)) {
    words.refuse(fmt::format("begins with `{}`; an OFF file begins with OFF, COFF, NOFF or CNOFF",
                             header.substr(0, 40)));
  }
  const bool plain = header == "OFF";
  if (text.substr(0, text.find('\n')).find("BINARY") != std::string_view::npos) {
    words.refuse("is a binary OFF file; save it as text");
  }
  const std::size_t vertices = words.count("vertices", 6);
  const std::size_t faces = words.count("faces", 6);
  static_cast<void>(words.whole());  // edges: nobody counts them

  TriangleMesh mesh;
  mesh.vertices.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) place(axis) = words.number();
    mesh.vertices.push_back(place);
    if (!plain) words.skip_line();
  }
  mesh.triangles.reserve(faces);
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t count = words.count("corners", 2);
    if (count < 3) words.refuse(fmt::format("a face has {} corners; it must have three or more", count));
    corners.clear();
    for (std::size_t k = 0; k < count; ++k) corners.push_back(words.vertex(words.whole(), vertices));
    add_fan(mesh, corners);
    words.skip_line();
  }
  return mesh;
}

}  // namespace asterism
