// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>

#include "asterism/core/result.hpp"
#include "asterism/io/byte_stream.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/mesh_bytes.hpp"
#include "asterism/io/ply_numbers.hpp"

namespace asterism {
namespace {

constexpr std::size_t kLargestHeader = 1 << 20;
constexpr std::size_t kBlock = 1 << 14;  // rows decoded at once

PlyHeader header_at_begin(ByteStream& stream) {
  std::size_t ahead = 1 << 12;
  std::string_view bytes = stream.ready(ahead);
  const auto is_whole = [&] { return bytes.find('\n', bytes.find("end_header")) != bytes.npos; };
  while (bytes.starts_with("ply") && !is_whole() && bytes.size() >= ahead && ahead < kLargestHeader) {
    bytes = stream.ready(ahead *= 2);
  }
  PlyHeader header = ply_header_of(bytes, stream.file());
  stream.take(header.bytes);
  return header;
}

/// Bytes of one of them, where that is the same for all.
std::optional<std::size_t> row_bytes(const PlyElement& element) {
  std::size_t bytes = 0;
  for (const PlyProperty& one : element.properties) {
    if (one.count) return std::nullopt;
    bytes += size_of(one.value);
  }
  return bytes;
}

/// What becomes of a vertex's properties: where each goes; a property that is in none of them is passed over.
struct Columns {
  std::array<std::size_t, 3> place{}, normal{};
  bool has_normals = false;
  std::vector<std::size_t> fields;
  std::vector<std::string> names;  // of the fields
};

bool is_colour(const std::string& name) {
  constexpr std::array<std::string_view, 8> all = {
      "red", "green", "blue", "alpha", "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"};
  return std::find(all.begin(), all.end(), name) != all.end();
}

std::optional<std::size_t> number_called(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && !element.properties[i].count) return i;
  }
  return std::nullopt;
}

/// All three, or none.
std::optional<std::array<std::size_t, 3>> three_of(const PlyElement& element,
                                                   const std::array<const char*, 3>& names) {
  std::array<std::size_t, 3> all{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = number_called(element, names[axis]);
    if (!found) return std::nullopt;
    all[axis] = *found;
  }
  return all;
}

Columns columns_of(const PlyElement& element, const std::filesystem::path& file) {
  Columns columns;
  const auto place = three_of(element, {"x", "y", "z"});
  if (!place) throw InputError(file.string(), "element `vertex` lacks one of x, y, z: it is no cloud");
  columns.place = *place;
  const auto normal = three_of(element, {"nx", "ny", "nz"});
  columns.has_normals = normal.has_value();
  if (normal) columns.normal = *normal;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& one = element.properties[i];
    const auto is_of = [&](const auto& three) {
      return std::find(three.begin(), three.end(), i) != three.end();
    };
    if (one.count || is_colour(one.name) || is_of(columns.place) || (normal && is_of(*normal))) continue;
    constexpr std::string_view kPrefix = "scalar_";
    const bool prefixed = one.name.starts_with(kPrefix) && one.name.size() > kPrefix.size();
    columns.fields.push_back(i);
    columns.names.push_back(prefixed ? one.name.substr(kPrefix.size()) : one.name);
  }
  return columns;
}

/// Rows of numbers by property: numbers[property][row]. Those of a list stay empty.
using Block = std::vector<std::vector<double>>;

template <class Number>
void decode(const char* at, std::size_t step, std::endian order, std::span<double> into) {
  for (double& each : into) {
    each = static_cast<double>(number_at<Number>({at, sizeof(Number)}, order));
    at += step;
  }
}

void decode(PlyNumber type, const char* at, std::size_t step, std::endian order, std::span<double> into) {
  switch (type) {
    case PlyNumber::Float32:
      return decode<float>(at, step, order, into);
    case PlyNumber::Float64:
      return decode<double>(at, step, order, into);
    default:
      for (double& each : into) {
        each = number_of(type, {at, size_of(type)}, order);
        at += step;
      }
  }
}

}  // namespace

