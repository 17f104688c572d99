// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "asterism/camera/lens_lanes.hpp"
#include "asterism/visibility/visibility.hpp"

// The one place where the conditions of sight are asked, for four poses at a time; masks, reasons and counts
// are all read off what it finds.

namespace asterism {

/// One target before one camera in four poses.
struct alignas(kLanesAlignment) SightLanes {
  DoubleLanes u, v;           // px
  DoubleLanes cosine_square;  // of the incidence; negative for a target that faces away
  DoubleLanes major, minor_square;
  MaskLanes shines;   // before the camera and turned to it: other images must keep clear of its own
  MaskLanes failure;  // 0: seen; else 1 + the first SightFailure
};

/// What all poses share.
class SightConditions {
 public:
  SightConditions(std::span<const Target> targets, const StereoRig& rig,
                  const std::optional<WorkingVolume>& volume, const VisibilityOptions& options);

  using Sights = std::array<std::array<SightLanes, kMaxTargets>, 2>;  // [side][target]
  void look(const MotionLanes& left, const MotionLanes& right, Sights& sights) const;

  [[nodiscard]] std::size_t targets() const { return count_; }

 private:
  struct Disc {
    double position[3], normal[3], radius;
    bool has_normal, has_size;
  };
  std::array<Disc, kMaxTargets> discs_;
  std::size_t count_;
  std::array<LensForLanes, 2> lenses_;
  std::optional<WorkingVolume> volume_;
  Mat3 middle_from_tracker_;
  Vec3 tracker_in_middle_;
  double margin_px_, guard_px_, min_cosine_square_, min_minor_square_;

  friend struct SightKernel;
};

}  // namespace asterism
