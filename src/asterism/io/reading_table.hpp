// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "asterism/measurement/reading.hpp"

namespace asterism {

/// What a platform said of itself: time_s, x_mm … qz, and if known sigma_x_mm … sigma_rz_deg. Without sigmas
/// a reading is taken to be as good as cell/platform.hpp has it by default, its jumps included. Throws
/// InputError when times do not increase.
[[nodiscard]] std::vector<PlatformReading> read_readings(const std::filesystem::path& file);

void write_readings(const std::filesystem::path& file, std::span<const PlatformReading> readings);

}  // namespace asterism
