// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/ply_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "asterism/io/mesh_bytes.hpp"
#include "asterism/io/mesh_words.hpp"

namespace asterism {
namespace {

PlyNumber number_named(const MeshWords& words, std::string_view name) {
  constexpr std::array<std::string_view, 8> old = {"char", "uchar", "short", "ushort",
                                                   "int",  "uint",  "float", "double"};
  constexpr std::array<std::string_view, 8> sized = {"int8",  "uint8",  "int16",   "uint16",
                                                     "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (name == old[i] || name == sized[i]) return static_cast<PlyNumber>(i);
  }
  words.refuse(
      fmt::format("`{}` is no type of PLY; known are: {}", name.substr(0, 40), fmt::join(old, ", ")));
}

PlyEncoding encoding_named(const MeshWords& words, std::string_view name) {
  if (name == "ascii") return PlyEncoding::Text;
  if (name == "binary_little_endian") return PlyEncoding::Little;
  if (name == "binary_big_endian") return PlyEncoding::Big;
  words.refuse(
      fmt::format("`{}` is no format of PLY; known are: ascii, binary_little_endian, binary_big_endian",
                  name.substr(0, 40)));
}

PlyProperty property_of(MeshWords& words) {
  PlyProperty property;
  std::string_view type = words.word_in_line();
  if (type == "list") {
    property.count = number_named(words, words.word_in_line());
    type = words.word_in_line();
  }
  property.value = number_named(words, type);
  property.name = words.word_in_line();
  return property;
}

}  // namespace

std::size_t size_of(PlyNumber number) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes.at(static_cast<std::size_t>(number));
}

double number_of(PlyNumber type, std::string_view bytes, std::endian order) {
  switch (type) {
    case PlyNumber::Int8:
      return number_at<std::int8_t>(bytes, order);
    case PlyNumber::Uint8:
      return number_at<std::uint8_t>(bytes, order);
    case PlyNumber::Int16:
      return number_at<std::int16_t>(bytes, order);
    case PlyNumber::Uint16:
      return number_at<std::uint16_t>(bytes, order);
    case PlyNumber::Int32:
      return number_at<std::int32_t>(bytes, order);
    case PlyNumber::Uint32:
      return number_at<std::uint32_t>(bytes, order);
    case PlyNumber::Float32:
      return number_at<float>(bytes, order);
    case PlyNumber::Float64:
      break;
  }
  return number_at<double>(bytes, order);
}

PlyHeader ply_header_of(std::string_view bytes, const std::filesystem::path& file) {
  const std::size_t end = bytes.find("end_header");
  MeshWords words(bytes.substr(0, std::min(end, bytes.size())), file, 0);
  if (!bytes.starts_with("ply")) words.refuse("does not begin with `ply`, as a PLY file does");
  if (end == std::string_view::npos) words.refuse("has no `end_header`: it is cut off or no PLY file");
  PlyHeader header;
  words.skip_line();
  while (words.next_line()) {
    const std::string_view keyword = words.word_in_line();
    if (keyword == "format") {
      header.encoding = encoding_named(words, words.word_in_line());
    } else if (keyword == "element") {
      const std::string name(words.word_in_line());
      const long long count = words.whole(words.word_in_line());
      if (count < 0) words.refuse(fmt::format("says that it holds {} of element `{}`", count, name));
      header.elements.push_back({name, static_cast<std::size_t>(count), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) words.refuse("a property stands before every element");
      header.elements.back().properties.push_back(property_of(words));
    } else if (keyword != "comment" && keyword != "obj_info") {
      words.refuse(fmt::format("`{}` is no keyword of a PLY header", keyword.substr(0, 40)));
    }
    words.skip_line();
  }
  const std::size_t line_end = bytes.find('\n', end);
  header.bytes = line_end == std::string_view::npos ? bytes.size() : line_end + 1;
  header.lines = words.line();
  return header;
}

}  // namespace asterism
