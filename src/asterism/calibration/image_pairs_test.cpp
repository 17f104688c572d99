// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/image_pairs.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

TEST(PairImages, GoesByTheLastNumberInTheNames) {
  const auto pairing =
      pair_images({"cam1/left02.png", "cam1/left03.png"}, {"cam2/r_0003.png", "cam2/r_0002.png"});
  EXPECT_TRUE(pairing.by_number);
  ASSERT_EQ(pairing.pairs.size(), 2U);
  EXPECT_EQ(pairing.pairs[0].right, 1U);
  EXPECT_EQ(pairing.pairs[1].right, 0U);
}

TEST(PairImages, LeavesImagesWithoutAPartnerSingle) {
  const auto pairing = pair_images({"a1.png", "a2.png"}, {"b2.png", "b3.png"});
  ASSERT_EQ(pairing.pairs.size(), 3U);
  EXPECT_FALSE(pairing.pairs[0].right);
  EXPECT_EQ(pairing.pairs[1].right, 0U);
  EXPECT_FALSE(pairing.pairs[2].left);
}

TEST(PairImages, GoesByOrderWhereNamesDoNotTell) {
  const auto pairing = pair_images({"one.png", "two.png"}, {"uno.png", "due.png"});
  EXPECT_FALSE(pairing.by_number);
  EXPECT_EQ(pairing.pairs[1].right, 1U);
}

TEST(PairImages, RefusesNumbersOfImagesThatDiffer) {
  try {
    (void)pair_images({"one.png", "two.png"}, {"uno.png"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2 left and 1 right images"), std::string::npos);
  }
  EXPECT_THROW((void)pair_images({}, {"a.png"}), InputError);
}

}  // namespace
}  // namespace asterism
