// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "asterism/geometry/rigid_motion.hpp"

// How JSON files tell a rigid motion: `at_mm` and `quaternion_wxyz`; and its covariance, 6×6 (ω rad, δ mm).

namespace asterism {

struct KnownMotion {
  RigidMotion motion;
  Mat6 covariance = Mat6::Zero();  // zero where the file tells none
};

[[nodiscard]] nlohmann::ordered_json json_of(const RigidMotion& motion);
[[nodiscard]] nlohmann::ordered_json json_of(const Mat6& covariance);

/// The motion under `key` and `covariance` beside it. Throws InputError, with `hint`, where it is none.
[[nodiscard]] KnownMotion motion_under(const nlohmann::json& json, const std::string& key,
                                       const std::filesystem::path& file, const std::string& hint);

}  // namespace asterism
