// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/stage.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"
#include "asterism/simulation/test_cell.hpp"
#include "asterism/simulation/truth.hpp"

namespace asterism {
namespace {

TEST(TargetAt, StandsBesideItsPlaceFromTheKnockOnAndIsGoneAfterTheFall) {
  Cell cell = test_cell();
  cell.faults = {{FaultKind::Knocked, "platform", "P2", 1.0, {0, 1, 0}},
                 {FaultKind::FallsOff, "platform", "P2", 2.0, {}}};
  const Stage stage = stage_of(cell);
  const Vec3 as_told = cell.movers[0].body.targets[1].position;
  EXPECT_EQ(target_at(stage, 0, 1, 0.999).target.position, as_told);
  EXPECT_EQ(target_at(stage, 0, 1, 1.0).target.position, as_told + Vec3(0, 1, 0));
  EXPECT_TRUE(target_at(stage, 0, 1, 1.9).there);
  EXPECT_FALSE(target_at(stage, 0, 1, 2.0).there);
  EXPECT_EQ(target_at(stage, 0, 0, 3.0).target.position, cell.movers[0].body.targets[0].position);
}

TEST(TruthOf, TellsTheTruePlaceOfAKnockedTargetAndLeavesThePoseAlone) {
  Cell cell = test_cell();
  const FrameTruth sound = truth_of(stage_of(cell), 0.3);
  cell.faults = {{FaultKind::Knocked, "platform", "P2", 0.1, {0, 1, 0}},
                 {FaultKind::FallsOff, "platform", "P4", 0.1, {}}};
  const FrameTruth truth = truth_of(stage_of(cell), 0.3);
  ASSERT_EQ(truth.targets.size(), sound.targets.size());
  EXPECT_EQ(difference(truth.tracker_from_body[0], sound.tracker_from_body[0]).norm(), 0);
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const TargetTruth& target = truth.targets[i];
    const double apart = (target.in_camera - sound.targets[i].in_camera).norm();
    EXPECT_NEAR(apart, target.target == 1 ? 1.0 : 0.0, 1e-9);
    EXPECT_EQ(target.visible, target.target == 3 ? 0.0 : 1.0);
  }
}

TEST(StageOf, SaysWhichFaultIsOfATargetThatIsNotThere) {
  Cell cell = test_cell();
  cell.faults = {{FaultKind::FallsOff, "platform", "P9", 0, {}}};
  try {
    (void)stage_of(cell);
    FAIL() << "took a fault of a target that is not there";
  } catch (const InputError& error) {
    // Whoever looks first, the cell's own check or the stage, names the target and its body.
    EXPECT_NE(std::string(error.what()).find("P9"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("platform"), std::string::npos);
  }
}

}  // namespace
}  // namespace asterism
