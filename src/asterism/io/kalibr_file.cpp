// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/kalibr_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "asterism/core/options.hpp"

namespace asterism {
namespace {

/// The value of a key as it stands in the file, its later lines joined: lists in brackets and lists of
/// lines with dashes hold the same numbers in the same order, and more is not needed.
struct Value {
  int line = 0;
  std::string text;
};
using Camera = std::map<std::string, Value>;

const std::vector<std::string> kKeys = {
    "camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution",        "T_cn_cnm1",
    "cam_overlaps", "rostopic",   "T_cam_imu",        "T_imu_cam",         "timeshift_cam_imu", "cam_id"};

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& what) {
  throw InputError(fmt::format("{}:{}", file.string(), line), what);
}

std::map<std::string, Camera> split(const std::filesystem::path& file, std::string_view content) {
  std::map<std::string, Camera> cameras;
  Camera* camera = nullptr;
  Value* value = nullptr;
  std::istringstream stream{std::string(content)};
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    if (const std::size_t comment = text.find('#'); comment != std::string::npos) text.erase(comment);
    const std::size_t indent = text.find_first_not_of(" \t\r");
    if (indent == std::string::npos || text.starts_with("---") || text.starts_with("%")) continue;
    const std::size_t colon = text.find(':');
    const std::string key = colon == std::string::npos ? "" : text.substr(indent, colon - indent);
    const bool is_key = !key.empty() && text[indent] != '-' && text[indent] != '[';
    if (indent == 0 && is_key) {
      camera = &cameras[key];
      value = nullptr;
    } else if (is_key && camera != nullptr) {
      value = &(*camera)[key];
      *value = {line, text.substr(colon + 1)};
    } else if (value != nullptr) {
      value->text += " " + text;
    } else {
      refuse(file, line, "stands outside any camera");
    }
  }
  return cameras;
}

const Value& value_of(const std::filesystem::path& file, const std::string& name, const Camera& camera,
                      const std::string& key) {
  const auto found = camera.find(key);
  if (found == camera.end()) throw InputError(file.string(), fmt::format("{} has no `{}`", name, key));
  return found->second;
}

std::string word_of(const Value& value) {
  std::string word;
  for (const char c : value.text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') word += c;
  }
  return word;
}

std::vector<double> numbers_of(const std::filesystem::path& file, const Value& value,
                               const std::string& key) {
  std::string text = value.text;
  for (char& c : text) {
    if (c == '[' || c == ']' || c == ',' || c == '\r') c = ' ';
  }
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    if (word == "-") continue;
    double number = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [stop, error] = std::from_chars(begin, word.data() + word.size(), number);
    if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(number)) {
      refuse(file, value.line, fmt::format("`{}`: `{}` is no finite number", key, word));
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<double> numbers_of(const std::filesystem::path& file, const std::string& name,
                               const Camera& camera, const std::string& key, std::size_t count) {
  const Value& value = value_of(file, name, camera, key);
  std::vector<double> numbers = numbers_of(file, value, key);
  if (numbers.size() != count) {
    refuse(file, value.line, fmt::format("`{}` must hold {} numbers, not {}", key, count, numbers.size()));
  }
  return numbers;
}

Lens lens_of(const std::filesystem::path& file, const std::string& name, const Camera& camera) {
  for (const auto& [key, value] : camera) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      refuse(file, value.line, unknown_name_message(key, "a Kalibr camera", kKeys));
    }
  }
  const Value& model = value_of(file, name, camera, "camera_model");
  if (word_of(model) != "pinhole") {
    refuse(file, model.line,
           fmt::format("camera model `{}` is not supported; it must be pinhole", word_of(model)));
  }
  const auto intrinsics = numbers_of(file, name, camera, "intrinsics", 4);
  const auto resolution = numbers_of(file, name, camera, "resolution", 2);
  Lens lens;
  lens.fx = intrinsics[0];
  lens.fy = intrinsics[1];
  lens.cx = intrinsics[2];
  lens.cy = intrinsics[3];
  lens.width_px = static_cast<int>(resolution[0]);
  lens.height_px = static_cast<int>(resolution[1]);
  const Value& distortion = value_of(file, name, camera, "distortion_model");
  if (word_of(distortion) == "none") return lens;
  if (word_of(distortion) != "radtan") {
    refuse(file, distortion.line,
           fmt::format("distortion model `{}` is not supported; calibrate with pinhole-radtan",
                       word_of(distortion)));
  }
  const auto coefficients = numbers_of(file, name, camera, "distortion_coeffs", 4);
  lens.coefficients = 4;
  std::copy(coefficients.begin(), coefficients.end(), lens.distortion.begin());
  return lens;
}

}  // namespace

bool is_kalibr_camchain(std::string_view text) {
  const auto has = [&](std::string_view key) {
    return text.starts_with(key) || text.find("\n" + std::string(key)) != std::string_view::npos;
  };
  return has("cam0:");
}

StereoRig rig_of_kalibr_camchain(const std::filesystem::path& file, std::string_view text) {
  const auto cameras = split(file, text);
  for (const char* name : {"cam0", "cam1"}) {
    if (!cameras.contains(name)) throw InputError(file.string(), fmt::format("has no camera `{}`", name));
  }
  if (cameras.size() > 2) {
    throw InputError(file.string(), fmt::format("has {} cameras; a rig has cam0 and cam1", cameras.size()));
  }
  const Camera& right = cameras.at("cam1");
  StereoRig rig;
  rig.left = lens_of(file, "cam0", cameras.at("cam0"));
  rig.right = lens_of(file, "cam1", right);
  const auto motion = numbers_of(file, "cam1", right, "T_cn_cnm1", 16);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(motion.data());
  const Mat3 rotation = matrix.topLeftCorner<3, 3>();
  const bool is_rotation = (rotation * rotation.transpose() - Mat3::Identity()).norm() < 1e-3 &&
                           rotation.determinant() > 0 &&
                           (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() < 1e-9;
  if (!is_rotation) refuse(file, right.at("T_cn_cnm1").line, "`T_cn_cnm1` is no rigid motion");
  constexpr double kMmPerMetre = 1000;
  rig.right_from_left = {quaternion_from_matrix(rotation), kMmPerMetre * matrix.topRightCorner<3, 1>()};
  return rig;
}

}  // namespace asterism
