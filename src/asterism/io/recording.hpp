// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/core/result.hpp"
#include "asterism/measurement/frame.hpp"

namespace asterism {

/// One moment of a recording; an empty path = that camera lost the frame.
struct FrameEntry {
  int frame = 0;
  double time_s = 0;
  std::string left, right;  // relative to the recording's folder
};

/// What two cameras took of bodies in motion, with what is known of them.
struct Recording {
  std::filesystem::path folder;
  std::optional<StereoRig> rig;
  std::optional<std::vector<Body>> bodies;
  std::vector<FrameEntry> frames;
  std::optional<std::vector<StereoCentres>> centres;  // found already, one a frame: then there are no images
};

/// Opens a folder with frames.csv (`frame,time_s,left,right`) or centres.csv, and rig.yaml and bodies.toml
/// where they are there. Throws InputError, with the line, for an image that is absent, a frame given
/// twice, a time that goes back, a rig or bodies that are wrong.
[[nodiscard]] Recording open_recording(const std::filesystem::path& folder);

/// A recording of loose images, paired in order; frame i is taken at i / rate_hz.
[[nodiscard]] Recording recording_of_images(const std::vector<std::filesystem::path>& left,
                                            const std::vector<std::filesystem::path>& right, double rate_hz);

/// An image that the rig's cameras did not take.
class WrongImageSize : public InputError {
 public:
  using InputError::InputError;
};

/// Reads both images of a frame. Throws InputError for one that is missing or cut off, WrongImageSize for
/// one whose size is not the rig's.
[[nodiscard]] StereoImage read_frame(const Recording& recording, std::size_t index);

/// One of them; empty when the camera lost the frame.
[[nodiscard]] std::optional<Image> read_frame_image(const Recording& recording, std::size_t index, Side side);

}  // namespace asterism
