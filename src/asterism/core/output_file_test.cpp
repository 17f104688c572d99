// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

/// As a disk that is full after some bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(OutputFile, TakesItsNameOnlyWhenWhole) {
  const TestFolder folder;
  OutputFile file(folder / "new/a.csv");
  file.write("one\n");
  file.flush();
  EXPECT_FALSE(std::filesystem::exists(folder / "new/a.csv"));
  file.finish();
  EXPECT_EQ(folder.read("new/a.csv"), "one\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "new/a.csv.partial"));
}

TEST(OutputFile, LeavesTheOldFileWhenTheWorkBreaksOff) {
  const TestFolder folder;
  folder.write("a.csv", "old\n");
  { OutputFile(folder / "a.csv").write("new\n"); }
  EXPECT_EQ(folder.read("a.csv"), "old\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv.partial"));
}

TEST(OutputFile, KeepsTheWholeLinesOfATableThatBrokeOff) {
  const TestFolder folder;
  { OutputFile(folder / "a.csv", OutputFile::Unfinished::Keep).write("head\n1,2\n3,"); }
  EXPECT_EQ(folder.read("a.csv.partial"), "head\n1,2\n");
}

TEST(OutputFile, SaysSoWhenTheDiskIsFullAndKeepsWhatWasWritten) {
  const TestFolder folder;
  const FullDisk disk(100000);
  const std::string message = input_error_of([&] {
    OutputFile file(folder / "a.csv", OutputFile::Unfinished::Keep);
    for (int i = 0; i < 100000; ++i) file.write("0123456\n");
    file.finish();
  });
  EXPECT_TELLS(message, "a.csv: cannot be written");
  EXPECT_TELLS(message, "make room");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
  EXPECT_EQ(folder.read("a.csv.partial").size(), 100000U);  // 12500 lines of 8 bytes
}

TEST(OutputFile, WritesIntoADeviceWithoutRenaming) {
  EXPECT_TELLS(input_error_of([] { write_file("/dev/full", "text"); }),
               "/dev/full: cannot be written: No space left");
}

TEST(OutputFile, TellsAFolderThatCannotBeMadeOrIsInThePlace) {
  const TestFolder folder;
  folder.write("file", "");
  EXPECT_TELLS(input_error_of([&] { OutputFile(folder / "file/a.csv"); }), "file: the folder cannot be made");
  EXPECT_TELLS(input_error_of([&] { OutputFile(folder.path()); }), "is a folder");
}

TEST(ReadFile, TellsWhatIsMissing) {
  EXPECT_TELLS(input_error_of([] { static_cast<void>(read_file("/no/such")); }),
               "/no/such: cannot be read: No such file");
}

}  // namespace
}  // namespace asterism
