// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/rig_file.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

std::string matrix(const std::string& name, int rows, int cols, const std::string& data) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) + "\n   cols: " + std::to_string(cols) +
         "\n   dt: d\n   data: [ " + data + " ]\n";
}

const std::string kHead = "%YAML:1.0\n---\n";
const std::string kSize = "image_width: 640\nimage_height: 480\n";
const std::string kK = "530., 0., 320.5, 0., 531., 240.25, 0., 0., 1.";
const std::string kD = "-0.3, 0.1, 0.001, -0.002, 0.05";
const std::string kR = "1., 0., 0., 0., 1., 0., 0., 0., 1.";

std::string cameras(const std::string& letter = "K") {
  return matrix(letter + "1", 3, 3, kK) + matrix("D1", 1, 5, kD) + matrix(letter + "2", 3, 3, kK) +
         matrix("D2", 1, 5, kD);
}
std::string motion() { return matrix("R", 3, 3, kR) + matrix("T", 3, 1, "-83.2, 0.5, 0.25"); }

std::string fault_of(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("rig.yaml", text);
  const std::string message = input_error_of([&] { static_cast<void>(read_rig(file)); });
  EXPECT_TELLS(message, file.string());
  return message;
}

/// The file with one piece of it replaced.
std::string with(const std::string& old_part, const std::string& new_part) {
  std::string text = kHead + kSize + cameras() + motion();
  const std::size_t at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return text.replace(at, old_part.size(), new_part);
}

void expect_sample_rig(const StereoRig& rig) {
  EXPECT_EQ(rig.left.fx, 530);
  EXPECT_EQ(rig.left.fy, 531);
  EXPECT_EQ(rig.right.cy, 240.25);
  EXPECT_EQ(rig.right.coefficients, 5);
  EXPECT_EQ(rig.right.distortion[3], -0.002);
  EXPECT_EQ(rig.right.width_px, 640);
  EXPECT_EQ(rig.right_from_left.translation, Vec3(-83.2, 0.5, 0.25));
}

TEST(ReadRig, ReadsBothOfOpenCvsNames) {
  const TestFolder folder;
  expect_sample_rig(read_rig(folder.write("rig.yaml", kHead + kSize + cameras("K") + motion())));
  expect_sample_rig(read_rig(folder.write("rig.yaml", kHead + kSize + cameras("M") + motion())));
}

TEST(ReadRig, ReadsThePairOfFilesByEitherOrTheirFolder) {
  const TestFolder folder;
  const auto intrinsics = folder.write("intrinsics.yml", kHead + cameras("M"));
  const auto extrinsics =
      folder.write("extrinsics.yml",
                   kHead + motion() + matrix("R1", 3, 3, kR) +
                       matrix("Q", 4, 4, "1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1."));
  for (const auto& named : {intrinsics, extrinsics, folder.path()})
    expect_sample_rig(read_rig(named, {640, 480}));
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_rig(intrinsics)); }), "names no image size");
  std::filesystem::remove(extrinsics);
  EXPECT_TELLS(input_error_of([&] {
                 static_cast<void>(read_rig(intrinsics, {640, 480}));
               }),
               "its other half");
}

TEST(ReadRig, ReadsKalibrsChainInMetres) {
  const TestFolder folder;
  const std::string camera =
      "  camera_model: pinhole\n  intrinsics: [530.0, 531.0, 320.5, 240.25]\n"
      "  distortion_model: radtan\n  distortion_coeffs: [-0.3, 0.1, 0.001, -0.002]\n"
      "  resolution: [640, 480]\n  rostopic: /cam/image_raw\n  cam_overlaps: [1]\n";
  const std::string chain = "cam0:\n" + camera +
                            "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.0832]\n  - [0.0, 1.0, 0.0, 0.0005]\n"
                            "  - - 0.0\n    - 0.0\n    - 1.0\n    - 2.5e-4\n  - [0.0, 0.0, 0.0, 1.0]\n" +
                            camera;
  const StereoRig rig = read_rig(folder.write("camchain.yaml", chain));
  EXPECT_EQ(rig.left.fy, 531);
  EXPECT_EQ(rig.right.coefficients, 4);
  EXPECT_LT((rig.right_from_left.translation - Vec3(-83.2, 0.5, 0.25)).norm(), 1e-9);

  std::string fisheye = chain;
  fisheye.replace(fisheye.find("radtan"), 6, "equidistant");
  EXPECT_TELLS(fault_of(fisheye), "rig.yaml:4: distortion model `equidistant` is not supported");
  EXPECT_TELLS(fault_of("cam0:\n" + camera), "has no camera `cam1`");
  std::string mistyped = chain;
  mistyped.replace(mistyped.find("resolution"), 10, "resolutoin");
  EXPECT_TELLS(fault_of(mistyped), "did you mean `resolution`?");
}

