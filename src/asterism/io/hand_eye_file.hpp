// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "asterism/io/motion_json.hpp"
#include "asterism/scanning/hand_eye.hpp"

namespace asterism {

/// Where a scanner sits in its body, as JSON: `body_from_scanner`, its `covariance`, and how well the views
/// agree.
[[nodiscard]] nlohmann::ordered_json json_of(const HandEye& found, std::size_t views);

/// Reads `body_from_scanner` and its covariance back. Throws InputError for what is none.
[[nodiscard]] KnownMotion read_hand_eye(const std::filesystem::path& file);

}  // namespace asterism
