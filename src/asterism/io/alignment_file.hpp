// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "asterism/scanning/alignment.hpp"

namespace asterism {

/// An alignment as JSON: `platform_from_workpiece` (`at_mm`, `quaternion_wxyz`), `covariance` 6×6 (ω rad,
/// δ mm), and how it came about.
[[nodiscard]] nlohmann::ordered_json json_of(const Alignment& alignment);
void write_alignment(const std::filesystem::path& file, const Alignment& alignment);

/// Reads it back; only `platform_from_workpiece` is needed. Throws InputError for what is none, or tells of a
/// motion that is not determined.
[[nodiscard]] Alignment read_alignment(const std::filesystem::path& file);

}  // namespace asterism
