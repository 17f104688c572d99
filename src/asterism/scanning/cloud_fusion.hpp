// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/core/options.hpp"
#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/measurement/scan.hpp"

namespace asterism {

/// Where the scanner was at a moment, on the part:
///   workpiece_from_scanner = (tracker_from_workpiece)⁻¹ · tracker_from_scanner   (paper Eqs. 19–22)
struct ScannerPose {
  RigidMotion workpiece_from_scanner;
  Mat6 noise = Mat6::Zero();  // ω (rad), δ (mm) at the scanner's origin, along the workpiece's axes: changes
                              // from scan to scan
  Mat6 systematic = Mat6::Zero();  // the same in all scans: rig, maps of the targets, hand–eye, alignment
};

/// A point on its way into the cloud.
struct CarriedPoint {
  Vec3 at;                           // mm, in the workpiece's frame
  Vec3f normal;                      // unit, towards the scanner; zero = not known
  std::array<float, 6> scanner_mm2;  // covariance by the scanner alone: xx xy xz yy yz zz
  float range_mm, cos_incidence;
  std::uint32_t pose;  // which of the scan's poses carried it
};

struct CloudFusionOptions {
  double voxel_mm = 1;       // points of one voxel that face one way become one
  double outlier_p = 0.001;  // a point is refused when χ² against the others of its voxel is rarer than this
  int min_points = 1;        // a voxel with fewer is left out
};
void describe(CloudFusionOptions& options, OptionVisitor& visit);

/// A point of the fused cloud.
struct FusedPoint {
  Vec3 at;  // mm
  Vec3f normal;
  Mat3 covariance;                        // mm², all of it: scanner, both poses, alignment
  std::uint32_t points = 0;               // that went into it
  std::uint16_t scans = 0;                // from so many scans
  std::int32_t scan = 0;                  // the one that gave most of it
  float incidence_deg = 0, range_mm = 0;  // means
};

struct FusedCloud {
  std::vector<FusedPoint> points;
  std::size_t points_in = 0, outliers = 0;  // taken in; refused by χ²
  std::size_t few = 0;                      // points of voxels that had too few
  // Do scans agree as their covariances say? In voxels that parts of several scans share: the median of
  // χ² along the normal of one against the others, over what it is to be: 1 when they do.
  std::size_t shared = 0;
  double disagreement = 0;
  double apart_mm = 0, stated_mm = 0;  // one scan's noise along the normal: as told by that, as stated
};
/// With fields sigma_mm (along the normal), points, scans, scan, incidence_deg, range_mm.
[[nodiscard]] Cloud cloud_of(const FusedCloud& fused);

/// Takes points scan after scan; what it keeps grows with the voxels, not with the points.
///
/// Points of a voxel that face one way (within 45°) become one. Inside a part of a scan they are weighed by
/// w = 1/(nᵀ C n), C the scanner's covariance, n the normal: along the normal this is the inverse-covariance
/// mean, and since it only weighs places, the mean of places on a plane lies on it. Its noise is
/// Σ w² C / (Σ w)² plus that of the scan's pose, which all of its points have in common. The parts are then
/// weighed by 1/(nᵀ N n); what is systematic never becomes smaller. A part that its voxel's others contradict
/// (χ² along the normal, one degree) is refused, the worst first, so that who came first does not matter;
/// where two stand alone against each other the one of fewer points is.
class CloudFusion {
 public:
  explicit CloudFusion(const CloudFusionOptions& options);

  /// Points of a part of a scan: its poses' noise is common to all of them. More points of the same part may
  /// follow at once; `part` counts the parts of one scan. Throws InputError when the cloud is too wide for
  /// the voxels (2²⁰ of them to each side).
  void add(int scan, int part, std::span<const ScannerPose> poses, std::span<const CarriedPoint> points);

  /// All so far. The same for any number of threads.
  [[nodiscard]] FusedCloud cloud();

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace asterism
