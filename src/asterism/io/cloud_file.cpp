// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cloud_file.hpp"

#include <fmt/format.h>

#include <iterator>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/mesh_bytes.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPiece = 1 << 16;  // bytes handed on at once

bool is_time(const CloudField& field) { return field.name.ends_with("time_s"); }

std::string header_of(const Cloud& cloud, CloudFormat format, Coordinates coordinates) {
  std::string text =
      fmt::format("ply\nformat {} 1.0\nelement vertex {}\n",
                  format == CloudFormat::Ascii ? "ascii" : "binary_little_endian", cloud.size());
  const char* type = coordinates == Coordinates::Double ? "double" : "float";
  for (const char* axis : {"x", "y", "z"}) text += fmt::format("property {} {}\n", type, axis);
  if (!cloud.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  for (const CloudField& field : cloud.fields)
    text += fmt::format("property {} scalar_{}\n", is_time(field) ? "double" : "float", field.name);
  return text + "end_header\n";
}

void append_word(std::string& text, auto number) { fmt::format_to(std::back_inserter(text), "{} ", number); }

/// One point's numbers, each handed to `add` in the type that the header states.
void visit_row(const Cloud& cloud, std::size_t row, Coordinates coordinates, const auto& add) {
  for (const double value : cloud.points[row]) {
    if (coordinates == Coordinates::Double) {
      add(value);
    } else {
      add(static_cast<float>(value));
    }
  }
  if (!cloud.normals.empty()) {
    for (const float value : cloud.normals[row]) add(value);
  }
  for (const CloudField& field : cloud.fields) {
    if (is_time(field)) {
      add(field.values[row]);
    } else {
      add(static_cast<float>(field.values[row]));
    }
  }
}

}  // namespace

void write_cloud(const std::filesystem::path& file, const Cloud& cloud, CloudFormat format,
                 Coordinates coordinates) {
  require(cloud.normals.empty() || cloud.normals.size() == cloud.size(), "a cloud has a normal a point");
  for (const CloudField& field : cloud.fields)
    require(field.values.size() == cloud.size(), "a field of a cloud has a number a point");
  OutputFile output(file);
  std::string piece = header_of(cloud, format, coordinates);
  for (std::size_t row = 0; row < cloud.size(); ++row) {
    if (format == CloudFormat::Ascii) {
      visit_row(cloud, row, coordinates, [&](auto number) { append_word(piece, number); });
      piece.back() = '\n';
    } else {
      visit_row(cloud, row, coordinates, [&](auto number) { append_number(piece, number); });
    }
    if (piece.size() < kPiece) continue;
    output.write(piece);
    piece.clear();
  }
  output.write(piece);
  output.finish();
}

Cloud read_cloud(const std::filesystem::path& file) {
  CloudReader reader(file);
  Cloud cloud = reader.next(reader.points());
  if (cloud.points.empty()) {
    throw InputError(file.string(), reader.points() == 0
                                        ? std::string("holds no points")
                                        : fmt::format("none of its {} points is finite", reader.points()));
  }
  return cloud;
}

}  // namespace asterism
