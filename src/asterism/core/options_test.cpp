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

TEST(SectionVisitor, ShowsAPartsOptionsUnderItsName) {
  struct Names : OptionVisitor {
    std::vector<std::string> seen;
    void number(std::string_view name, double& value, Limits, std::string_view) override {
      seen.emplace_back(name);
      value *= 2;
    }
    void integer(std::string_view name, int&, Limits, std::string_view) override { seen.emplace_back(name); }
    void flag(std::string_view name, bool&, std::string_view) override { seen.emplace_back(name); }
    void text(std::string_view name, std::string&, std::string_view) override { seen.emplace_back(name); }
    void choice(std::string_view name, int&, const std::vector<std::string>&, std::string_view) override {
      seen.emplace_back(name);
    }
  } names;
  SectionVisitor section("part", names);
  double number = 3;
  int integer = 0;
  bool flag = false;
  std::string text;
  section.number("a", number, {}, "");
  section.integer("b", integer, {}, "");
  section.flag("c", flag, "");
  section.text("d", text, "");
  section.choice("e", integer, {"one"}, "");
  EXPECT_EQ(names.seen, (std::vector<std::string>{"part.a", "part.b", "part.c", "part.d", "part.e"}));
  EXPECT_EQ(number, 6);
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
