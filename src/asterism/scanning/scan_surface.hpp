// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/core/options.hpp"
#include "asterism/measurement/scan.hpp"

namespace asterism {

struct ScanSurfaceOptions {
  int neighbours = 10;       // that tell a point's plane
  double isolated_p = 1e-4;  // a point that lies off its neighbours' plane less likely than this is refused
};
void describe(ScanSurfaceOptions& options, OptionVisitor& visit);

/// What a scan's points tell of one another.
struct ScanSurface {
  std::vector<Vec3f> normals;         // one a point; unit, towards the scanner
  std::vector<std::uint8_t> outlier;  // by point
  std::size_t outliers = 0;
  double roughness_mm = 0;  // how far points lie off their neighbours' plane: the scanner's noise as the scan
                            // itself tells it, by the median, so that neither outliers nor edges count
  double spacing_mm = 0;    // from a point to its next, by the median
};

/// Each point's plane through its nearest neighbours, without itself and without the worst of them. A point
/// off it by more than the scanner's noise and the neighbours' own spread allow is an outlier: those that
/// scanners make come singly and lie far off along the line of sight, where no voxel of another point tests
/// them. Edges and curved places spread their neighbours and so are let be.
[[nodiscard]] ScanSurface surface_of(const Scan& scan, const Scanner& scanner,
                                     const ScanSurfaceOptions& options);

/// The scan without its outliers, with normals: its own where it has them.
[[nodiscard]] Scan cleaned(Scan scan, const ScanSurface& surface);

/// Published scans are often told in a frame whose origin is not where the scanner was: then points lie
/// behind it, or farther off its axis than any scanner sees.
[[nodiscard]] bool seen_from_origin(const Scan& scan);

}  // namespace asterism
