// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/scan_folder.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

Scan some_scan(int number) {
  Scan scan;
  scan.number = number;
  scan.body = "scanner, left";
  scan.time_s = 1.5;
  scan.in_scanner = {{1, 2, 300.25F}, {-4, 5, 310}};
  scan.times_s = {1.5, 1.50390625};
  return scan;
}

const std::string kHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

ReadScan only_scan(const TestFolder& folder) {
  const auto entries = read_scan_entries(folder / "");
  return read_scan(folder / "", entries.at(0));
}

std::string complaint(const TestFolder& folder) {
  return input_error_of([&] { static_cast<void>(only_scan(folder)); });
}

TEST(WriteScan, WhatIsWrittenComesBack) {
  const TestFolder folder;
  Scan with_normals = some_scan(12);
  with_normals.normals = {Vec3f::UnitZ(), -Vec3f::UnitX()};
  const std::vector<Scan> scans = {some_scan(3), with_normals};
  std::vector<ScanEntry> entries;
  for (const Scan& scan : scans) {
    write_scan(folder / "", scan);
    entries.push_back(entry_of(scan));
  }
  write_scan_entries(folder / "", entries);
  const auto back = read_scan_entries(folder / "");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[1].file, "scans/012.ply");
  for (std::size_t i = 0; i < 2; ++i) {
    const Scan scan = read_scan(folder / "", back[i]).scan;
    EXPECT_EQ(scan.number, scans[i].number);
    EXPECT_EQ(scan.body, "scanner, left");
    EXPECT_EQ(scan.time_s, 1.5);
    EXPECT_EQ(scan.in_scanner, scans[i].in_scanner);
    EXPECT_EQ(scan.times_s, scans[i].times_s);
    EXPECT_EQ(scan.normals, scans[i].normals);
  }
}

TEST(ReadScan, TakesTheTimeOfTheWholeScanWherePointsTellNone) {
  const TestFolder folder;
  folder.write("scans.csv", "file,scan,time_s\na.ply,1,2.5\n");
  folder.write("a.ply", kHeader + "end_header\n1 2 3\n4 nan 6\n7 8 9\n");
  const ReadScan read = only_scan(folder);
  EXPECT_EQ(read.scan.body, "scanner");
  EXPECT_EQ(read.scan.time_of(1), 2.5);
  EXPECT_EQ(read.not_finite, 1U);
  ASSERT_EQ(read.scan.in_scanner.size(), 2U);
  EXPECT_EQ(read.scan.in_scanner[1], Vec3f(7, 8, 9));
}

TEST(ReadScan, TakesTheTimesOfPointsWhereTheScanHasNone) {
  const TestFolder folder;
  folder.write("scans.csv", "scan,file\n1,a.ply\n");
  folder.write("a.ply",
               kHeader + "property double scalar_time_s\nend_header\n1 2 3 7.5\n4 5 6 nan\n7 8 9 8\n");
  const ReadScan read = only_scan(folder);
  EXPECT_EQ(read.scan.time_s, 7.5);
  EXPECT_EQ(read.scan.times_s, (std::vector<double>{7.5, 8}));
  EXPECT_EQ(read.not_finite, 1U) << "a point without a moment cannot be carried";
}

TEST(ReadScan, AnEmptyScanIsNone) {
  const TestFolder folder;
  Scan empty;
  write_scan(folder / "", empty);
  write_scan_entries(folder / "", {entry_of(empty)});
  EXPECT_TRUE(only_scan(folder).scan.in_scanner.empty());
}

TEST(ReadScan, TellsWhatIsWrong) {
  const TestFolder folder;
  EXPECT_TELLS(complaint(folder), "scans.csv: cannot be read");
  folder.write("a.ply", kHeader + "end_header\n1 2 3\n4 5 6\n7 8 9\n");
  folder.write("scans.csv", "scan\n1\n");
  EXPECT_TELLS(complaint(folder), "scans.csv:1: column `file` is missing");
  folder.write("scans.csv", "scan,file\n1,a.ply\n1,a.ply\n");
  EXPECT_TELLS(complaint(folder), "scans.csv:3: column `scan`: scan 1 is given twice");
  folder.write("scans.csv", "scan,file\n1,b.ply\n");
  EXPECT_TELLS(complaint(folder), "scans.csv:2: column `file`");
  EXPECT_TELLS(complaint(folder), "b.ply` is not there");
  folder.write("scans.csv", "scan,file\n1,\n");
  EXPECT_TELLS(complaint(folder), "scans.csv:2: column `file`: is empty");
  folder.write("scans.csv", "scan,file,time_s\n1,a.ply,soon\n");
  EXPECT_TELLS(complaint(folder), "column `time_s`: `soon` is no finite number");
  folder.write("scans.csv", "scan,file,time_s\n1,a.ply,\n");
  EXPECT_TELLS(complaint(folder), "a.ply: no time is told for scan 1");
}

}  // namespace
}  // namespace asterism
