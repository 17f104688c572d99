// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/reproduction/scan_claims.hpp"
#include "asterism/reproduction/scan_rings.hpp"
#include "asterism/reproduction/scanning_figures.hpp"

namespace asterism {
namespace {

std::string ring_text(const ScanRings& rings) {
  std::string text;
  for (const ScanRing& ring : rings.rings) {
    text += fmt::format("{}z {:.0f}: {} points at {:.2f} mm", text.empty() ? "" : "; ", ring.z_mm,
                        ring.points, ring.radius_mm);
  }
  return text;
}

void add_counts(std::vector<LedgerRow>& rows, const ScanRings& upright, const ScanRings& tilted) {
  const double printed15 = static_cast<double>(upright.points),
               printed16 = static_cast<double>(tilted.points);
  const double whole = static_cast<double>(upright.pattern_points);
  const std::string missing = fmt::format(
      "{} points are printed; {} rings of {} make {:.0f}: one row of three is missing in print (z = 400)",
      upright.points, upright.rings.size(), upright.pattern_points / upright.rings.size(), whole);
  rows.push_back(compare({"T15.n", "Table 15", "scanning points (96 by the 25 % of Section 4.3)", "96"},
                         printed15, {"points printed", missing, ""}));
  rows.push_back(compare({"T16.n", "Table 16", "scanning points (72 = 96 less 25 %)", "72"}, printed16,
                         {"points printed: " + ring_text(tilted), "", ""}));
  const Account counts{
      fmt::format("{:.0f} points (the completed pattern of Table 15) against {}", whole, tilted.points), "",
      fmt::format("with the {} printed points {:.2f} % fewer and {:.2f} % gained", upright.points,
                  100 * (1 - printed16 / printed15), 100 * (printed15 / printed16 - 1))};
  const double fewer = 100 * (1 - printed16 / whole), gain = 100 * (whole / printed16 - 1);
  rows.push_back(compare({"S43.25", "Section 4.3", "fewer points, %", "25"}, fewer, counts));
  rows.push_back(told_again(rows.back(), "P.43.points_reduction", "Section 4.3"));
  rows.push_back(compare({"S43.33", "Section 4.3, abstract", "gain in efficiency, %", "33.3"}, gain, counts));
  rows.push_back(told_again(rows.back(), "P.43.efficiency_gain", "Section 4.3"));
}

/// Section 4.3's "initial scanning position (789.48, −125.04, 499), scanning angle 6.12°".
void add_start(std::vector<LedgerRow>& rows, const ScanRings& upright) {
  const Vec3 start(789.48, -125.04, 499);
  const auto table = printed::table15();
  const auto apart = [&](const Vec3& station) {  // the sign of y is in question
    return (Vec3(station.x(), -std::abs(station.y()), station.z()) - start).norm();
  };
  const Vec3 nearest = *std::min_element(table.begin(), table.end(),
                                         [&](const Vec3& a, const Vec3& b) { return apart(a) < apart(b); });
  const std::string definition =
      fmt::format("nearest point of Table 15, either sign of y: ({:g}, {:g}, {:g})", nearest.x(), nearest.y(),
                  nearest.z());
  const double radius = upright.radius_at_zero_mm + upright.slope * start.z();
  rows.push_back(compare({"P.43.initial_scan_x", "Section 4.3", "first scanning position, x mm", "789.48"},
                         nearest.x(), {definition, "", ""}));
  rows.push_back(compare({"P.43.initial_scan_y", "Section 4.3", "first scanning position, y mm", "-125.04"},
                         nearest.y(), {definition, "its azimuth of 351° is none of Table 15's", ""}));
  rows.push_back(compare(
      {"P.43.initial_scan_z", "Section 4.3", "first scanning position, z mm", "499"}, nearest.z(),
      {definition,
       fmt::format("its radius is that of the ring at z = 400; at 499 the cone has {:.2f} mm", radius), ""}));
  rows.push_back(judge(
      {"S43.init", "Section 4.3", "first scanning position is a station, mm", "(789.48, -125.04, 499)"},
      fmt::format("({:g}, {:g}, {:g})", nearest.x(), nearest.y(), nearest.z()),
      (nearest - start).norm() < 0.01, {definition, "y has the other sign and z is 400 in Table 15", ""}));
  const double angle = deg_from_rad(std::atan(upright.slope));
  const Account cone{fmt::format("half-angle of the cone through Table 15: radius = {:.2f} + {:.4f} z",
                                 upright.radius_at_zero_mm, upright.slope),
                     "no angle of the table is 6.12°", ""};
  rows.push_back(compare({"S43.ang", "Section 4.3", "scanning angle, deg", "6.12"}, angle, cone));
  rows.push_back(told_again(rows.back(), "P.43.scan_angle", "Section 4.3"));
}

/// Rings, steps and tilt that the printed coordinates follow.
void add_pattern(std::vector<LedgerRow>& rows, const ScanRings& upright, const ScanRings& tilted) {
  rows.push_back(
      judge({"T15.rings", "Table 15", "every point lies on a ring of one radius and a whole step of azimuth",
             "to the printed digits"},
            ring_text(upright) +
                fmt::format("; step {:g}°; residual {:.4f} mm", upright.step_deg, upright.residual_mm),
            upright.residual_mm <= 0.01,
            {"rings fitted to the printed points; 0.01 mm, as some digits are cut and not rounded", "", ""}));
  rows.push_back(judge(
      {"T16.rings", "Table 16", "every point lies on such a ring turned about y", "to the printed digits"},
      ring_text(tilted) + fmt::format("; step {:g}°; tilt {:.2f}°; residual {:.3f} mm", tilted.step_deg,
                                      tilted.tilt_deg, tilted.residual_mm),
      tilted.residual_mm <= 0.1,
      {"rings fitted to the printed points; 0.1 mm, as one ring is printed to 0.1 mm in part", "", ""}));
  rows.push_back(
      judge({"T16.tilt", "Tables 8, 16", "tilt of the platform, within its stroke, deg", "-15 to 15"},
            fmt::format("{:.2f}", tilted.tilt_deg), std::abs(tilted.tilt_deg) < 15,
            {"normal of the printed rings", "", "one single tilt for all 72 points"}));
  rows.push_back(
      not_computable({"T16.targets", "Table 16", "scanning points \"based on target placement\"", "caption"},
                     "no target enters the printed coordinates: they are two rings turned as a whole"));
}

}  // namespace

Chapter scanning_chapter() {
  const ScanRings upright = fit_rings(printed::table15()), tilted = fit_rings(printed::table16());
  Chapter chapter{"Scanning points (Section 4.3)", {}, scanning_exhibits()};
  add_counts(chapter.rows, upright, tilted);
  add_start(chapter.rows, upright);
  add_pattern(chapter.rows, upright, tilted);
  add_scan_coverage(chapter);
  return chapter;
}

}  // namespace asterism
