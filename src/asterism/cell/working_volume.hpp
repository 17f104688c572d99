// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// Where a tracker is good: a frustum before the middle of its two cameras, along their mean line of sight,
/// the width along the baseline. Between the near and the far plane its width and height grow linearly.
struct WorkingVolume {
  double near_mm = 1000;
  double far_mm = 3000;
  double near_width_mm = 800;
  double near_height_mm = 600;
  double far_width_mm = 2600;
  double far_height_mm = 2000;
};
void describe(WorkingVolume& volume, OptionVisitor& visit);

[[nodiscard]] double volume_m3(const WorkingVolume& volume);

/// The same volume with its far plane moved along its sides until it holds so many m³.
[[nodiscard]] WorkingVolume extended_to(WorkingVolume volume, double m3);

/// Volumes that makers of trackers state, by name: "9.1 m3" and "16.6 m3". Their shapes are not published;
/// these are WorkingVolume{} extended to that many m³ (far planes at 3658 and 4431 mm).
[[nodiscard]] std::vector<std::string> working_volume_presets();
/// Throws InputError for another name.
[[nodiscard]] WorkingVolume working_volume_of(const std::string& preset);

/// Throws InputError when a size is outside its limits or the far plane is not beyond the near one.
void check_working_volume(const WorkingVolume& volume, const std::string& where);

/// The frame the volume is stated in: origin between the two centres of projection, z along the mean of the
/// two optical axes, x along the baseline as nearly as can be.
[[nodiscard]] RigidMotion tracker_from_middle(const StereoRig& rig);

[[nodiscard]] bool contains(const WorkingVolume& volume, const Vec3& in_middle);

}  // namespace asterism
