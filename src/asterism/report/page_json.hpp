// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/report/summary_row.hpp"

// What the data blocks of all pages share (web/src/data/parts.ts).

namespace asterism {

/// Fewer digits than a double holds, more than any measurement here is worth: a third of the file's size.
/// Null for a number that is not finite.
[[nodiscard]] nlohmann::json decimals(double value, int places);
[[nodiscard]] nlohmann::json digits(double value, int count);
[[nodiscard]] nlohmann::json json_of(const Vec3& v, int places = 5);

/// Adds x y z, w x y z to a row.
void append_motion(nlohmann::json& row, const RigidMotion& motion);
[[nodiscard]] bool is_finite(const RigidMotion& motion);

[[nodiscard]] nlohmann::json json_of_rig(const StereoRig& rig);
[[nodiscard]] nlohmann::json json_of_target(const Target& target);
[[nodiscard]] nlohmann::json json_of_summary(const std::vector<SummaryRow>& rows);

/// JSON text as it was stored; null for none.
[[nodiscard]] nlohmann::json json_of_stored(const std::string& text);

}  // namespace asterism
