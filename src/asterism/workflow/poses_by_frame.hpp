// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "asterism/io/motion_json.hpp"
#include "asterism/measurement/pose_record.hpp"

namespace asterism {

/// How well a pose is known that tells no covariance of itself, each axis.
struct StatedSigma {
  double mm = 0.02, deg = 0.005;
};
/// ω (rad), δ (mm).
[[nodiscard]] Mat6 covariance_of(const StatedSigma& stated);

/// The measured poses of one body, by frame; `body` empty: of the only one that there is. `file` is for
/// messages. Throws InputError where there is none, or where several bodies are told of and none was named.
[[nodiscard]] std::map<int, KnownMotion> poses_by_frame(std::span<const PoseRecord> records,
                                                        const std::string& body, const StatedSigma& stated,
                                                        const std::filesystem::path& file);

}  // namespace asterism
