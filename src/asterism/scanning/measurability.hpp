// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/scanning/bit_rows.hpp"
#include "asterism/scanning/scan_plan.hpp"
#include "asterism/scanning/scan_scene.hpp"
#include "asterism/scanning/viewpoints.hpp"

namespace asterism {

/// Which limits are asked, by ScanLimit.
struct AskedLimits {
  std::array<bool, kScanLimits> on = {true, true, true, true, true, true, true, true, true, true};
  [[nodiscard]] bool operator[](ScanLimit limit) const { return on[static_cast<std::size_t>(limit)]; }
};

/// A set of limits as bits.
using LimitMask = std::uint32_t;
[[nodiscard]] constexpr LimitMask mask_of(ScanLimit limit) {
  return LimitMask{1} << static_cast<unsigned>(limit);
}

/// What the scanner measures of a place, by geometry alone (the measurability matrix of Scott, Roth & Rivest,
/// ACM Computing Surveys 35 (2003) 64). With z the place's depth in the scanner's frame:
///   range      near ≤ z ≤ far
///   field      |x| ≤ z width / (2 stand-off), |y| likewise
///   incidence  at most its largest, between the normal and the way to the scanner's origin
///   sight      projector (x = −baseline/2) and camera (+) stand before the surface, seen at less than 85°,
///              and nothing lies between
/// All that can be told of one sample without asking what lies between.
[[nodiscard]] LimitMask failing_limits(const Scanner& scanner, const RigidMotion& scanner_from_workpiece,
                                       const SurfaceSample& sample);

/// Row: viewpoint, column: sample, for range, field, incidence and sight past `hiding` (the part). Samples
/// that are neighbours in their order are best neighbours in space, as sample_surface gives them: they are
/// looked at by 64, and 64 that are out of the field are told so at once.
[[nodiscard]] BitRows measured_samples(std::span<const Viewpoint> views,
                                       std::span<const SurfaceSample> samples, const Scanner& scanner,
                                       const RayScene& hiding, const AskedLimits& asked);

/// Takes out of such rows what something else hides (fixtures).
void take_out_hidden(std::span<const Viewpoint> views, std::span<const SurfaceSample> samples,
                     const Scanner& scanner, const RayScene& hiding, BitRows& rows);

/// Do projector and camera both see the place?
[[nodiscard]] bool in_sight(const Scanner& scanner, const RigidMotion& workpiece_from_scanner,
                            const SurfaceSample& sample, const RayScene& hiding);

/// Is the ball about the scanner's origin free of a surface?
[[nodiscard]] bool is_clear(const Scanner& scanner, const Vec3& origin, const SurfaceTree& surface);

}  // namespace asterism
