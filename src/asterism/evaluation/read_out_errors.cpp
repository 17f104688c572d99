// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/read_out_errors.hpp"

#include "asterism/core/result.hpp"
#include "asterism/simulation/read_out.hpp"

namespace asterism {

ReadOutErrors read_out_errors(const Cell& cell, std::span<const Vec3> points, std::uint64_t seed) {
  if (!cell.platform)
    throw InputError(cell.name, "has no [platform], whose read-out would be the pose without targets");
  // Read when a picture is taken, so that its age does not count beside its noise.
  Cell in_step = cell;
  in_step.platform->read_out.rate_hz = cell.timing.rate_hz;
  const std::vector<PlatformReading> readings = simulate_read_out(in_step, seed);
  ReadOutErrors errors;
  errors.at_mm.resize(points.size());
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(cell.timing.frames); ++frame) {
    const RigidMotion& read = readings[frame].base_from_body;
    const RigidMotion truth = true_reading(in_step, readings[frame].time_s).base_from_body;
    const auto off = [&](const Vec3& point) { return (truth * point - read * point).norm(); };
    errors.rotation_deg.push_back(deg_from_rad(rotation_angle(truth.rotation, read.rotation)));
    errors.translation_mm.push_back(off(cell.platform->pivot_mm));
    for (std::size_t i = 0; i < points.size(); ++i) errors.at_mm[i].push_back(off(points[i]));
  }
  return errors;
}

}  // namespace asterism
