// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/cell/scanner.hpp"
#include "asterism/geometry/ray_scene.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

/// Where a candidate came from.
enum class ViewSource { Surface, Sphere, Cylinder, Rings, Targeted };

/// A place from which the scanner might measure.
struct Viewpoint {
  RigidMotion workpiece_from_scanner;
  ViewSource source = ViewSource::Surface;
};

/// The scanner `distance_mm` away from a point along `towards_scanner` (unit), looking back at it, turned
/// about its line of sight by `roll_rad` from where its x axis is level.
[[nodiscard]] RigidMotion looking_at(const Vec3& point, const Vec3& towards_scanner, double distance_mm,
                                     double roll_rad);

/// At the stand-off from samples spread over the surface, the line of sight tilted from the normal by up to
/// `max_tilt_rad` (evenly over the cone), rolled at random. Samples of weight 0 are not looked at.
[[nodiscard]] std::vector<Viewpoint> views_of_surface(std::span<const SurfaceSample> samples,
                                                      std::size_t count, double stand_off_mm,
                                                      double max_tilt_rad, std::uint64_t seed);

/// At the stand-off from where lines towards the middle of the part first meet it, evenly over the sphere;
/// lines that miss it give none.
[[nodiscard]] std::vector<Viewpoint> views_of_sphere(const RayScene& part, const MeshFacts& facts,
                                                     std::size_t count, double stand_off_mm);
/// The same with level lines towards the part's axis along z, evenly over angle and height, from outside and
/// from the axis outwards by turns.
[[nodiscard]] std::vector<Viewpoint> views_of_cylinder(const RayScene& part, const MeshFacts& facts,
                                                       std::size_t count, double stand_off_mm);

/// Azimuths that are left out, degrees from x towards y.
struct Sector {
  double from_deg = 0, to_deg = 0;
};

/// Stations on level rings about z that look square on at a cone: what the paper scans with (Tables 15 and
/// 16; LEDGER 2.6).
struct RingPattern {
  std::vector<double> heights_mm;  // of the stations
  double radius_mm = 0;            // of the stations at z = 0,
  double slope = 0;                // and its growth a millimetre of height
  double step_deg = 10;
  std::vector<Sector> omitted;
  double tilt_deg = 0;  // of the whole pattern, about y
};
[[nodiscard]] std::vector<Viewpoint> views_of_rings(const RingPattern& pattern);

/// Table 15: three rings of 32 stations, 96 in all. Table 16: two rings of 36, 72 in all, for a part that is
/// tilted with the platform (so on the part the rings are level).
[[nodiscard]] RingPattern paper_rings_96();
[[nodiscard]] RingPattern paper_rings_72();

/// Rings around any part: a cone fitted to what faces away from the z axis, rings `pitch_mm` apart.
[[nodiscard]] RingPattern rings_around(std::span<const SurfaceSample> samples, double stand_off_mm,
                                       double pitch_mm, double step_deg);

}  // namespace asterism
