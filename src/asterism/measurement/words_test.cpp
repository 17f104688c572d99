// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "asterism/core/result.hpp"
#include "asterism/measurement/centre.hpp"
#include "asterism/measurement/pose.hpp"

namespace asterism {
namespace {

TEST(CentreFlags, SurviveTheWayThroughText) {
  for (std::uint32_t flags = 0; flags < 64; ++flags) EXPECT_EQ(flags_of_text(text_of_flags(flags)), flags);
  EXPECT_EQ(text_of_flags(kSaturated | kBorder), "saturated|border");
}

TEST(CentreFlags, RefuseAnUnknownWord) { EXPECT_THROW((void)flags_of_text("saturatd"), InputError); }

TEST(PoseStatus, SurvivesTheWayThroughText) {
  for (const auto status : {PoseStatus::Ok, PoseStatus::Partial, PoseStatus::Predicted, PoseStatus::Ambiguous,
                            PoseStatus::Lost}) {
    EXPECT_EQ(status_of_text(text_of(status)), status);
  }
  EXPECT_THROW((void)status_of_text("FINE"), InputError);
}

}  // namespace
}  // namespace asterism
