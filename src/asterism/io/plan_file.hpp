// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "asterism/scanning/scan_plan.hpp"

namespace asterism {

/// A plan as JSON (docs/formats.md tells the keys): the views in their order, the turns of the platform, the
/// figures and the samples.
void write_plan(const std::filesystem::path& file, const ScanPlan& plan);

/// Reads it back. Throws InputError naming the key for a file that is no plan.
[[nodiscard]] ScanPlan read_plan(const std::filesystem::path& file);

}  // namespace asterism
