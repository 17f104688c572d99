// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What the header of a PLY file promises; for meshes and clouds.

namespace asterism {

enum class PlyNumber { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
[[nodiscard]] std::size_t size_of(PlyNumber number);
/// The number at the begin of `bytes`, which are enough for it.
[[nodiscard]] double number_of(PlyNumber type, std::string_view bytes, std::endian order);

struct PlyProperty {
  std::string name;
  PlyNumber value = PlyNumber::Float32;
  std::optional<PlyNumber> count;  // of a list: the type of how many follow
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Text, Little, Big };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Text;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0, lines = 0;  // that it takes

  [[nodiscard]] std::endian order() const {
    return encoding == PlyEncoding::Big ? std::endian::big : std::endian::little;
  }
};

/// Of the begin of a file, as far as it is there; `file` is for messages only. Throws InputError with the
/// line for what is no header of a PLY file.
[[nodiscard]] PlyHeader ply_header_of(std::string_view bytes, const std::filesystem::path& file);

}  // namespace asterism
