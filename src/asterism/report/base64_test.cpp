// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/base64.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace asterism {
namespace {

std::string of_text(const std::string& text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(Base64, GivesTheVectorsOfRfc4648) {
  EXPECT_EQ(of_text(""), "");
  EXPECT_EQ(of_text("f"), "Zg==");
  EXPECT_EQ(of_text("fo"), "Zm8=");
  EXPECT_EQ(of_text("foo"), "Zm9v");
  EXPECT_EQ(of_text("foob"), "Zm9vYg==");
  EXPECT_EQ(of_text("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of_text("foobar"), "Zm9vYmFy");
}

TEST(Base64, UsesAllSixtyFourLetters) {
  const std::vector<std::uint8_t> ends = {0xfb, 0xff, 0x00};
  EXPECT_EQ(base64(ends), "+/8A");
}

TEST(Base64, WritesNumbersLowestByteFirst) {
  EXPECT_EQ(base64(std::vector<std::uint32_t>{0x04030201}), "AQIDBA==");
  EXPECT_EQ(base64(std::vector<std::uint16_t>{0x0201, 0x0403}), "AQIDBA==");
  EXPECT_EQ(base64(std::vector<float>{1.0F}), "AACAPw==");  // 0x3f800000
}

}  // namespace
}  // namespace asterism
