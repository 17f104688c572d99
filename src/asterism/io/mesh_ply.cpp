// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/mesh_bytes.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/mesh_formats.hpp"
#include "asterism/io/mesh_words.hpp"

namespace asterism {
namespace {

enum class Number { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::size_t size_of(Number number) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes.at(static_cast<std::size_t>(number));
}

struct Property {
  std::string name;
  Number value = Number::Float32;
  std::optional<Number> count;  // of a list: the type of how many follow
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { Text, Little, Big };

struct Header {
  Encoding encoding = Encoding::Text;
  std::vector<Element> elements;
  std::size_t bytes = 0, lines = 0;  // that it takes
};

Number number_named(const MeshWords& words, std::string_view name) {
  constexpr std::array<std::string_view, 8> old = {"char", "uchar", "short", "ushort",
                                                   "int",  "uint",  "float", "double"};
  constexpr std::array<std::string_view, 8> sized = {"int8",  "uint8",  "int16",   "uint16",
                                                     "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (name == old[i] || name == sized[i]) return static_cast<Number>(i);
  }
  words.refuse(
      fmt::format("`{}` is no type of PLY; known are: {}", name.substr(0, 40), fmt::join(old, ", ")));
}

Encoding encoding_named(const MeshWords& words, std::string_view name) {
  if (name == "ascii") return Encoding::Text;
  if (name == "binary_little_endian") return Encoding::Little;
  if (name == "binary_big_endian") return Encoding::Big;
  words.refuse(
      fmt::format("`{}` is no format of PLY; known are: ascii, binary_little_endian, binary_big_endian",
                  name.substr(0, 40)));
}

Property property_of(MeshWords& words) {
  Property property;
  std::string_view type = words.word_in_line();
  if (type == "list") {
    property.count = number_named(words, words.word_in_line());
    type = words.word_in_line();
  }
  property.value = number_named(words, type);
  property.name = words.word_in_line();
  return property;
}

Header header_of(std::string_view bytes, const std::filesystem::path& file) {
  const std::size_t end = bytes.find("end_header");
  MeshWords words(bytes.substr(0, std::min(end, bytes.size())), file, 0);
  if (!bytes.starts_with("ply")) words.refuse("does not begin with `ply`, as a PLY file does");
  if (end == std::string_view::npos) words.refuse("has no `end_header`: it is cut off or no PLY file");
  Header header;
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

/// Numbers one after the other, from bytes.
class ByteSource {
 public:
  ByteSource(std::string_view bytes, const Header& header, std::filesystem::path file)
      : bytes_(bytes),
        at_(header.bytes),
        order_(header.encoding == Encoding::Big ? std::endian::big : std::endian::little),
        file_(std::move(file)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: byte {}", file_.string(), at_), what);
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  /// Bytes that one number takes at least.
  static std::size_t least(Number type) { return size_of(type); }

  double next(Number type) {
    if (left() < size_of(type)) refuse("the file ends here: it is cut off");
    const std::string_view raw = bytes_.substr(at_);
    at_ += size_of(type);
    switch (type) {
      case Number::Int8:
        return number_at<std::int8_t>(raw, order_);
      case Number::Uint8:
        return number_at<std::uint8_t>(raw, order_);
      case Number::Int16:
        return number_at<std::int16_t>(raw, order_);
      case Number::Uint16:
        return number_at<std::uint16_t>(raw, order_);
      case Number::Int32:
        return number_at<std::int32_t>(raw, order_);
      case Number::Uint32:
        return number_at<std::uint32_t>(raw, order_);
      case Number::Float32:
        return number_at<float>(raw, order_);
      case Number::Float64:
        break;
    }
    return number_at<double>(raw, order_);
  }

 private:
  std::string_view bytes_;
  std::size_t at_;
  std::endian order_;
  std::filesystem::path file_;
};

/// The same from text.
class WordSource {
 public:
  WordSource(std::string_view bytes, const Header& header, const std::filesystem::path& file)
      : words_(bytes.substr(header.bytes), file, 0, header.lines + 1), size_(bytes.size() - header.bytes) {}

  [[noreturn]] void refuse(const std::string& what) const { words_.refuse(what); }
  [[nodiscard]] std::size_t left() const { return size_ + 1; }
  static std::size_t least(Number /*type*/) { return 2; }
  double next(Number /*type*/) { return words_.any_number(words_.word()); }

 private:
  MeshWords words_;
  std::size_t size_;
};

template <class Source>
void read_row(Source& from, const Element& element, std::vector<double>& row,
              std::vector<std::vector<double>>& lists) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    if (!property.count) {
      row[i] = from.next(property.value);
      continue;
    }
    const double count = from.next(*property.count);
    if (!(count >= 0) || count != std::floor(count) ||
        count > static_cast<double>(from.left() / Source::least(property.value))) {
      from.refuse(
          fmt::format("a list of `{}` says that {} numbers follow, for which the file's other {} bytes "
                      "do not do: it is cut off or damaged",
                      property.name, count, from.left()));
    }
    lists[i].clear();
    for (double k = 0; k < count; ++k) lists[i].push_back(from.next(property.value));
  }
}

std::optional<std::size_t> place_of(const Element& element, std::initializer_list<const char*> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    for (const char* name : names) {
      if (element.properties[i].name == name) return i;
    }
  }
  return std::nullopt;
}

void check_count(const auto& from, const Element& element) {
  std::size_t bytes = 0;  // of one at least; a list may be empty
  for (const Property& one : element.properties) bytes += from.least(one.count.value_or(one.value));
  if (bytes == 0 || element.count <= from.left() / bytes) return;
  from.refuse(
      fmt::format("the header says that {} of element `{}` follow, for which the file's other {} bytes "
                  "do not do: it is cut off or damaged",
                  element.count, element.name, from.left()));
}

void add_vertex(TriangleMesh& mesh, const auto& from, const Vec3& place) {
  if (!place.allFinite()) from.refuse("a coordinate is not a finite number");
  mesh.vertices.push_back(place);
}

void add_face(TriangleMesh& mesh, const auto& from, const std::vector<double>& list, std::size_t vertices) {
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

template <class Source>
TriangleMesh mesh_from(Source from, const Header& header) {
  std::size_t vertices = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
  }
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    check_count(from, element);
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
  const Header header = header_of(bytes, file);
  if (header.encoding == Encoding::Text) return mesh_from(WordSource(bytes, header, file), header);
  return mesh_from(ByteSource(bytes, header, file), header);
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
