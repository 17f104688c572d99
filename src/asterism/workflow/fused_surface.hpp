// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/cell/cell.hpp"
#include "asterism/workflow/fuse_scans.hpp"

namespace asterism {

/// Holds the cloud against the part's surface, where one is known: completeness, holes, deviation.
void judge_by_surface(const FuseScansJob& job, const std::optional<Cell>& cell, FusedScans& fused);

/// The cloud, fusion.json beside it, and report.html where it was asked for. Nothing without a file.
void write_fused(const FusedScans& fused, const FuseScansJob& job);

}  // namespace asterism
