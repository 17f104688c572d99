// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "asterism/io/mesh_formats.hpp"
#include "asterism/io/mesh_words.hpp"

namespace asterism {
namespace {

/// Names, groups, materials, textures, lines and points: no surface is lost without them.
bool says_nothing_of_the_surface(std::string_view keyword) {
  static const std::set<std::string_view> known = {
      "vt", "vn",  "vp",     "o",      "g",     "s",        "mg",       "usemtl",     "mtllib",   "l",
      "p",  "lod", "usemap", "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
  return known.contains(keyword);
}

/// "7", "7/1", "7//3", "7/1/3"; from 1, or backwards from −1.
std::uint32_t corner_of(const MeshWords& words, std::string_view word, std::size_t vertices) {
  const long long told = words.whole(word.substr(0, word.find('/')));
  if (told == 0) words.refuse("a face has corner 0; corners count from 1, or backwards from -1");
  const long long index = told > 0 ? told - 1 : static_cast<long long>(vertices) + told;
  if (index >= 0 && static_cast<unsigned long long>(index) < vertices)
    return static_cast<std::uint32_t>(index);
  words.refuse(fmt::format("a face has corner {}; {} vertices are told before it", told, vertices));
}

}  // namespace

TriangleMesh mesh_of_obj(std::string_view text, const std::filesystem::path& file) {
  MeshWords words(text, file, '#');
  TriangleMesh mesh;
  std::vector<std::uint32_t> corners;
  while (words.next_line()) {
    const std::string_view keyword = words.word_in_line();
    if (keyword == "v") {
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis) place(axis) = words.number(words.word_in_line());
      mesh.vertices.push_back(place);
    } else if (keyword == "f") {
      corners.clear();
      for (auto word = words.word_in_line(); !word.empty(); word = words.word_in_line()) {
        corners.push_back(corner_of(words, word, mesh.vertices.size()));
      }
      if (corners.size() < 3) {
        words.refuse(fmt::format("a face has {} corners; it must have three or more", corners.size()));
      }
      add_fan(mesh, corners);
    } else if (!says_nothing_of_the_surface(keyword)) {
      words.refuse(fmt::format("`{}` is no keyword of a surface of polygons (v, f)", keyword.substr(0, 40)));
    }
    words.skip_line();
  }
  return mesh;
}

}  // namespace asterism
