// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/image_file.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/image_bytes.hpp"
#include "asterism/io/quiet_opencv.hpp"

namespace asterism {
namespace {

const std::vector<std::string> kEndings = {".png", ".tif", ".tiff", ".bmp", ".pgm", ".jpg", ".jpeg"};

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool is_image_name(const std::filesystem::path& file) {
  return std::find(kEndings.begin(), kEndings.end(), lower_ending(file)) != kEndings.end();
}

template <class Grey>
Raster<Grey> raster_of(const cv::Mat& mat) {
  Raster<Grey> raster(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y) {
    std::memcpy(raster.row(y), mat.ptr(y), static_cast<std::size_t>(mat.cols) * sizeof(Grey));
  }
  return raster;
}

/// Numbers in names by their value, the rest by its letters.
bool counts_before(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& text, std::size_t& at) {
      const std::size_t first = std::min(text.find_first_not_of('0', at), text.size());
      at = first;
      while (at < text.size() && digit(text[at])) ++at;
      return text.substr(first, at - first);
    };
    const std::string in_a = number(a, i);
    const std::string in_b = number(b, j);
    if (in_a.size() != in_b.size()) return in_a.size() < in_b.size();
    if (in_a != in_b) return in_a < in_b;
  }
  return a.size() - i < b.size() - j;
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  if (const std::string fault = fault_of_image_bytes(bytes); !fault.empty())
    throw InputError(file.string(), fault);
  quiet_opencv();
  cv::Mat mat;
  try {
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    mat = cv::imdecode(view, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty()) throw InputError(file.string(), "the image is damaged and cannot be decoded");
  if (mat.type() == CV_8UC1) return raster_of<std::uint8_t>(mat);
  if (mat.type() == CV_16UC1) return raster_of<std::uint16_t>(mat);
  throw InputError(file.string(),
                   "has pixels that are neither 8 nor 16 bits of grey; convert it to one of these");
}

void write_image(const std::filesystem::path& file, const Image& image) {
  if (!is_image_name(file)) {
    throw InputError(file.string(),
                     fmt::format("no image format ends so; known are: {}", fmt::join(kEndings, " ")));
  }
  quiet_opencv();
  std::vector<unsigned char> bytes;
  std::visit(
      [&](const auto& raster) {
        constexpr int kType = sizeof(raster.pixels[0]) == 1 ? CV_8UC1 : CV_16UC1;
        void* pixels = const_cast<void*>(static_cast<const void*>(raster.pixels.data()));
        cv::imencode(lower_ending(file), cv::Mat(raster.height, raster.width, kType, pixels), bytes);
      },
      image);
  write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<std::filesystem::path> list_images(const std::string& folder_or_pattern) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder_or_pattern)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_or_pattern)) {
      if (entry.is_regular_file() && is_image_name(entry.path())) files.push_back(entry.path());
    }
  } else {
    glob_t found{};
    if (::glob(folder_or_pattern.c_str(), 0, nullptr, &found) == 0) {
      files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
  }
  if (files.empty()) {
    throw InputError(folder_or_pattern,
                     "no images here; name a folder, a file or a pattern such as 'left/*.png'");
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return counts_before(a.string(), b.string()); });
  return files;
}

}  // namespace asterism
