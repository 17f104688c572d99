// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/scan_coverage.hpp"

#include <gtest/gtest.h>

namespace asterism {
namespace {

// A sample of 4,000 stands for 0.025 % of the area, and two or three lie on the cut between two fields.
constexpr double kOnTheCut = 0.001;

TEST(ScanCoverage, BothListsOfStationsSeeTheWholeOuterWallOfTheBareConeAndNothingInside) {
  const ScannedPart cone = bare_cone();
  for (const RingPattern& rings : {paper_rings_96(), paper_rings_72()}) {
    const auto measured = measured_from(cone, views_of_rings(rings));
    EXPECT_NEAR(share_of_outer(cone, measured), 1, kOnTheCut);
    // the wall's inside is as large as its outside less 12 mm of radius, and the two end faces add some
    EXPECT_NEAR(share_of_whole(cone, measured), 0.5, 0.01);
  }
}

TEST(ScanCoverage, FlangesHideWhatATiltOfTenDegreesDoesNotBringBack) {
  const ScannedPart casing = flanged_casing();
  RingPattern tilted = paper_rings_72();
  tilted.tilt_deg = -10;
  const auto level = measured_from(casing, views_of_rings(paper_rings_96()));
  const auto both = either(level, measured_from(casing, views_of_rings(tilted)));
  EXPECT_LT(share_of_outer(casing, level), 0.9);
  EXPECT_GE(share_of_outer(casing, both), share_of_outer(casing, level));
  EXPECT_LT(share_of_outer(casing, both), 0.9);
}

TEST(ScanCoverage, AThirdOfTheStationsWouldDo) {
  const FewestViews fewest = fewest_views_of_outer_wall(bare_cone());
  EXPECT_LE(fewest.views, 24);
  EXPECT_GE(fewest.bound, 16);  // the wall's area over the field's is 17
  EXPECT_LE(fewest.bound, fewest.views);
  EXPECT_GE(fewest.share, 0.98);
}

}  // namespace
}  // namespace asterism
