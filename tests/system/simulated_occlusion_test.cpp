// SPDX-License-Identifier: Apache-2.0
// What hides targets is worked out twice, by visibility/ to predict and by simulation/ as the truth, with
// nothing shared but the cell and the rays: they must agree.
#include <gtest/gtest.h>

#include "asterism/io/cell_file.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/visibility/occlusion.hpp"

namespace asterism {
namespace {

struct Agreement {
  int sights = 0, hidden = 0, undecided = 0, wrong = 0;
};

/// The targets of one body through the motion. Other bodies' targets get no size: visibility/ counts solids
/// alone, simulation/ targets in front as well.
Agreement compare(const std::string& name, std::size_t mover) {
  Cell cell = cell_of(name);
  const Occlusion occlusion(cell);
  for (std::size_t i = 0; i < cell.movers.size(); ++i) {
    if (i == mover) continue;
    for (Target& target : cell.movers[i].body.targets) target.diameter_mm.reset();
  }
  SimulationOptions options;
  options.level = SimulationLevel::Centres;
  const Simulator simulator(cell, options);
  Agreement found;
  for (int frame = 0; frame < 120; ++frame) {
    const FrameTruth truth = simulator.frame(frame).truth;
    for (const TargetTruth& seen : truth.targets) {
      if (static_cast<std::size_t>(seen.body) != mover || !seen.in_image || seen.brightness <= 0) continue;
      const Target& target = cell.movers[mover].body.targets[static_cast<std::size_t>(seen.target)];
      const bool free = occlusion.free_share(target, mover, truth.tracker_from_body, seen.side) >= 0.98;
      ++found.sights;
      found.hidden += seen.visible < 0.9 ? 1 : 0;
      // Sixteen rays may miss a bite of less than a tenth of the disc.
      if (seen.visible >= 0.9 && seen.visible < 1) {
        ++found.undecided;
      } else if (free != (seen.visible == 1)) {
        ++found.wrong;
      }
    }
  }
  return found;
}

TEST(SimulatedOcclusion, HidesTheTargetsThatVisibilityHides) {
  for (const std::size_t mover : {0U, 1U}) {
    const Agreement found = compare("engine_casing", mover);
    EXPECT_GT(found.sights, 1000);
    EXPECT_GT(found.hidden, 10);
    EXPECT_LT(found.undecided, 40);
    EXPECT_EQ(found.wrong, 0);
  }
}

}  // namespace
}  // namespace asterism
