// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/body_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

const std::string kTarget = "[[body.target]]\nid = \"P1\"\nposition_mm = [1, 2.5, -3]\n";

std::string fault_of(const std::string& text, const std::string& name = "bodies.toml") {
  const TestFolder folder;
  const auto file = folder.write(name, text);
  return input_error_of([&] { static_cast<void>(read_bodies(file)); });
}

TEST(ReadBodies, WhatIsWrittenComesBack) {
  const TestFolder folder;
  Target full{"P \"1\"", {1.25, -2, 3}, Vec3(0, 0.6, 0.8), 12.0, Mat3(Mat3::Identity() * 0.01)};
  const Target bare{"P2", {4, 5, 6}, {}, {}, {}};
  write_bodies(folder / "b.toml", {{"plat\\form", {full, bare}}, {"scanner", {bare}}});
  const auto read = read_bodies(folder / "b.toml");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].name, "plat\\form");
  EXPECT_EQ(read[0].targets[0].id, full.id);
  EXPECT_EQ(read[0].targets[0].position, full.position);
  EXPECT_LT((*read[0].targets[0].normal - *full.normal).norm(), 1e-12);
  EXPECT_EQ(read[0].targets[0].diameter_mm, 12.0);
  EXPECT_LT((*read[0].targets[0].covariance - *full.covariance).norm(), 1e-15);
  EXPECT_FALSE(read[0].targets[1].normal || read[0].targets[1].diameter_mm || read[0].targets[1].covariance);
}

TEST(ReadBodies, ReadsTheCsvForm) {
  const TestFolder folder;
  const auto read = read_bodies(folder.write(
      "b.csv",
      "body,id,x_mm,y_mm,z_mm,nx,ny,nz,diameter_mm\na,1,1,2,3,,,,\nb,1,0,0,0,0,0,1,6\na,2,4,5,6,,,,12\n"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].targets.size(), 2U);
  EXPECT_EQ(read[0].targets[1].diameter_mm, 12.0);
  EXPECT_EQ(read[1].targets[0].normal, Vec3(0, 0, 1));
  EXPECT_TELLS(fault_of("body,id,x_mm,y_mm,z_mm\na,1,1,2,x\n", "b.csv"),
               "b.csv:2: column `z_mm`: `x` is no finite number");
}

TEST(ReadBodies, ReadsNdisToolFiles) {
  std::string bytes(752, '\0');
  bytes.replace(0, 3, "NDI");
  bytes[28] = 2;
  const float places[6] = {0, 28.59F, 41.02F, 0, 0, 88};
  std::memcpy(bytes.data() + 72, places, sizeof(places));
  const TestFolder folder;
  const auto read = read_bodies(folder.write("8700339.rom", bytes));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].name, "8700339");
  ASSERT_EQ(read[0].targets.size(), 2U);
  EXPECT_NEAR(read[0].targets[0].position.z(), 41.02, 1e-5);
  EXPECT_TELLS(fault_of(bytes.substr(0, 80), "cut.rom"), "cut.rom: is no whole NDI tool file");
  EXPECT_TELLS(fault_of("hello", "other.rom"), "does not begin with `NDI`");
}

TEST(ReadBodies, TellsUnknownAndMissingKeysWithTheirLine) {
  EXPECT_TELLS(fault_of("[[body]]\nname = \"a\"\n" + kTarget + "diametre_mm = 12\n"),
               "bodies.toml:6: `diametre_mm` is no key of a target; did you mean `diameter_mm`?");
  EXPECT_TELLS(fault_of("[[bodies]]\nname = \"a\"\n"),
               "bodies.toml:1: `bodies` is no key of a bodies file; did you mean `body`?");
  EXPECT_TELLS(fault_of("[[body]]\n" + kTarget), "bodies.toml:1: a body has no `name`");
  EXPECT_TELLS(fault_of("[[body]]\nname = \"a\"\n[[body.target]]\nid = \"1\"\n"),
               "bodies.toml:3: a target has no `position_mm`");
}

TEST(ReadBodies, TellsWrongValuesWithTheirLine) {
  const std::string head = "[[body]]\nname = \"a\"\n[[body.target]]\nid = \"1\"\n";
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2]\n"),
               "bodies.toml:5: `position_mm` must be a list of 3 numbers");
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2, \"3\"]\n"), "`position_mm` must be a number");
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2, nan]\n"), "a coordinate is not a finite number");
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2, 3]\nnormal = [0, 0, 2]\n"), "normal must have length 1");
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2, 3]\ndiameter_mm = -1\n"), "diameter must be positive");
  EXPECT_TELLS(fault_of(head + "position_mm = [1, 2, 3]\ncovariance_mm2 = [1, 0, 0, 1, 2, 1]\n"),
               "bodies.toml:6: `covariance_mm2`");
  EXPECT_TELLS(fault_of("body = 3\n"), "bodies.toml:1: `body` must be tables");
}

TEST(ReadBodies, TellsDuplicatesAndEmptiness) {
  EXPECT_TELLS(fault_of("[[body]]\nname = \"a\"\n" + kTarget + kTarget), "target id `P1` is given twice");
  EXPECT_TELLS(fault_of("[[body]]\nname = \"a\"\n" + kTarget + "[[body]]\nname = \"a\"\n" + kTarget),
               "body `a` is given twice");
  EXPECT_TELLS(fault_of("[[body]]\nname = \"a\"\n"), "it has no targets");
  EXPECT_TELLS(fault_of(""), "holds no body");
}

}  // namespace
}  // namespace asterism
