// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "asterism/reproduction/chain_sight.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/frame_placing.hpp"
#include "asterism/reproduction/motion_figures.hpp"
#include "asterism/reproduction/papers_cell.hpp"

namespace asterism {
namespace {

/// The extremes over the motion.
struct Extremes {
  std::string setting;
  int fewest = 8, most = 0;
  double lowest = 1, highest = 0;
};

Extremes extremes_of(const std::string& setting, const std::vector<SightOfRing>& sights) {
  Extremes extremes{setting, 8, 0, 1, 0};
  for (const SightOfRing& sight : sights) {
    extremes.fewest = std::min(extremes.fewest, sight.visible);
    extremes.most = std::max(extremes.most, sight.visible);
    extremes.lowest = std::min(extremes.lowest, sight.coverage);
    extremes.highest = std::max(extremes.highest, sight.coverage);
  }
  return extremes;
}

/// The first set is the one drawn as Figure 20; the others are as likely by what the paper tells.
std::vector<Extremes> tried_sets() {
  std::vector<Extremes> tried;
  for (const double acceptance : {kChainAcceptanceRad, rad_from_deg(60)}) {
    tried.push_back(
        extremes_of(fmt::format("both cameras, their images, the casing in the way; seen up to {:g}°",
                                deg_from_rad(acceptance)),
                    watch_chain({}, {.acceptance_rad = acceptance})));
  }
  for (const double elevation : {60.0, 50.0, 70.0}) {
    for (const double acceptance : {60.0, 50.0, 70.0}) {
      for (const double tilt : {20.0, 10.0, 30.0}) {
        const TrackerPlace place{.elevation_rad = rad_from_deg(elevation)};
        const RingOfTargets ring{rad_from_deg(tilt), rad_from_deg(acceptance)};
        tried.push_back(extremes_of(fmt::format("elevation {:g}°, seen up to {:g}°, normals tilted {:g}°",
                                                elevation, acceptance, tilt),
                                    watch_ring(place, ring)));
      }
    }
  }
  return tried;
}

/// One row over all sets; only one of those that do not fit is told.
template <class Text, class Fits>
LedgerRow row_over(const std::vector<Extremes>& tried, const Claim& claim, const Text& text,
                   const Fits& fits) {
  std::vector<Reading> readings;
  std::size_t fitting = 0;
  for (const Extremes& extremes : tried) {
    fitting += fits(extremes);
    readings.push_back({extremes.setting, text(extremes), fits(extremes)});
  }
  if (fitting == 0 || fitting == tried.size()) return compare_readings(claim, {readings.front()}, "");
  const auto other = std::find_if(readings.begin(), readings.end(),
                                  [&](const Reading& r) { return r.fits != readings.front().fits; });
  return compare_readings(
      claim, {readings.front(), *other},
      fmt::format("place of the tracker, tilt and acceptance of the targets are not told; {} of {} "
                  "sets tried give it",
                  fitting, tried.size()));
}

void add_figure20(std::vector<LedgerRow>& rows) {
  const std::vector<Extremes> tried = tried_sets();
  const auto claim = [](const char* id, const char* quantity, const char* published) {
    return Claim{std::string("P.F20.") + id, "Fig. 20", quantity, published};
  };
  rows.push_back(row_over(
      tried, {"F20", "Fig. 20", "targets seen; coverage coefficient", "4 to 8; 0.6 to nearly 1.0"},
      [](const Extremes& e) {
        return fmt::format("{} to {}; {:.3f} to {:.3f}", e.fewest, e.most, e.lowest, e.highest);
      },
      [](const Extremes& e) {
        return e.fewest == 4 && e.most == 8 && e.lowest >= 0.6 && e.lowest < 0.7 && e.highest >= 0.95;
      }));
  rows.push_back(row_over(
      tried, claim("visible_min", "fewest targets seen", "4"),
      [](const Extremes& e) { return fmt::format("{}", e.fewest); },
      [](const Extremes& e) { return e.fewest == 4; }));
  rows.push_back(row_over(
      tried, claim("visible_max", "most targets seen", "8"),
      [](const Extremes& e) { return fmt::format("{}", e.most); },
      [](const Extremes& e) { return e.most == 8; }));
  rows.push_back(row_over(
      tried, claim("coverage_min", "lowest coverage coefficient", "above 0.6"),
      [](const Extremes& e) { return fmt::format("{:.3f}", e.lowest); },
      [](const Extremes& e) { return e.lowest >= 0.6 && e.lowest < 0.7; }));
  rows.push_back(row_over(
      tried, claim("coverage_max", "highest coverage coefficient", "nearly 1.0"),
      [](const Extremes& e) { return fmt::format("{:.3f}", e.highest); },
      [](const Extremes& e) { return e.highest >= 0.95; }));
  const std::string setting = "a setting of the paper's simulation; the figure's own data are not published";
  rows.push_back(
      not_computable(claim("targets", "targets on the platform", "8"), setting, "8", "as printed"));
  rows.push_back(
      not_computable(claim("motion_start", "start of the motion, s", "5"), setting, "5", "as printed"));
  rows.push_back(
      not_computable(claim("motion_end", "end of the motion, s", "9"), setting, "9", "as printed"));
}

}  // namespace

Chapter motion_chapter() {
  Chapter chapter{
      "What the tracker sees of the moving platform (Sections 3.1, 4.1, 4.3)", {}, motion_exhibits()};
  add_figure20(chapter.rows);
  const std::string drawing =
      "a drawing of frames or devices: it holds no number, and the transforms between the "
      "frames (workpiece, scanner, targets) are not given";
  chapter.rows.push_back(not_computable(
      {"F11", "Fig. 11", "placing of the measurement frames", "drawing"}, drawing,
      fmt::format("the chain closes within {:.0e} mm", std::max(chain_misclosure_mm(), 1e-12)),
      "drawn by our model of the cell; scanner to tracker over the workpiece (Eqs. 19 to 22) and straight, "
      "over the motion"));
  chapter.rows.push_back(not_computable({"F15", "Fig. 15", "workflow of the hardware", "drawing"}, drawing));
  chapter.rows.push_back(not_computable({"F16", "Fig. 16", "workflow of a scan", "drawing"}, drawing));
  return chapter;
}

}  // namespace asterism
