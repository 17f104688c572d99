// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/core/progress.hpp"
#include "asterism/io/scan_folder.hpp"
#include "asterism/scanning/scan_surface.hpp"

namespace asterism {

/// What reading a scan told of it.
struct ScanSurvey {
  std::size_t points = 0, not_finite = 0, outliers = 0;
  double roughness_mm = 0, spacing_mm = 0;
  double depth_mm = 0;      // median of its points' z
  double across_mm = 0;     // from corner to corner of its box
  bool from_origin = true;  // its frame's origin is where it was seen from
  Vec3 centre = Vec3::Zero();
  Mat3 facing = Mat3::Zero();  // Σ n nᵀ
};

/// The scans of a folder, in millimetres, cleaned of outliers, with normals. They are kept when there are
/// few enough points, else read again when asked for again, and a large one is told in pieces: memory has a
/// bound.
class ScanSource {
 public:
  /// Throws InputError, with the hint that would be right, for scans whose size cannot be: a thousand times
  /// too small for the scanner, or for the other scans.
  ScanSource(std::filesystem::path folder, std::vector<ScanEntry> entries, double mm_each,
             const std::optional<Scanner>& scanner, const ScanSurfaceOptions& options,
             const Progress& progress);

  [[nodiscard]] const std::vector<ScanEntry>& entries() const { return entries_; }
  [[nodiscard]] const std::vector<ScanSurvey>& surveys() const { return surveys_; }
  /// The scanner of the cell, or one whose noise is what the scans themselves tell.
  [[nodiscard]] const Scanner& scanner() const { return scanner_; }

  void each_piece(std::size_t scan, const std::function<void(const Scan&)>& take) const;

 private:
  void read(std::size_t scan, const std::function<void(Scan&&, const ScanSurface&)>& take,
            std::size_t& not_finite) const;

  std::filesystem::path folder_;
  std::vector<ScanEntry> entries_;
  double mm_each_;
  Scanner scanner_;
  ScanSurfaceOptions options_;
  std::vector<ScanSurvey> surveys_;
  std::vector<std::vector<Scan>> kept_;  // empty when there are too many points
};

}  // namespace asterism
