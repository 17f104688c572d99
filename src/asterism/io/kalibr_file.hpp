// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "asterism/camera/stereo_rig.hpp"

namespace asterism {

/// A text with cam0 and cam1 as top keys.
[[nodiscard]] bool is_kalibr_camchain(std::string_view text);

/// Kalibr's camera chain: intrinsics [fu fv cu cv], radtan [k1 k2 p1 p2], T_cn_cnm1 (m) of cam1.
/// Not yet checked by check_rig. Throws InputError with file and line.
[[nodiscard]] StereoRig rig_of_kalibr_camchain(const std::filesystem::path& file, std::string_view text);

}  // namespace asterism
