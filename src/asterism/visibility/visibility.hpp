// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/cell/working_volume.hpp"
#include "asterism/core/options.hpp"
#include "asterism/visibility/seen_motion.hpp"

namespace asterism {

struct VisibilityOptions {
  double margin_px = 5;           // between the target's image and the edge of the picture
  double max_incidence_deg = 60;  // between the target's normal and the line of sight
  double min_diameter_px = 4;     // of the image, across its shorter axis
  double guard_px = 3;            // between the images of two targets
};
void describe(VisibilityOptions& options, OptionVisitor& visit);

/// Why a camera does not see a target, in the order in which it is asked.
/// What stands in the way is asked last and by Occlusion alone; look_at never tells Hidden.
enum class SightFailure { BehindCamera, OutsideVolume, TooOblique, OutsideImage, TooSmall, TooClose, Hidden };
constexpr std::size_t kSightFailures = 7;
[[nodiscard]] std::string_view text_of(SightFailure failure);

/// One target before one camera. A target without a normal counts as seen square on, one without a diameter
/// as big enough. The image's semi-axes are those of a small disc, good to some per cent.
struct TargetSight {
  std::optional<SightFailure> fails;  // the first condition that does not hold; none: seen
  Vec2 px = Vec2::Zero();             // meaningless behind the camera, as is what follows
  double incidence_rad = 0;
  double semi_major_px = 0, semi_minor_px = 0;
  double clearance_px = 0;  // to the next target's image, edge to edge; infinite when there is none
  std::optional<std::size_t> nearest;  // that target
};
[[nodiscard]] std::vector<TargetSight> look_at(std::span<const Target> targets,
                                               const RigidMotion& tracker_from_body, const StereoRig& rig,
                                               Side side, const std::optional<WorkingVolume>& volume,
                                               const VisibilityOptions& options);

/// Bit i: target i.
using TargetMask = std::uint64_t;
constexpr std::size_t kMaxTargets = 64;

/// Which targets each camera sees, by pose. What hides targets besides (the part, the scanner) is another
/// such table; `common` joins them.
struct MotionVisibility {
  std::vector<std::array<TargetMask, 2>> seen;  // [pose][side]

  [[nodiscard]] std::size_t poses() const { return seen.size(); }
  [[nodiscard]] TargetMask both(std::size_t pose) const { return seen[pose][0] & seen[pose][1]; }
};
[[nodiscard]] MotionVisibility common(const MotionVisibility& a, const MotionVisibility& b);

/// At most 64 targets. The second form is for many layouts before the same motion.
[[nodiscard]] MotionVisibility visible_targets(std::span<const Target> targets,
                                               std::span<const RigidMotion> tracker_from_body,
                                               const StereoRig& rig,
                                               const std::optional<WorkingVolume>& volume,
                                               const VisibilityOptions& options);
[[nodiscard]] MotionVisibility visible_targets(std::span<const Target> targets, const SeenMotion& motion,
                                               const std::optional<WorkingVolume>& volume,
                                               const VisibilityOptions& options);

/// How often each condition hid each target from a camera: [target][side][failure], counted over the poses.
using SightFailureCounts = std::vector<std::array<std::array<int, kSightFailures>, 2>>;
[[nodiscard]] SightFailureCounts count_sight_failures(std::span<const Target> targets,
                                                      const SeenMotion& motion,
                                                      const std::optional<WorkingVolume>& volume,
                                                      const VisibilityOptions& options);

}  // namespace asterism
