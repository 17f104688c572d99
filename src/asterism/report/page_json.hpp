// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/cell/working_volume.hpp"
#include "asterism/report/summary_row.hpp"

// What the data blocks of all pages share (web/src/data/parts.ts).

namespace asterism {

/// Fewer digits than a double holds, more than any measurement here is worth: a third of the file's size.
/// Null for a number that is not finite.
[[nodiscard]] nlohmann::json decimals(double value, int places);
[[nodiscard]] nlohmann::json digits(double value, int count);
[[nodiscard]] nlohmann::json json_of(const Vec3& v, int places = 5);

/// x y z, w x y z: by itself, or added to a row.
[[nodiscard]] nlohmann::json json_of_motion(const RigidMotion& motion);
void append_motion(nlohmann::json& row, const RigidMotion& motion);
/// Adds xx xy xz yy yz zz to a row.
void append_upper(nlohmann::json& row, const Mat3& covariance);
[[nodiscard]] bool is_finite(const RigidMotion& motion);

[[nodiscard]] nlohmann::json json_of_rig(const StereoRig& rig);
[[nodiscard]] nlohmann::json json_of_volume(const std::optional<WorkingVolume>& volume, const StereoRig& rig);
[[nodiscard]] nlohmann::json json_of_target(const Target& target);
[[nodiscard]] const char* word_of(Verdict verdict);
[[nodiscard]] nlohmann::json json_of_summary(const std::vector<SummaryRow>& rows);

/// JSON text as it was stored; null for none.
[[nodiscard]] nlohmann::json json_of_stored(const std::string& text);

}  // namespace asterism
