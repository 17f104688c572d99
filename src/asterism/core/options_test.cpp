// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/options.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

TEST(UnknownName, SaysWhichNameWasMeant) {
  EXPECT_EQ(unknown_name_message("min_diametre_px", "detection", {"polarity", "min_diameter_px"}),
            "`min_diametre_px` is no key of detection; did you mean `min_diameter_px`?");
}

TEST(UnknownName, ListsAllWhenNoneIsNear) {
  EXPECT_EQ(unknown_name_message("colour", "detection", {"polarity", "min_diameter_px"}),
            "`colour` is no key of detection; known are: polarity, min_diameter_px");
}

TEST(CheckNumber, RefusesWhatIsOutsideOrNotANumber) {
  EXPECT_NO_THROW(check_number("gate", 3, {0, 5}));
  EXPECT_THROW(check_number("gate", 6, {0, 5}), InputError);
  EXPECT_THROW(check_number("gate", std::numeric_limits<double>::quiet_NaN(), {}), InputError);
}

TEST(Require, ThrowsThePromiseThatWasBroken) {
  EXPECT_NO_THROW(require(true, "kept"));
  try {
    require(false, "a point has three coordinates");
    FAIL() << "nothing was thrown";
  } catch (const ContractViolation& violation) {
    EXPECT_STREQ(violation.what(), "broken promise: a point has three coordinates");
  }
}

}  // namespace
}  // namespace asterism
