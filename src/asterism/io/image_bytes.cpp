// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/image_bytes.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "asterism/io/crc32.hpp"

namespace asterism {
namespace {

const std::string kCutOff = "the image is cut off: its last part is missing";

std::uint64_t unsigned_at(std::string_view bytes, std::size_t at, std::size_t size, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = at + (big_endian ? i : size - 1 - i);
    value = value << 8U | static_cast<unsigned char>(bytes[place]);
  }
  return value;
}

std::string fault_of_png(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = unsigned_at(bytes, at, 4, true);
    if (length > bytes.size() - at - 12) return kCutOff;
    if (crc32(bytes.substr(at + 4, length + 4)) != unsigned_at(bytes, at + 8 + length, 4, true)) {
      return "the image is damaged: a checksum does not hold";
    }
    if (bytes.substr(at + 4, 4) == "IEND") return "";
    at += length + 12;
  }
  return kCutOff;
}

std::string fault_of_jpeg(std::string_view bytes) {
  // Some cameras pad behind the end marker; compressed data cannot hold one.
  return bytes.rfind("\xFF\xD9") == std::string_view::npos ? kCutOff : "";
}

std::string fault_of_bmp(std::string_view bytes) {
  if (bytes.size() < 54) return kCutOff;
  const auto width = static_cast<std::int32_t>(unsigned_at(bytes, 18, 4, false));
  const auto height = static_cast<std::int32_t>(unsigned_at(bytes, 22, 4, false));
  const std::uint64_t bits = unsigned_at(bytes, 28, 2, false);
  const bool compressed = unsigned_at(bytes, 30, 4, false) == 1 || unsigned_at(bytes, 30, 4, false) == 2;
  const std::uint64_t stride =
      (static_cast<std::uint64_t>(std::abs(std::int64_t{width})) * bits + 31) / 32 * 4;
  const std::uint64_t needed =
      unsigned_at(bytes, 10, 4, false) + stride * static_cast<std::uint64_t>(std::abs(std::int64_t{height}));
  return !compressed && bytes.size() < needed ? kCutOff : "";
}

/// P5: width, height and largest value as text, comments after #, one blank, then the bytes.
std::string fault_of_pgm(std::string_view bytes) {
  std::vector<std::uint64_t> numbers;
  std::size_t at = 2;
  while (numbers.size() < 3 && at < bytes.size()) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else if (bytes[at] >= '0' && bytes[at] <= '9') {
      std::uint64_t number = 0;
      for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && number < 1000000; ++at) {
        number = 10 * number + static_cast<std::uint64_t>(bytes[at] - '0');
      }
      numbers.push_back(number);
    } else {
      ++at;
    }
  }
  if (numbers.size() < 3) return kCutOff;
  const std::uint64_t samples = numbers[0] * numbers[1] * (bytes[1] == '6' ? 3U : 1U);
  return bytes.size() < at + 1 + samples * (numbers[2] > 255 ? 2U : 1U) ? kCutOff : "";
}

/// The values of a TIFF tag of 16- or 32-bit whole numbers.
std::vector<std::uint64_t> tiff_values(std::string_view bytes, std::size_t entry, bool big_endian) {
  const std::size_t size = unsigned_at(bytes, entry + 2, 2, big_endian) == 3 ? 2 : 4;
  const std::size_t count = unsigned_at(bytes, entry + 4, 4, big_endian);
  const std::size_t place = count * size <= 4 ? entry + 8 : unsigned_at(bytes, entry + 8, 4, big_endian);
  std::vector<std::uint64_t> values;
  if (place > bytes.size() || count > (bytes.size() - place) / size) return values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(unsigned_at(bytes, place + i * size, size, big_endian));
  return values;
}

std::string fault_of_tiff(std::string_view bytes) {
  const bool big_endian = bytes[0] == 'M';
  if (bytes.size() < 8) return kCutOff;
  const std::size_t directory = unsigned_at(bytes, 4, 4, big_endian);
  if (directory + 2 > bytes.size()) return kCutOff;
  const std::size_t entries = unsigned_at(bytes, directory, 2, big_endian);
  if (entries * 12 > bytes.size() - directory - 2) return kCutOff;
  std::vector<std::uint64_t> offsets, lengths;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::uint64_t tag = unsigned_at(bytes, entry, 2, big_endian);
    if (tag == 273 || tag == 324) offsets = tiff_values(bytes, entry, big_endian);
    if (tag == 279 || tag == 325) lengths = tiff_values(bytes, entry, big_endian);
  }
  if (offsets.empty() || offsets.size() != lengths.size()) return kCutOff;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i] + lengths[i] > bytes.size()) return kCutOff;
  }
  return "";
}

}  // namespace

std::string fault_of_image_bytes(std::string_view bytes) {
  if (bytes.empty()) return "the file is empty";
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return fault_of_png(bytes);
  if (bytes.starts_with("\xFF\xD8")) return fault_of_jpeg(bytes);
  if (bytes.starts_with("BM")) return fault_of_bmp(bytes);
  if (bytes.starts_with("P5") || bytes.starts_with("P6")) return fault_of_pgm(bytes);
  if (bytes.starts_with("P2") || bytes.starts_with("P3")) return "";
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4))) {
    return fault_of_tiff(bytes);
  }
  return "is no image of a kind that can be read (PNG, TIFF, BMP, PGM, JPEG)";
}

}  // namespace asterism
