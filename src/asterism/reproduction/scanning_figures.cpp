// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/scanning_figures.hpp"

#include <cmath>

#include "asterism/reproduction/drawing.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/reproduction/scan_rings.hpp"

namespace asterism {
namespace {

Exhibit stations(const std::string& id, const std::string& title, const std::string& caption,
                 std::span<const Vec3> points) {
  const ScanRings rings = fit_rings(points);
  const RigidMotion turned{exp_rotation({0, rad_from_deg(rings.tilt_deg), 0}), Vec3::Zero()};
  SpaceDrawing drawing(-65, 38);
  for (const ScanRing& ring : rings.rings) {
    std::vector<Vec3> circle;
    for (int i = 0; i < 120; ++i) {
      const double angle = rad_from_deg(3.0 * i);
      circle.push_back(turned *
                       Vec3(ring.radius_mm * std::cos(angle), ring.radius_mm * std::sin(angle), ring.z_mm));
    }
    drawing.loop(circle, "soft");
  }
  for (const Vec3& point : points) drawing.point(point, "s1", "", 3);
  drawing.axes({}, 250, "");
  return {id, title, caption, drawing.str(560, 380, title)};
}

}  // namespace

std::vector<Exhibit> scanning_exhibits() {
  return {stations("T15", "Table 15. Scanning stations, platform level",
                   "93 stations as printed on the rings fitted to them: each quadrant lacks 72° and 81°, and "
                   "one row of three is "
                   "missing in print on the upper ring.",
                   printed::table15()),
          stations("T16", "Table 16. Scanning stations, platform tilted",
                   "72 stations: two full rings turned by 10° about y.", printed::table16())};
}

}  // namespace asterism
