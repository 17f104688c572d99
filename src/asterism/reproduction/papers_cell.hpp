// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/geometry/rigid_motion.hpp"

// A tracker and a moving platform that the paper does not describe but that give its Table 13 and its
// Figure 20: lengths in mm, angles in rad.

namespace asterism {

/// The tracker stands `range_mm` from the middle of the targets (0, 0, 600) and looks at it.
struct TrackerPlace {
  double range_mm = 2000;
  double elevation_rad = rad_from_deg(60);
  double azimuth_rad = rad_from_deg(45);
  double cone_half_angle_rad = rad_from_deg(25);
};

[[nodiscard]] Vec3 tracker_position(const TrackerPlace& place);

/// Two parallel cameras 1 m apart, the middle between them at the tracker's position, 16 mm lenses and
/// 4096 × 3000 pixels of 3.45 µm.
[[nodiscard]] StereoRig stereo_rig();
[[nodiscard]] RigidMotion rig_from_platform(const TrackerPlace& place = {});

/// Eight targets on a ring of 300 mm, 45° apart, alternately 10 mm above and below 600 mm, tilted outward.
struct RingOfTargets {
  double tilt_rad = rad_from_deg(20);
  double acceptance_rad =
      rad_from_deg(60);  // a target is seen up to this angle between its normal and the ray
};

/// One instant of Figure 20.
struct SightOfRing {
  double time_s = 0;
  double turn_x_rad = 0, turn_y_rad = 0;
  int visible = 0;
  double coverage = 0;  // cos of the angle between the platform's normal and the ray; 0 outside the cone
  double off_axis_rad = 0;
};

/// 0 to 12 s at 50 Hz: at rest but for 5 to 9 s, when the platform turns by
/// Rx(15° sin 2π 0.5 τ) Ry(15° sin 2π 0.25 τ) about its origin.
[[nodiscard]] std::vector<SightOfRing> watch_ring(const TrackerPlace& place, const RingOfTargets& ring);

}  // namespace asterism
