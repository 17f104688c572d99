// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// A place of a surface with how well it is known along its normal.
struct SurfaceSpot {
  Vec3 at = Vec3::Zero(), normal = Vec3::Zero();
  double variance_mm2 = 0;
};
/// The spot of the other surface (the other scans, a mesh) that a spot may belong to.
using FindSpot = std::function<std::optional<SurfaceSpot>(const SurfaceSpot& spot)>;

struct RegistrationOptions {
  double within_mm = 4;     // spots farther apart along the normal do not belong together
  double free_mm = 0.1;     // a motion that the shape tells worse than this is called not determined
  double flag_p = 0.001;    // a disagreement rarer than this is one,
  double least_mm = 0.5;    // when it is larger than this at the scan's middle,
  double least_deg = 0.25;  // or than this turn,
  double least_gain =
      1.5;                // and the shapes lie so many times closer after it: else it only slides along them
  int most_spots = 4000;  // of one scan
};
void describe(RegistrationOptions& options, OptionVisitor& visit);

/// What one scan's shape says of its tracked pose. Motions are (ω, δ at `about`), along the workpiece's axes.
struct Registration {
  std::size_t pairs = 0;
  Vec3 about = Vec3::Zero();  // middle of its pairs
  double reach_mm = 0;
  Vec6 by_shape = Vec6::Zero();       // the motion that the shape asks for, along what it determines
  double turn_deg = 0, shift_mm = 0;  // its size
  Vec6 correction = Vec6::Zero();     // weighed against the tracked pose
  Mat6 covariance = Mat6::Zero();     // of the pose once it is corrected
  double chi2 = 0;                    // of `by_shape` against tracked pose and shape
  int degrees = 0;                    // of freedom that the shape determines
  double before_mm = 0;               // RMS of the pairs by the tracked pose,
  double rms_mm = 0;                  // and after `by_shape`
  bool disagrees = false;
  std::vector<std::string> free;  // motions that the shape leaves free, in words: not judged
};

enum class RegistrationFailure { TooFewPairs };

/// Point to plane: each spot against the plane of the one that is found for it, again from where that led;
/// pairs that lie far beyond the others do not count. `pose` is the noise of the scan's tracked pose (ω, δ at
/// `origin`), `others` that of what it is held against, as seen there.
[[nodiscard]] Result<Registration, RegistrationFailure> register_scan(std::span<const SurfaceSpot> scan,
                                                                      const FindSpot& find, const Mat6& pose,
                                                                      const Mat6& others, const Vec3& origin,
                                                                      const RegistrationOptions& options);

/// The correction as a motion of places in the workpiece's frame.
[[nodiscard]] RigidMotion motion_of(const Registration& registration);

/// The corrected pose's covariance (ω, δ at another place).
[[nodiscard]] Mat6 covariance_at(const Registration& registration, const Vec3& place);

/// A scan among others, as few spots as will do.
struct ScanSpots {
  int scan = 0;
  std::vector<SurfaceSpot> spots;
  Mat6 noise = Mat6::Zero();  // of its pose at `origin`
  Vec3 origin = Vec3::Zero();
};
/// Each scan against all others. The one that disagrees most is left out of the others before they are judged
/// again, so that it does not put them in the wrong. Nothing for scans with too few others around.
[[nodiscard]] std::vector<std::optional<Registration>> register_scans(std::span<const ScanSpots> scans,
                                                                      const RegistrationOptions& options);

}  // namespace asterism
