// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "asterism/measurement/scan.hpp"

namespace asterism {

/// A line of scans.csv: `scan,file,time_s,body`.
struct ScanEntry {
  int scan = 0;
  std::string file;              // relative to the folder
  std::optional<double> time_s;  // none: the points tell theirs
  std::string body = "scanner";
};

/// The scans of a folder by its scans.csv, of which `scan` and `file` are needed. Throws InputError, with the
/// line, for a file that is absent or a number given twice.
[[nodiscard]] std::vector<ScanEntry> read_scan_entries(const std::filesystem::path& folder);

/// A scan and how many of its points were left out since they are not finite.
struct ReadScan {
  Scan scan;
  std::size_t not_finite = 0;
};
/// `scalar_time_s` gives each point its moment; normals are taken where they are there. Points whose place or
/// moment is not finite are left out. An empty scan is allowed. Throws InputError when neither the file nor
/// scans.csv tells a time.
[[nodiscard]] ReadScan read_scan(const std::filesystem::path& folder, const ScanEntry& entry);

/// The same piece by piece, of at most so many points each, so that memory does not grow with the file; a
/// scan without points gives no piece. Returns how many points were left out.
std::size_t read_scan_pieces(const std::filesystem::path& folder, const ScanEntry& entry, std::size_t most,
                             const std::function<void(Scan&&)>& take);

/// scans/NNN.ply (single precision) and a line each in scans.csv, which comes last.
void write_scan(const std::filesystem::path& folder, const Scan& scan);
void write_scan_entries(const std::filesystem::path& folder, const std::vector<ScanEntry>& entries);
[[nodiscard]] ScanEntry entry_of(const Scan& scan);

}  // namespace asterism
