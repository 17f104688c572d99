// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cloud_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/io/mesh_bytes.hpp"

namespace asterism {
namespace {

/// Numbers that single precision holds, times that it does not.
Cloud some_cloud(std::size_t count) {
  Cloud cloud;
  cloud.fields = {{"sigma_mm", {}}, {"time_s", {}}};
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(7, i);
    cloud.points.emplace_back(random.normal(), 1e3 * random.normal(), random.uniform());
    cloud.normals.emplace_back(Vec3f::UnitZ());
    cloud.fields[0].values.push_back(static_cast<float>(random.uniform()));
    cloud.fields[1].values.push_back(1e6 + random.uniform());
  }
  return cloud;
}

void expect_same(const Cloud& a, const Cloud& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.fields.size(), b.fields.size());
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    EXPECT_EQ(a.fields[i].name, b.fields[i].name);
    const bool is_time = a.fields[i].name == "time_s";
    for (std::size_t k = 0; k < a.size(); ++k) {  // what is written as single precision is compared as that
      const double x = a.fields[i].values[k], y = b.fields[i].values[k];
      ASSERT_TRUE(is_time ? x == y : static_cast<float>(x) == static_cast<float>(y)) << x << " " << y;
    }
  }
}

const std::string kText = R"(ply
format ascii 1.0
comment by hand
obj_info more by hand
element sensor 2
property list uchar float axis
property uchar kind
element vertex 3
property double x
property float y
property int z
property uchar red
property list uchar int seen_by
property float scalar_time_s
property ushort quality
element face 1
property list uchar int vertex_indices
end_header
3 0 0 1 7
0 8
1.5 2 3 255 2 4 5 0.25 9
nan 2 3 255 0 0.5 9
-1e3 +2 -3 255 1 4 inf 10
3 0 1 2
)";

Cloud cloud_of_text(const std::string& text) {
  const TestFolder folder;
  return read_cloud(folder.write("a.ply", text));
}

std::string complaint(const std::string& text) {
  return input_error_of([&] { static_cast<void>(cloud_of_text(text)); });
}

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  return text.replace(text.find(old), old.size(), fresh);
}

TEST(WriteCloud, WhatIsWrittenComesBackToTheSameBits) {
  const TestFolder folder;
  const Cloud cloud = some_cloud(2000);
  for (const CloudFormat format : {CloudFormat::BinaryLittleEndian, CloudFormat::Ascii}) {
    write_cloud(folder / "a.ply", cloud, format);
    expect_same(read_cloud(folder / "a.ply"), cloud);
  }
}

TEST(WriteCloud, StatesPlainPropertiesAndNothingElse) {
  const TestFolder folder;
  Cloud cloud = some_cloud(1);
  write_cloud(folder / "a.ply", cloud, CloudFormat::Ascii, Coordinates::Single);
  const std::string text = folder.read("a.ply");
  EXPECT_EQ(text.substr(0, text.find("end_header")),
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float scalar_sigma_mm\n"
            "property double scalar_time_s\n");
  cloud.normals.clear();
  write_cloud(folder / "a.ply", cloud);
  EXPECT_EQ(folder.read("a.ply").find("nx"), std::string::npos);
}

TEST(ReadCloud, PassesOverOtherElementsColoursAndLists) {
  const Cloud cloud = cloud_of_text(kText);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points[0], Vec3(1.5, 2, 3));
  EXPECT_EQ(cloud.points[1], Vec3(-1000, 2, -3));
  EXPECT_TRUE(cloud.normals.empty());
  ASSERT_EQ(cloud.fields.size(), 2U);
  EXPECT_EQ(cloud.field("time_s")->front(), 0.25);
  EXPECT_TRUE(std::isinf(cloud.field("time_s")->back()));
  EXPECT_EQ(*cloud.field("quality"), (std::vector<double>{9, 10}));
  EXPECT_EQ(cloud.field("red"), nullptr);
}

/// Two points of mixed types behind an element of lists, the second not finite.
std::string binary_cloud(bool big) {
  std::string bytes = with(
      "ply\r\nformat binary_little_endian 1.0\r\nelement sensor 1\r\n"
      "property list uchar short axis\r\nelement vertex 2\r\nproperty float z\r\n"
      "property double x\r\nproperty short y\r\nproperty float nx\r\n"
      "property float ny\r\nproperty float nz\r\nproperty uint32 scalar_id\r\n"
      "end_header\r\n",
      "little", big ? "big" : "little");
  const auto add = [&](auto number) {
    std::string raw;
    append_number(raw, number);
    bytes.append(big ? std::string(raw.rbegin(), raw.rend()) : raw);
  };
  add(std::uint8_t{2});
  add(std::int16_t{1});
  add(std::int16_t{2});
  for (const float z : {2.5F, std::numeric_limits<float>::quiet_NaN()}) {
    add(z);
    add(0.1);
    add(std::int16_t{-300});
    for (const float n : {0.0F, std::numeric_limits<float>::infinity(), 1.0F}) add(n);
    add(std::uint32_t{4000000000U});
  }
  return bytes;
}

