// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/scan_claims.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/reproduction/plot.hpp"
#include "asterism/reproduction/scan_coverage.hpp"

namespace asterism {
namespace {

/// One part before the two lists of stations.
struct Scanned {
  ScannedPart part;
  std::vector<std::uint8_t> level;  // from Table 15's 96
  std::vector<std::uint8_t>
      reduced;  // from Table 16's 72, the part turned with the platform: level rings on it
  std::vector<std::uint8_t>
      rescan;  // from the 72 while only one of part and rings is turned, and from the 96
};

Scanned scan(ScannedPart part) {
  RingPattern tilted = paper_rings_72();
  tilted.tilt_deg = -10;  // as the part sees level rings while the platform is pitched by +10°
  auto level = measured_from(part, views_of_rings(paper_rings_96()));
  auto reduced = measured_from(part, views_of_rings(paper_rings_72()));
  auto rescan = either(level, measured_from(part, views_of_rings(tilted)));
  return {std::move(part), std::move(level), std::move(reduced), std::move(rescan)};
}

std::string shares(const ScannedPart& part, std::span<const std::uint8_t> measured) {
  return fmt::format("{:.1f} % of the outer side, {:.1f} % of the whole part",
                     100 * share_of_outer(part, measured), 100 * share_of_whole(part, measured));
}

/// The outer side unrolled: what is measured, and what is not.
Exhibit unrolled(const std::string& id, const std::string& title, const std::string& caption,
                 const Scanned& scanned, std::span<const std::uint8_t> measured) {
  Plot plot({"azimuth (°)", -180, 180, {}}, {"height (mm)", 0, 560, {}}, 620, 300);
  plot.legend({{"soft filled", "measured"}, {"s2 filled", "missing"}});
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (scanned.part.outer[i] == 0) continue;
    const Vec3& at = scanned.part.samples[i].at;
    const Vec2 place(deg_from_rad(std::atan2(at.y(), at.x())), at.z());
    plot.point(place, measured[i] != 0 ? "soft filled" : "s2 filled", measured[i] != 0 ? 1.6 : 2.6);
  }
  return {id, title, caption, plot.str(title)};
}

void add_figures(Chapter& chapter, const Scanned& cone, const Scanned& casing) {
  const std::string open = "the part's shape: neither it nor the cloud is published";
  const auto missing = [](const Scanned& scanned) {
    return Reading{scanned.part.name, shares(scanned.part, scanned.level),
                   share_of_outer(scanned.part, scanned.level) < 0.999};
  };
  chapter.rows.push_back(compare_readings(
      {"F25", "Fig. 25", "the cloud from Table 15's stations has missing regions", "picture"},
      {missing(cone), missing(casing)}, open));
  const auto complete = [](const Scanned& scanned) {
    return Reading{scanned.part.name, shares(scanned.part, scanned.rescan),
                   share_of_outer(scanned.part, scanned.rescan) > 0.999};
  };
  chapter.rows.push_back(compare_readings(
      {"F26", "Fig. 26", "rescanning with the platform turned by 10° completes the cloud", "picture"},
      {complete(cone), complete(casing)}, open));
  const auto same = [](const Scanned& scanned) {
    const double level = share_of_outer(scanned.part, scanned.level);
    const double reduced = share_of_outer(scanned.part, scanned.reduced);
    return Reading{scanned.part.name,
                   fmt::format("{:.1f} % from 96, {:.1f} % from 72", 100 * level, 100 * reduced),
                   std::abs(level - reduced) < 0.005};
  };
  chapter.rows.push_back(compare_readings(
      {"S43.rate", "Section 4.3", "96 and 72 stations give the same reconstruction rate", "the same"},
      {same(cone), same(casing)}, open));
  const FewestViews free_views = fewest_views_of_outer_wall(casing.part);
  const std::string what = "The outer side of a casing with flanges and bosses, unrolled, from ";
  chapter.exhibits.push_back(unrolled("F25", "Figure 25. What the stations of Table 15 miss",
                                      what + "the 96 stations: " + shares(casing.part, casing.level) + ".",
                                      casing, casing.level));
  chapter.exhibits.push_back(unrolled(
      "F26", "Figure 26. After rescanning with the platform turned",
      what + "the same and 72 more while the part is pitched by 10°: " + shares(casing.part, casing.rescan) +
          fmt::format(
              ". The flanges face up and down, too obliquely for any view from the side: {} views chosen "
              "freely measure {:.1f} % of the outer side.",
              free_views.views, 100 * free_views.share),
      casing, casing.rescan));
}

/// What the stations would cost, and how few would do.
void add_savings(Chapter& chapter, const Scanned& cone) {
  const FewestViews fewest = fewest_views_of_outer_wall(cone.part);
  chapter.rows.push_back(
      judge({"T16.fewest", "Table 16",
             "the optimised number of stations, for the outer wall of the bare cone", "72"},
            fmt::format("{} views see 99 % of it; no choice of these 2,000 candidates needs fewer than {}",
                        fewest.views, fewest.bound),
            fewest.views >= 72,
            {"set cover over views at the stand-off; field, range and incidence of Table 8",
             "the rings overlap many times over: the saving is in choosing views, not in tilting", ""}));
  constexpr double kStationS = 5, kTurnS = 10;  // assumed, LEDGER section 3
  const double before = 96 * kStationS, after = 72 * kStationS + kTurnS;
  chapter.rows.push_back(not_computable(
      {"S43.time", "Section 4.3", "gain in efficiency when turning the platform takes time, %", "33.3"},
      "no times are published; the printed figure counts stations only",
      fmt::format("{:.1f}", 100 * (before / after - 1)),
      fmt::format("{:g} s a station and {:g} s a turn, assumed; the gain is gone when turns take {:g} s",
                  kStationS, kTurnS, 24 * kStationS)));
}

}  // namespace

void add_scan_coverage(Chapter& chapter) {
  const Scanned cone = scan(bare_cone()), casing = scan(flanged_casing());
  add_figures(chapter, cone, casing);
  add_savings(chapter, cone);
}

}  // namespace asterism
