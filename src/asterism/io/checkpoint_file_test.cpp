// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/checkpoint_file.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/optimization/problems_for_tests.hpp"

namespace asterism {
namespace {

const problems::FormulaProblem kProblem = problems::unit_cube("ZDT1", 5, 2, 0, problems::zdt1);
const OptimizerOptions kOptions{.population = 20, .generations = 12};

OptimizerState after(int steps) {
  Optimizer optimizer(kProblem, kOptions);
  for (int i = 0; i < steps; ++i) optimizer.step();
  return optimizer.state();
}

TEST(Checkpoint, GoesOnAsIfNothingHadHappened) {
  const TestFolder folder;
  write_checkpoint(folder / "run.checkpoint", after(4));
  Optimizer resumed(kProblem, kOptions);
  resume_from_checkpoint(resumed, folder / "run.checkpoint");
  while (!resumed.finished()) resumed.step();
  EXPECT_EQ(resumed.result().front_checksum, optimize(kProblem, kOptions).front_checksum);
}

TEST(Checkpoint, KeepsTheOneBefore) {
  const TestFolder folder;
  const auto file = folder / "run.checkpoint";
  for (int i = 1; i <= 3; ++i) write_checkpoint(file, after(i));
  EXPECT_EQ(read_checkpoint(file).history.size(), 3U);
  EXPECT_EQ(read_checkpoint(folder / "run.checkpoint.previous").history.size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.checkpoint.partial"));
}

TEST(Checkpoint, IsRefusedForAnotherProblemOrOtherOptions) {
  const TestFolder folder;
  const auto file = folder / "run.checkpoint";
  write_checkpoint(file, after(2));
  const auto other = problems::make_zdt4();
  Optimizer of_other(other, kOptions);
  EXPECT_EQ(input_error_of([&] { resume_from_checkpoint(of_other, file); }),
            file.string() + ": the run to go on with was of another problem: ZDT1; this one is ZDT4");
  Optimizer larger(kProblem, {.population = 30});
  EXPECT_TELLS(input_error_of([&] { resume_from_checkpoint(larger, file); }),
               "the run to go on with had other options: population 20,");
}

TEST(Checkpoint, TellsWhatIsWrongWithAFile) {
  const TestFolder folder;
  const auto file = folder / "run.checkpoint";
  write_checkpoint(file, after(2));
  const std::string whole = folder.read("run.checkpoint");
  const auto refusal = [&](const std::string& text) {
    folder.write("wrong", text);
    return input_error_of([&] { (void)read_checkpoint(folder / "wrong"); });
  };
  EXPECT_TELLS(refusal("hello"), "is no checkpoint: such a file starts with \"asterism checkpoint,\"");
  EXPECT_TELLS(refusal(""), "is no checkpoint");
  EXPECT_TELLS(refusal("asterism checkpoint, version 9, 0 bytes, crc 00000000\n"),
               "is a checkpoint of version 9; this program goes on from version 1 only");
  EXPECT_TELLS(refusal(whole.substr(0, 30)), "is cut short or damaged in its first line");
  EXPECT_TELLS(refusal(whole.substr(0, whole.size() - 100)), "is cut short: ");
  std::string damaged = whole;
  damaged[whole.size() / 2] ^= 1;
  EXPECT_TELLS(refusal(damaged), "is damaged: its check sum does not hold");
  EXPECT_TELLS(refusal(whole + "x"), "is damaged");
  folder.write("wrong.previous", whole);
  EXPECT_TELLS(refusal(damaged), "; the checkpoint before it is " + (folder / "wrong.previous").string());
  EXPECT_TELLS(input_error_of([&] { (void)read_checkpoint(folder / "missing"); }), "cannot be read");
}

}  // namespace
}  // namespace asterism