TEST(ReadCloud, TakesBinaryOfEitherByteOrderAndMixedTypes) {
  for (const bool big : {false, true}) {
    const Cloud cloud = cloud_of_text(binary_cloud(big));
    ASSERT_EQ(cloud.size(), 1U);
    EXPECT_EQ(cloud.points[0], Vec3(0.1, -300, 2.5));
    EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 0)) << "a normal that is not finite is not known";
    EXPECT_EQ(cloud.field("id")->front(), 4e9);
  }
}

TEST(CloudReader, ReadsInPiecesWhatItReadsAtOnce) {
  const TestFolder folder;
  const Cloud whole = some_cloud(50000);
  write_cloud(folder / "a.ply", whole);
  CloudReader reader(folder / "a.ply");
  EXPECT_EQ(reader.points(), 50000U);
  Cloud joined;
  joined.fields = {{"sigma_mm", {}}, {"time_s", {}}};
  for (Cloud piece = reader.next(7001); !piece.points.empty(); piece = reader.next(7001)) {
    EXPECT_LE(piece.size(), 7001U);
    joined.points.insert(joined.points.end(), piece.points.begin(), piece.points.end());
    joined.normals.insert(joined.normals.end(), piece.normals.begin(), piece.normals.end());
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<double>& values = joined.fields[i].values;
      values.insert(values.end(), piece.fields[i].values.begin(), piece.fields[i].values.end());
    }
  }
  expect_same(joined, whole);
}

TEST(CloudReader, LeavesOutAndCountsWhatIsNotFiniteWithoutTakingItForTheEnd) {
  const TestFolder folder;
  Cloud cloud;
  cloud.points.assign(40000, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  cloud.points.emplace_back(1, 2, 3);
  write_cloud(folder / "a.ply", cloud);
  CloudReader reader(folder / "a.ply");
  EXPECT_EQ(reader.next(10).points, std::vector<Vec3>{Vec3(1, 2, 3)});
  EXPECT_EQ(reader.not_finite(), 40000U);
  EXPECT_TRUE(reader.next(10).points.empty());
}

TEST(CloudReader, AnEmptyCloudHasNoPoints) {
  const TestFolder folder;
  write_cloud(folder / "a.ply", {});
  CloudReader reader(folder / "a.ply");
  EXPECT_EQ(reader.points(), 0U);
  EXPECT_TRUE(reader.next(10).points.empty());
}

TEST(ReadCloud, TellsWhatIsWrong) {
  const TestFolder folder;
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_cloud(folder / "none.ply")); }), "cannot be read");
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_cloud(folder / "")); }), "is a folder");
  EXPECT_TELLS(complaint("x,y,z\n1,2,3\n"), "does not begin with `ply`");
  EXPECT_TELLS(complaint(""), "does not begin with `ply`");
  EXPECT_TELLS(complaint("ply\nformat ascii 1.0\n"), "has no `end_header`");
  EXPECT_TELLS(complaint(with(kText, "float y", "flaot y")), "a.ply:10: `flaot` is no type of PLY");
  EXPECT_TELLS(complaint(with(kText, "int z", "int zz")), "lacks one of x, y, z: it is no cloud");
  EXPECT_TELLS(complaint(with(kText, "element vertex", "element point")), "has no element `vertex`");
  EXPECT_TELLS(complaint(with(kText, "1.5 2 3", "1.5 two 3")), "a.ply:21: `two` is no number");
  EXPECT_TELLS(complaint(with(kText, "255 2 4 5", "255 -2 4 5")), "a list of `seen_by` says that -2");
  EXPECT_TELLS(complaint(with(kText, "255 2 4 5", "255 1e9 4 5")), "it is cut off or damaged");
  EXPECT_TELLS(complaint(with(kText, "vertex 3", "vertex 5")), "a.ply:25: the file ends here: it is cut off");
  EXPECT_TELLS(complaint(with(kText, "vertex 3", "vertex 99999999999")),
               "the header says that 99999999999 of element `vertex` follow");
  EXPECT_TELLS(complaint(with(kText, "vertex 3", "vertex -3")), "says that it holds -3");
  const std::string binary = binary_cloud(false);
  EXPECT_TELLS(complaint(binary.substr(0, binary.size() - 1)), "it is cut off or damaged");
  EXPECT_TELLS(complaint("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                         "property float z\nend_header\n"),
               "holds no points");
  EXPECT_TELLS(complaint("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                         "property float z\nend_header\nnan 0 0"),
               "none of its 1 points is finite");
}

TEST(ReadCloud, ReadsAHeaderThatIsLongerThanOnePiece) {
  std::string comments;
  for (int i = 0; i < 3000; ++i) comments += "comment so much was done to it\n";
  EXPECT_EQ(cloud_of_text(with(kText, "comment by hand\n", comments)).size(), 2U);
}

}  // namespace
}  // namespace asterism