TEST(ReadRig, WhatIsWrittenComesBackToTheLastBit) {
  const TestFolder folder;
  StereoRig rig = read_rig(folder.write("rig.yaml", kHead + kSize + cameras() + motion()));
  rig.left.skew = 1.0 / 3;
  rig.right.coefficients = 0;
  rig.right.distortion = {};
  rig.right.width_px = 800;
  rig.right_from_left.rotation = exp_rotation({0.01, 0.3, -0.02});
  rig.covariance_order = rig_parameter_names(rig);
  const auto count = static_cast<Eigen::Index>(rig.covariance_order.size());
  rig.covariance = MatX::Identity(count, count) / 7;
  write_rig(folder / "again.yaml", rig);
  const StereoRig again = read_rig(folder / "again.yaml");
  EXPECT_EQ(again.left.skew, rig.left.skew);
  EXPECT_EQ(again.left.distortion, rig.left.distortion);
  EXPECT_EQ(again.right.coefficients, 0);
  EXPECT_EQ(again.right.width_px, 800);
  EXPECT_LT(rotation_angle(again.right_from_left.rotation, rig.right_from_left.rotation), 1e-15);
  EXPECT_EQ(again.covariance_order, rig.covariance_order);
  EXPECT_EQ(again.covariance, rig.covariance);
}

TEST(ReadRig, RefusesWhatIsNotFiniteOrSingular) {
  EXPECT_TELLS(fault_of(with("530.", ".Nan")), "`K1` holds a value that is not a finite number");
  EXPECT_TELLS(fault_of(with("530.", "0.")), "`K1` must be fx s cx; 0 fy cy; 0 0 1 with positive fx and fy");
  EXPECT_TELLS(fault_of(with("-83.2, 0.5, 0.25", ".Inf, 0., 0.")),
               "`T` holds a value that is not a finite number");
  EXPECT_TELLS(fault_of(with("-83.2, 0.5, 0.25", "0., 0., 0.")), "the baseline (length of T) is zero");
  EXPECT_TELLS(fault_of(with(kR, "1., 0., 0., 0., 1., 0., 0., 0., -1.")), "`R` is no rotation matrix");
  EXPECT_TELLS(fault_of(with(kR, "0., 0., 0., 0., 0., 0., 0., 0., 0.")), "`R` is no rotation matrix");
}

TEST(ReadRig, RefusesWrongShapesAndMissingOrUnknownKeys) {
  EXPECT_TELLS(fault_of(kHead + kSize + cameras()), "`T` is missing; needed is a 3×1 matrix");
  EXPECT_TELLS(fault_of(with(kSize, kSize + "baselin: 3\n")), "`baselin` is no key of a rig");
  EXPECT_TELLS(fault_of(with(kSize, kSize + "image_widht: 3\n")), "did you mean `image_width`?");
  EXPECT_TELLS(fault_of(with(matrix("D1", 1, 5, kD), matrix("D1", 1, 3, "1., 2., 3."))),
               "`D1` is 1×3; it must hold none, 4, 5, 8, 12 or 14 coefficients");
  EXPECT_TELLS(fault_of(with(matrix("K1", 3, 3, kK), matrix("K1", 2, 2, "1., 0., 0., 1."))),
               "`K1` is 2×2; it must be 3×3");
  EXPECT_TELLS(fault_of(with("image_width: 640", "image_width: wide")),
               "`image_width` must be a whole number of pixels");
  EXPECT_TELLS(fault_of(with("K1: !!opencv-matrix", "K1: hello\nK3: !!opencv-matrix")), "K3");
}

TEST(ReadRig, RefusesWhatIsNoYaml) {
  EXPECT_TELLS(fault_of(""), "cannot be read as YAML");
  EXPECT_TELLS(fault_of("hello"), "cannot be read as YAML");
  EXPECT_TELLS(fault_of(kHead + "K1: [ 1, 2\n"), "rig.yaml");
  const TestFolder folder;
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_rig(folder.path())); }), "holds neither rig.yaml");
}

}  // namespace
}  // namespace asterism
