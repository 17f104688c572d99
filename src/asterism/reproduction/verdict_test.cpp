// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

Claim claim(const std::string& published) { return {"X.1", "Table X", "something, mm", published}; }

TEST(PrintedNumber, KnowsHowFarItWasRounded) {
  EXPECT_DOUBLE_EQ(printed_number("311.67")->half_unit, 0.005);
  EXPECT_DOUBLE_EQ(printed_number("-4780.5 mm")->value, -4780.5);
  EXPECT_DOUBLE_EQ(printed_number("25")->half_unit, 0.5);
  EXPECT_TRUE(std::isinf(printed_number("Inf")->value));
  EXPECT_FALSE(printed_number("S2"));
}

TEST(Compare, MatchesWhatRoundsToPrintAndNothingElse) {
  EXPECT_EQ(compare(claim("311.67"), 311.6667, {}).verdict, Verdict::Match);
  EXPECT_EQ(compare(claim("311.67"), 311.675, {}).verdict, Verdict::Match);  // rounds to print either way
  const LedgerRow off = compare(claim("40.679"), 40.697, {"how", "digits swapped", ""});
  EXPECT_EQ(off.verdict, Verdict::Mismatch);
  EXPECT_EQ(off.reason, "differs by 0.018, rounding allows 0.0005; digits swapped");
  EXPECT_EQ(off.computed, "40.69700");
  EXPECT_EQ(compare(claim("Inf"), INFINITY, {}).verdict, Verdict::Match);
  EXPECT_EQ(compare(claim("Inf"), 3.0, {}).verdict, Verdict::Mismatch);
  EXPECT_EQ(compare(claim("1.5"), INFINITY, {}).verdict, Verdict::Mismatch);
  EXPECT_EQ(compare(claim("72"), 72, {}).computed, "72");
}

TEST(Compare, RefusesAClaimWithoutANumber) {
  EXPECT_THROW(static_cast<void>(compare(claim("S3"), 1, {})), ContractViolation);
}

TEST(CompareDrawn, AllowsFourStandardErrorsAndTheRounding) {
  EXPECT_EQ(compare_drawn(claim("10.0"), 10.40, 0.1, {}).verdict, Verdict::MatchWithinMonteCarloError);
  EXPECT_EQ(compare_drawn(claim("10.0"), 10.46, 0.1, {}).verdict, Verdict::Mismatch);
  EXPECT_EQ(compare_drawn(claim("10.0"), 10.46, 0.1, {}).reason, "4.6 standard errors away");
}

TEST(CompareText, MatchesTheSameWordsOnly) {
  EXPECT_EQ(compare_text(claim("S1"), "S1", {}).verdict, Verdict::Match);
  EXPECT_EQ(compare_text(claim("S1"), "S2", {}).verdict, Verdict::Mismatch);
}

TEST(CompareReadings, HangsOnWhatIsNotToldOnlyWhenReadingsDisagree) {
  const Reading yes{"this way", "1", true}, no{"that way", "2", false};
  EXPECT_EQ(compare_readings(claim("1"), {yes, yes}, "open").verdict, Verdict::Match);
  EXPECT_EQ(compare_readings(claim("1"), {no, no}, "open").verdict, Verdict::Mismatch);
  const LedgerRow open = compare_readings(claim("1"), {yes, no}, "The way is not told");
  EXPECT_EQ(open.verdict, Verdict::CannotBeDetermined);
  EXPECT_EQ(open.reason, "The way is not told. It fits with this way: 1. It does not with that way: 2");
}

TEST(CompareSetting, IsToldOnlyWhenNoOtherValueFits) {
  const Reading yes{"5 %", "p = 0.5", true}, no{"6 %", "p = 0", false};
  EXPECT_EQ(compare_setting(claim("5"), {yes, no}).verdict, Verdict::Match);
  EXPECT_EQ(compare_setting(claim("5"), {yes, yes}).verdict, Verdict::CannotBeDetermined);
  EXPECT_EQ(compare_setting(claim("6"), {no, yes}).verdict, Verdict::Mismatch);
}

}  // namespace
}  // namespace asterism
