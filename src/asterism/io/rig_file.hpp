// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

#include "asterism/camera/stereo_rig.hpp"

namespace asterism {

struct ImageSize {
  int width_px = 0, height_px = 0;
};

/// A calibrated pair of cameras from one of
///   rig.yaml             OpenCV FileStorage (YAML, XML, JSON): image_width, image_height, K1 D1 K2 D2 (or
///                        M1 …), R, T, covariance and covariance_order; docs/formats.md has it all
///   intrinsics.yml + extrinsics.yml   of OpenCV's stereo sample: either file, or their folder
///   camchain.yaml        Kalibr, pinhole with radtan or no distortion; its metres become mm
/// Checked by check_rig; throws InputError with the file and what would be right. `size` serves where
/// the file names no image size, as OpenCV's pair does not.
[[nodiscard]] StereoRig read_rig(const std::filesystem::path& file, ImageSize size = {});

void write_rig(const std::filesystem::path& file, const StereoRig& rig);

}  // namespace asterism
