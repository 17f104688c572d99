// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/rig_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "asterism/core/options.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/io/kalibr_file.hpp"
#include "asterism/io/quiet_opencv.hpp"

namespace asterism {
namespace {

const std::vector<std::string> kKeys = {
    "image_width", "image_height", "image_width2",    "image_height2", "K1", "D1", "K2", "D2", "R",
    "T",           "covariance",   "covariance_order"};
/// What OpenCV's samples write beside these and what follows from the others.
const std::vector<std::string> kAlsoKnown = {
    "M1", "M2", "R1", "R2", "P1", "P2", "Q", "E", "F", "rms", "calibration_time", "avg_reprojection_error"};

/// The files a rig is told in, as one set of keys.
class Nodes {
 public:
  void add(const std::filesystem::path& file, const std::string& text) {
    quiet_opencv();
    try {
      storages_.emplace_back(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    } catch (const cv::Exception&) {
      throw InputError(file.string(), "cannot be read as YAML, XML or JSON of OpenCV's FileStorage");
    }
    files_.push_back(file);
    const cv::FileNode root = storages_.back().root();
    if (!root.isMap()) throw InputError(file.string(), "holds no keys and values");
    for (const cv::FileNode& node : root) refuse_unknown(file, node.name());
  }

  [[nodiscard]] cv::FileNode find(const std::string& name) const {
    for (const cv::FileStorage& storage : storages_) {
      if (const cv::FileNode node = storage[name]; !node.empty()) return node;
    }
    return {};
  }

  [[nodiscard]] std::string where() const { return fmt::format("{}", fmt::join(texts(), " + ")); }

 private:
  static void refuse_unknown(const std::filesystem::path& file, const std::string& name) {
    for (const auto* keys : {&kKeys, &kAlsoKnown}) {
      if (std::find(keys->begin(), keys->end(), name) != keys->end()) return;
    }
    throw InputError(file.string(), unknown_name_message(name, "a rig", kKeys));
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> names;
    for (const auto& file : files_) names.push_back(file.string());
    return names;
  }

  std::vector<cv::FileStorage> storages_;
  std::vector<std::filesystem::path> files_;
};

/// A matrix of OpenCV's, or a plain list of numbers (then one row). Empty when the key is not there.
MatX matrix_of(const Nodes& nodes, const std::string& name) {
  const cv::FileNode node = nodes.find(name);
  if (node.empty()) return {};
  const auto refuse = [&](const char* what) {
    throw InputError(nodes.where(), fmt::format("`{}` {}", name, what));
  };
  cv::Mat mat;
  try {
    if (node.isMap()) {
      node >> mat;
    } else if (node.isSeq()) {
      std::vector<double> numbers;
      node >> numbers;
      cv::Mat(numbers).reshape(1, 1).copyTo(mat);
    }
    if (mat.channels() == 1) mat.convertTo(mat, CV_64F);
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty() || mat.channels() != 1 || mat.dims != 2) refuse("is no matrix of numbers");
  MatX matrix(mat.rows, mat.cols);
  for (int i = 0; i < mat.rows; ++i) {
    for (int j = 0; j < mat.cols; ++j) matrix(i, j) = mat.at<double>(i, j);
  }
  if (!matrix.allFinite()) refuse("holds a value that is not a finite number");
  return matrix;
}

/// `rows` × `cols` numbers, whatever way they lie; throws when there are others.
MatX shaped(const Nodes& nodes, const std::string& name, Eigen::Index rows, Eigen::Index cols) {
  const MatX matrix = matrix_of(nodes, name);
  if (matrix.size() == 0)
    throw InputError(nodes.where(),
                     fmt::format("`{}` is missing; needed is a {}×{} matrix", name, rows, cols));
  const bool as_list = matrix.rows() == 1 || matrix.cols() == 1;
  if (matrix.size() != rows * cols || (!as_list && matrix.rows() != rows)) {
    throw InputError(nodes.where(), fmt::format("`{}` is {}×{}; it must be {}×{}", name, matrix.rows(),
                                                matrix.cols(), rows, cols));
  }
  MatX result(rows, cols);
  const VecX flat = matrix.transpose().reshaped();
  for (Eigen::Index i = 0; i < rows * cols; ++i) result(i / cols, i % cols) = flat(i);
  return result;
}

int pixels_of(const Nodes& nodes, const std::string& name, int otherwise) {
  const cv::FileNode node = nodes.find(name);
  if (node.empty()) return otherwise;
  if (!node.isInt() || static_cast<int>(node) < 1) {
    throw InputError(nodes.where(), fmt::format("`{}` must be a whole number of pixels", name));
  }
  return static_cast<int>(node);
}

Lens lens_of(const Nodes& nodes, const std::string& number) {
  const std::string name = nodes.find("K" + number).empty() && !nodes.find("M" + number).empty() ? "M" : "K";
  const MatX k = shaped(nodes, name + number, 3, 3);
  Lens lens;
  lens.fx = k(0, 0);
  lens.skew = k(0, 1);
  lens.cx = k(0, 2);
  lens.fy = k(1, 1);
  lens.cy = k(1, 2);
  const bool is_camera_matrix = k(1, 0) == 0 && k(2, 0) == 0 && k(2, 1) == 0 && k(2, 2) == 1;
  if (!is_camera_matrix || !(k.determinant() > 0)) {
    throw InputError(
        nodes.where(),
        fmt::format("`{}{}` must be fx s cx; 0 fy cy; 0 0 1 with positive fx and fy", name, number));
  }
  const MatX d = matrix_of(nodes, "D" + number);
  constexpr std::array<Eigen::Index, 6> kCounts = {0, 4, 5, 8, 12, 14};
  if ((d.rows() > 1 && d.cols() > 1) ||
      std::find(kCounts.begin(), kCounts.end(), d.size()) == kCounts.end()) {
    throw InputError(nodes.where(),
                     fmt::format("`D{}` is {}×{}; it must hold none, 4, 5, 8, 12 or 14 coefficients", number,
                                 d.rows(), d.cols()));
  }
  lens.coefficients = static_cast<int>(d.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) lens.distortion[static_cast<std::size_t>(i)] = d.data()[i];
  return lens;
}

RigidMotion motion_of(const Nodes& nodes) {
  RigidMotion motion;
  motion.translation = shaped(nodes, "T", 3, 1);
  if (matrix_of(nodes, "R").size() == 3) {  // a rotation vector, as OpenCV takes too
    motion.rotation = exp_rotation(shaped(nodes, "R", 3, 1));
    return motion;
  }
  const Mat3 rotation = shaped(nodes, "R", 3, 3);
  // Files are written with six digits and more; what is farther off is no rotation.
  if (!((rotation * rotation.transpose() - Mat3::Identity()).norm() < 1e-3 && rotation.determinant() > 0)) {
    throw InputError(nodes.where(), "`R` is no rotation matrix: R Rᵀ must be 1 and its determinant +1");
  }
  motion.rotation = quaternion_from_matrix(rotation);
  return motion;
}

void read_covariance(const Nodes& nodes, StereoRig& rig) {
  if (nodes.find("covariance").empty()) return;
  rig.covariance = matrix_of(nodes, "covariance");
  const cv::FileNode order = nodes.find("covariance_order");
  for (const cv::FileNode& name : order) {
    if (name.isString()) rig.covariance_order.push_back(name.string());
  }
  const auto count = static_cast<Eigen::Index>(rig.covariance_order.size());
  if (rig.covariance.rows() != count || rig.covariance.cols() != count) {
    throw InputError(nodes.where(),
                     fmt::format("`covariance` is {}×{} but `covariance_order` names {} parameters",
                                 rig.covariance.rows(), rig.covariance.cols(), count));
  }
}

std::filesystem::path beside(const std::filesystem::path& file, const std::string& from,
                             const std::string& to) {
  std::string name = file.filename().string();
  const std::size_t at = name.find(from);
  if (at == std::string::npos) return {};
  return file.parent_path() / name.replace(at, from.size(), to);
}

std::filesystem::path file_in(const std::filesystem::path& folder) {
  for (const char* name : {"rig.yaml", "rig.yml", "intrinsics.yml", "intrinsics.yaml", "intrinsics.xml"}) {
    if (std::filesystem::exists(folder / name)) return folder / name;
  }
  throw InputError(folder.string(),
                   "this folder holds neither rig.yaml nor intrinsics.yml with extrinsics.yml");
}

std::string yaml_matrix(const std::string& name, const MatX& matrix) {
  const VecX flat = matrix.transpose().reshaped();
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name,
                     matrix.rows(), matrix.cols(), fmt::join(flat.begin(), flat.end(), ", "));
}

std::string yaml_lens(const Lens& lens, int number) {
  Mat3 k = Mat3::Identity();
  k.topRows<2>() << lens.fx, lens.skew, lens.cx, 0, lens.fy, lens.cy;
  std::string text = yaml_matrix(fmt::format("K{}", number), k);
  if (lens.coefficients == 0) return text;
  const Eigen::Map<const VecX> d(lens.distortion.data(), lens.coefficients);
  return text + yaml_matrix(fmt::format("D{}", number), d.transpose());
}

}  // namespace

StereoRig read_rig(const std::filesystem::path& named, ImageSize size) {
  const std::filesystem::path file = std::filesystem::is_directory(named) ? file_in(named) : named;
  const std::string text = read_file(file);
  StereoRig rig;
  if (is_kalibr_camchain(text)) {
    rig = rig_of_kalibr_camchain(file, text);
    check_rig(rig, file.string());
    return rig;
  }
  Nodes nodes;
  nodes.add(file, text);
  for (const auto& other :
       {beside(file, "intrinsics", "extrinsics"), beside(file, "extrinsics", "intrinsics")}) {
    if (other.empty()) continue;
    if (!std::filesystem::exists(other))
      throw InputError(file.string(), fmt::format("its other half {} is missing", other.string()));
    nodes.add(other, read_file(other));
  }
  rig.left = lens_of(nodes, "1");
  rig.right = lens_of(nodes, "2");
  rig.left.width_px = pixels_of(nodes, "image_width", size.width_px);
  rig.left.height_px = pixels_of(nodes, "image_height", size.height_px);
  rig.right.width_px = pixels_of(nodes, "image_width2", rig.left.width_px);
  rig.right.height_px = pixels_of(nodes, "image_height2", rig.left.height_px);
  if (rig.left.width_px < 1 || rig.left.height_px < 1) {
    throw InputError(nodes.where(), "names no image size; add image_width and image_height");
  }
  rig.right_from_left = motion_of(nodes);
  read_covariance(nodes, rig);
  check_rig(rig, nodes.where());
  return rig;
}

void write_rig(const std::filesystem::path& file, const StereoRig& rig) {
  check_rig(rig, file.string());
  std::string text = fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", rig.left.width_px,
                                 rig.left.height_px);
  if (rig.right.width_px != rig.left.width_px || rig.right.height_px != rig.left.height_px) {
    text += fmt::format("image_width2: {}\nimage_height2: {}\n", rig.right.width_px, rig.right.height_px);
  }
  text += yaml_lens(rig.left, 1) + yaml_lens(rig.right, 2);
  text += yaml_matrix("R", rig.right_from_left.rotation.toRotationMatrix());
  text += yaml_matrix("T", rig.right_from_left.translation);
  if (!rig.covariance_order.empty()) {
    text += yaml_matrix("covariance", rig.covariance);
    text += "covariance_order:\n";
    for (const std::string& name : rig.covariance_order) text += fmt::format("   - \"{}\"\n", name);
  }
  write_file(file, text);
}

}  // namespace asterism
