// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/options_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

enum class Colour { Red, Green };
struct Options {
  double size_px = 3;
  int count = 7;
  bool strict = false;
  std::string name = "plain";
  Colour colour = Colour::Red;
};
void describe(Options& options, OptionVisitor& visit) {
  visit.number("fit.size_px", options.size_px, {1, 10}, "how large");
  visit.integer("count", options.count, {0, 100}, "how many");
  visit.flag("strict", options.strict, "how strict");
  visit.text("name", options.name, "how called");
  visit.choice_of("colour", options.colour, {"red", "green"}, "which colour");
}

std::string fault_of(const std::string& toml) {
  const TestFolder folder;
  Options options;
  return input_error_of([&] { read_options(folder.write("o.toml", toml), describing(options)); });
}

TEST(ReadOptions, SetsWhatTheFileNamesAndLeavesTheRest) {
  const TestFolder folder;
  Options options;
  read_options(folder.write("o.toml", "strict = true\ncolour = \"green\"\n[fit]\nsize_px = 4\n"),
               describing(options));
  EXPECT_EQ(options.size_px, 4);
  EXPECT_TRUE(options.strict);
  EXPECT_EQ(options.colour, Colour::Green);
  EXPECT_EQ(options.count, 7);
}

TEST(ReadOptions, TellsAnUnknownKeyWithItsLineAndTheNearestName) {
  const std::string message = fault_of("count = 3\n\n[fit]\nsize_pix = 4\n");
  EXPECT_TELLS(message, "o.toml:4: `fit.size_pix`");
  EXPECT_TELLS(message, "did you mean `fit.size_px`?");
}

TEST(ReadOptions, TellsWhatAValueMayBe) {
  EXPECT_TELLS(fault_of("fit.size_px = 11\n"), "o.toml:1: `fit.size_px` is 11; it must lie between 1 and 10");
  EXPECT_TELLS(fault_of("count = 1.5\n"), "`count` is `1.5`; it must be a whole number");
  EXPECT_TELLS(fault_of("count = \"many\"\n"), "it must be a whole number");
  EXPECT_TELLS(fault_of("strict = 1\n"), "it must be one of: false, true");
  EXPECT_TELLS(fault_of("colour = \"blue\"\n"), "`colour` is `blue`; it must be one of: red, green");
  EXPECT_TELLS(fault_of("count = [1]\n"), "must be one value");
  EXPECT_TELLS(fault_of("fit.size_px = nan\n"), "`fit.size_px`");
}

TEST(ReadOptions, TellsTheLineWhereTheFileIsNoToml) {
  EXPECT_TELLS(fault_of("count = 3\nstrict = = 4\n"), "o.toml:2: is no valid TOML");
  Options options;
  EXPECT_TELLS(input_error_of([&] { read_options("/no/such.toml", describing(options)); }),
               "/no/such.toml: cannot be opened");
}

TEST(SetOptions, ReadsTextsAsACommandLineGivesThem) {
  Options options;
  set_options({{"fit.size_px", "2.5e0"}, {"name", "a b"}}, describing(options));
  EXPECT_EQ(options.size_px, 2.5);
  EXPECT_EQ(options.name, "a b");
  EXPECT_TELLS(input_error_of([&] {
                 set_options({{"count", "3x"}}, describing(options));
               }),
               "`count` is `3x`");
}

TEST(JsonOfOptions, NestsByTheDotsAndNamesChoices) {
  Options options;
  EXPECT_EQ(json_of_options(describing(options)).dump(),
            R"({"fit":{"size_px":3.0},"count":7,"strict":false,"name":"plain","colour":"red"})");
}

TEST(ListOptions, TellsKindAndPresentValue) {
  Options options;
  const auto all = list_options(describing(options));
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[4].kind, "red|green");
  EXPECT_EQ(all[4].current, "red");
  EXPECT_EQ(all[0].help, "how large");
}

}  // namespace
}  // namespace asterism
