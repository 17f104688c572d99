// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/working_volume.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr struct {
  const char* name;
  double m3;
} kPresets[] = {{"9.1 m3", 9.1}, {"16.6 m3", 16.6}};

}  // namespace

void describe(WorkingVolume& volume, OptionVisitor& visit) {
  constexpr Limits kSize = {1, 1e6};
  visit.number("near_mm", volume.near_mm, kSize, "the near plane, from the middle of the cameras");
  visit.number("far_mm", volume.far_mm, kSize, "the far plane");
  visit.number("near_width_mm", volume.near_width_mm, kSize, "width of the near plane, along the baseline");
  visit.number("near_height_mm", volume.near_height_mm, kSize, "height of the near plane");
  visit.number("far_width_mm", volume.far_width_mm, kSize, "width of the far plane");
  visit.number("far_height_mm", volume.far_height_mm, kSize, "height of the far plane");
}

double volume_m3(const WorkingVolume& volume) {
  // Width times height is of second degree in the depth, so Simpson's rule is exact.
  const double middle =
      0.25 * (volume.near_width_mm + volume.far_width_mm) * (volume.near_height_mm + volume.far_height_mm);
  const double near = volume.near_width_mm * volume.near_height_mm;
  const double far = volume.far_width_mm * volume.far_height_mm;
  return 1e-9 * (volume.far_mm - volume.near_mm) * (near + 4 * middle + far) / 6;
}

WorkingVolume extended_to(WorkingVolume volume, double m3) {
  require(m3 > 0, "a volume to extend to is positive");
  const double depth = volume.far_mm - volume.near_mm;
  const double widening = (volume.far_width_mm - volume.near_width_mm) / depth;
  const double heightening = (volume.far_height_mm - volume.near_height_mm) / depth;
  // d(volume)/d(far plane) is the far plane's area: Newton from the volume that is there.
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double missing = m3 - volume_m3(volume);
    const double step = 1e9 * missing / (volume.far_width_mm * volume.far_height_mm);
    volume.far_mm += step;
    volume.far_width_mm += widening * step;
    volume.far_height_mm += heightening * step;
    if (std::abs(missing) < 1e-14 * m3) break;
  }
  return volume;
}

std::vector<std::string> working_volume_presets() {
  std::vector<std::string> names;
  for (const auto& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

WorkingVolume working_volume_of(const std::string& preset) {
  for (const auto& known : kPresets) {
    if (preset == known.name) return extended_to(WorkingVolume{}, known.m3);
  }
  throw InputError(fmt::format("`{}` is no working volume; known are: {}", preset,
                               fmt::join(working_volume_presets(), ", ")));
}

void check_working_volume(const WorkingVolume& volume, const std::string& where) {
  WorkingVolume copy = volume;
  LimitsCheck limits;
  try {
    describe(copy, limits);
  } catch (const InputError& error) {
    throw InputError(where + ": working volume", error.what());
  }
  if (!(volume.far_mm > volume.near_mm)) {
    throw InputError(where,
                     fmt::format("the working volume's far plane ({} mm) must lie beyond its near plane "
                                 "({} mm)",
                                 volume.far_mm, volume.near_mm));
  }
}

RigidMotion tracker_from_middle(const StereoRig& rig) {
  const RigidMotion left_from_right = rig.right_from_left.inverse();
  Mat3 axes;
  axes.col(0) = left_from_right.translation.normalized();
  const Vec3 ahead = Vec3::UnitZ() + left_from_right.rotation * Vec3::UnitZ();
  axes.col(2) = (ahead - ahead.dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {quaternion_from_matrix(axes), 0.5 * left_from_right.translation};
}

bool contains(const WorkingVolume& volume, const Vec3& in_middle) {
  const double share = (in_middle.z() - volume.near_mm) / (volume.far_mm - volume.near_mm);
  if (!(share >= 0 && share <= 1)) return false;
  const double width = volume.near_width_mm + share * (volume.far_width_mm - volume.near_width_mm);
  const double height = volume.near_height_mm + share * (volume.far_height_mm - volume.near_height_mm);
  return std::abs(in_middle.x()) <= 0.5 * width && std::abs(in_middle.y()) <= 0.5 * height;
}

}  // namespace asterism
