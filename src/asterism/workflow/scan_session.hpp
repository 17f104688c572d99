// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/workflow/fuse_scans.hpp"
#include "asterism/workflow/scan_poses.hpp"
#include "asterism/workflow/scan_source.hpp"
#include "asterism/workflow/scan_views.hpp"

namespace asterism {

/// One folder of scans with its poses, ready to be carried into the cloud's frame.
struct ScanSession {
  ScanPoses poses;
  std::string frame;                        // "workpiece", the reference's name, or "tracker"
  std::map<std::string, ScanChain> chains;  // by the body that carries the scanner
  std::optional<ScanSource> source;         // always there once opened
  ScanViews views;
  std::vector<std::string> remarks;

  [[nodiscard]] std::size_t scans() const { return source->entries().size(); }
  /// The chain of a scan, from its points' own frame.
  [[nodiscard]] ScanChain chain_of(std::size_t scan) const;
  /// False: some pose came without, and counts as exact.
  [[nodiscard]] bool covariance_known() const;
};

/// Throws InputError for a folder that is none, without scans or poses.
[[nodiscard]] ScanSession open_session(const FuseScansJob& job, const std::filesystem::path& folder,
                                       const std::optional<Cell>& cell, const Progress& progress);

}  // namespace asterism