struct CloudReader::State {
  ByteStream stream;
  PlyHeader header;
  PlyNumbers numbers;
  PlyElement vertex;
  Columns columns;
  std::size_t left = 0, not_finite = 0;
  Block block;

  explicit State(const std::filesystem::path& file)
      : stream(file), header(header_at_begin(stream)), numbers(stream, header) {
    for (const PlyElement& element : header.elements) {
      numbers.check_count(element);
      if (element.name == "vertex") {
        vertex = element;
        columns = columns_of(vertex, file);
        left = vertex.count;
        block.resize(vertex.properties.size());
        return;
      }
      pass_over(element);
    }
    throw InputError(file.string(), "has no element `vertex`: it is no cloud");
  }

  void pass_over(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const PlyProperty& one : element.properties) {
        std::size_t many = one.count ? numbers.list_size(one) : 1;
        for (; many > 0; --many) numbers.next(one.value);
      }
    }
  }

  /// One number after the other.
  void read_rows(std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const PlyProperty& one = vertex.properties[i];
        if (!one.count) {
          block[i][row] = numbers.next(one.value);
          continue;
        }
        for (std::size_t many = numbers.list_size(one); many > 0; --many) numbers.next(one.value);
      }
    }
  }

  /// All rows take the same bytes: property by property.
  void read_rows(std::size_t rows, std::size_t step) {
    const std::string_view bytes = stream.ready(rows * step);
    if (bytes.size() < rows * step) numbers.refuse("the file ends here: it is cut off");
    std::size_t offset = 0;
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
      const PlyNumber type = vertex.properties[i].value;
      decode(type, bytes.data() + offset, step, header.order(), std::span(block[i]).first(rows));
      offset += size_of(type);
    }
    stream.take(rows * step);
  }

  /// Appends to the cloud what is finite.
  void keep(std::size_t rows, Cloud& cloud) {
    const auto three = [&](const std::array<std::size_t, 3>& of, std::size_t row) {
      return Vec3(block[of[0]][row], block[of[1]][row], block[of[2]][row]);
    };
    for (std::size_t row = 0; row < rows; ++row) {
      const Vec3 place = three(columns.place, row);
      if (!place.allFinite()) {
        ++not_finite;
        continue;
      }
      cloud.points.push_back(place);
      if (columns.has_normals) {
        const Vec3 normal = three(columns.normal, row);
        cloud.normals.push_back(normal.allFinite() ? normal.cast<float>() : Vec3f(Vec3f::Zero()));
      }
      for (std::size_t i = 0; i < columns.fields.size(); ++i)
        cloud.fields[i].values.push_back(block[columns.fields[i]][row]);
    }
  }
};

CloudReader::CloudReader(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {}
CloudReader::~CloudReader() = default;

std::size_t CloudReader::points() const { return state_->vertex.count; }
std::size_t CloudReader::not_finite() const { return state_->not_finite; }

Cloud CloudReader::next(std::size_t most) {
  State& state = *state_;
  const std::size_t wanted = std::min(most, state.left);
  Cloud cloud;
  cloud.points.reserve(wanted);
  if (state.columns.has_normals) cloud.normals.reserve(wanted);
  for (const std::string& name : state.columns.names) {
    cloud.fields.push_back({name, {}});
    cloud.fields.back().values.reserve(wanted);
  }
  const auto step = state.header.encoding == PlyEncoding::Text ? std::nullopt : row_bytes(state.vertex);
  for (std::vector<double>& column : state.block) column.resize(kBlock);
  // A piece of which nothing is finite is not the end.
  while (state.left > 0 && cloud.size() < most) {
    const std::size_t rows = std::min({kBlock, most - cloud.size(), state.left});
    if (step) {
      state.read_rows(rows, *step);
    } else {
      state.read_rows(rows);
    }
    state.left -= rows;
    state.keep(rows, cloud);
  }
  return cloud;
}

}  // namespace asterism
