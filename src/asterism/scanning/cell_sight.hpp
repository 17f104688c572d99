// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "asterism/accuracy/accuracy_options.hpp"
#include "asterism/scanning/measurability.hpp"
#include "asterism/scanning/platform_poses.hpp"
#include "asterism/visibility/occlusion.hpp"

namespace asterism {

/// One view in one pose of the platform, as this cell has it.
struct Sighting {
  LimitMask fails = 0;  // of Clearance (from what does not move with the part), Floor, ScannerTargets,
                        // PlatformTargets, and Uncertainty where a pose is not determined
  int scanner_targets = 0, platform_targets = 0;  // seen by both cameras
  std::optional<Mat6> covariance;                 // of workpiece_from_scanner; none where something fails
};

/// What the tracker sees of scanner and platform, all bodies placed: targets inside the working volume and
/// both images, not too oblique, hidden by nothing (part, fixtures, the scanner's own housing). The pose's
/// covariance is the chain's, workpiece_from_scanner = (tracker_from_workpiece)⁻¹ tracker_from_body
/// body_from_scanner: Cramér–Rao bounds of both bodies, and the scanner's place on its body. Where the part
/// stands on the platform is taken as known.
class CellSight {
 public:
  /// Throws InputError for a cell without scanner or workpiece.
  CellSight(const Cell& cell, std::vector<PlatformPose> poses, int targets);

  [[nodiscard]] const std::vector<PlatformPose>& poses() const { return poses_; }
  /// Where the scanner's body then is.
  [[nodiscard]] RigidMotion tracker_from_body(std::size_t pose,
                                              const RigidMotion& workpiece_from_scanner) const;
  [[nodiscard]] RigidMotion tracker_from_part(std::size_t pose) const { return part_[pose]; }
  /// In parallel.
  [[nodiscard]] std::vector<Sighting> look(std::size_t pose,
                                           std::span<const RigidMotion> workpiece_from_scanner) const;

 private:
  /// What the pose of the platform alone decides.
  struct PlatformSight {
    std::vector<RigidMotion> movers;  // scanner where it begins
    std::array<TargetMask, 2> seen{};
    std::optional<Mat6> covariance;  // of tracker_from_platform, as `seen`
  };
  [[nodiscard]] PlatformSight sight_of(const PlatformPose& pose) const;
  void look_at_some(std::size_t pose, std::span<const RigidMotion> views, std::span<Sighting> out) const;
  [[nodiscard]] std::optional<Mat6> covariance_of(std::size_t body, const std::array<TargetMask, 2>& seen,
                                                  const RigidMotion& tracker_from_body) const;
  void place(Sighting& sighting, std::size_t pose, const RigidMotion& workpiece_from_scanner) const;

  Cell cell_;
  std::vector<PlatformPose> poses_;
  std::vector<RigidMotion> part_;  // tracker_from_workpiece, by pose
  int targets_;
  std::size_t scanner_, platform_;  // movers; platform_ = none when the part stands still in `tracker`
  AccuracyOptions accuracy_;
  Occlusion others_, housing_;  // all but what moves with the scanner; that alone
  SurfaceTree surroundings_;
  std::vector<PlatformSight> platform_sights_;
};

/// Standard deviation of a point along its normal: the scanner's pose and its own noise.
[[nodiscard]] double sigma_along_normal_mm(const Scanner& scanner, const RigidMotion& workpiece_from_scanner,
                                           const Mat6& covariance, const SurfaceSample& sample);

}  // namespace asterism
