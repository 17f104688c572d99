// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/mesh_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/io/mesh_formats.hpp"

namespace asterism {
namespace {

/// A pyramid on a square of 20 mm, 15 mm high: 2000 mm³.
const std::string kOff = R"(OFF # a pyramid
# vertices, faces, edges
5 5 0
-10 -10 0
10 -10 0   # a corner

10 10 0
-10 10 0
0 0 15
4 3 2 1 0
3 0 1 4 255 0 0
3 1 2 4
3 2 3 4
3 3 0 4
)";

const std::string kObj = R"(# the same
mtllib none.mtl
o pyramid
v -10 -10 0 1.0
v 10 -10 0
v 10 10 0
v -10 10 0
v 0 0 15
vt 0 0
vn 0 0 1
s off
f 4/1/1 3/1/1 2/1/1 1/1/1
f 1//1 2//1 5//1
f 2/1 3/1 -1
f -3 -2 \
  -1
f 4 1 5
)";

const std::string kPly = R"(ply
format ascii 1.0
comment the same
element vertex 5
property float x
property float y
property float z
property uchar red
element face 5
property list uchar int vertex_indices
property float quality
element edge 1
property int a
end_header
-10 -10 0 255
10 -10 0 255
10 10 0 255
-10 10 0 255
0 0 15 255
4 3 2 1 0 nan
3 0 1 4 0
3 1 2 4 0
3 2 3 4 0
3 3 0 4 0
7
)";

std::string ascii_stl(const TriangleMesh& mesh) {
  std::string text = "solid pyramid\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal nan nan nan\n outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec3& v = mesh.corner(t, k);
      text += "  vertex " + std::to_string(v.x()) + " +" + std::to_string(std::abs(v.y())) + " " +
              std::to_string(v.z()) + "\n";
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid pyramid\n";
}

TriangleMesh mesh_of_text(const std::string& name, const std::string& text) {
  const TestFolder folder;
  return read_mesh(folder.write(name, text));
}

void expect_pyramid(const TriangleMesh& mesh) {
  const MeshFacts facts = facts_of(mesh);
  EXPECT_TRUE(facts.closed());
  EXPECT_EQ(facts.vertices, 5U);
  EXPECT_EQ(facts.triangles, 6U);
  EXPECT_NEAR(facts.volume_mm3, 2000, 1e-9);
}

/// The complaint without the file's name.
std::string complaint(const std::string& name, const std::string& text) {
  const TestFolder folder;
  const std::filesystem::path file = folder.write(name, text);
  const std::string what = input_error_of([&] { static_cast<void>(read_mesh(file)); });
  return what.substr(std::min(file.string().size(), what.size()));
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ReadMesh, TakesEveryFormatAsText) {
  expect_pyramid(mesh_of_text("a.off", kOff));
  expect_pyramid(mesh_of_text("a.OBJ", kObj));
  expect_pyramid(mesh_of_text("a.ply", kPly));
  TriangleMesh stl = mesh_of_text("a.off", kOff);
  for (Vec3& vertex : stl.vertices) vertex.y() += 10;  // so that no y is negative
  expect_pyramid(mesh_of_text("a.stl", ascii_stl(stl)));
}

TEST(ReadMesh, TakesLinesThatEndAsInWindows) {
  std::string windows;
  for (const char c : kOff) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_pyramid(mesh_of_text("a.off", windows));
}

TEST(ReadMesh, TakesColouredVerticesInOff) {
  std::string text = with(kOff, "OFF # a pyramid", "COFF");
  text = with(text, "-10 -10 0\n", "-10 -10 0 255 255 0 255\n");
  text = with(text, "0 0 15\n", "0 0 15 0.5 0.5 0.5 1\n");
  expect_pyramid(mesh_of_text("a.off", text));
}

TEST(ReadMesh, GetsBackWhatIsWritten) {
  const TestFolder folder;
  const TriangleMesh mesh =
      moved(mesh_of(Capsule{{1, 2, 3}, {50, -20, 11}, 7.3}), {exp_rotation({1, 2, 3}), {0.1, 0, 0}});
  write_ply(folder / "a.ply", mesh);
  const TriangleMesh ply = read_mesh(folder / "a.ply");
  ASSERT_EQ(ply.triangles, mesh.triangles);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) EXPECT_EQ(ply.vertices[i], mesh.vertices[i]);
  write_stl(folder / "a.stl", mesh);
  const TriangleMesh stl = read_mesh(folder / "a.stl");
  EXPECT_TRUE(facts_of(stl).closed());
  EXPECT_EQ(facts_of(stl).vertices, mesh.vertices.size());
  // Single precision keeps 2⁻²⁴ of 60 mm.
  EXPECT_LT((facts_of(stl).highest - facts_of(mesh).highest).norm(), 1e-5);
}

/// A binary PLY of one triangle in either byte order, with lists of another type and properties between.
std::string binary_ply(bool big, std::size_t bytes_short = 0) {
  std::string body;
  const auto put = [&](auto number) {
    std::string raw(reinterpret_cast<const char*>(&number), sizeof number);
    if (big) std::reverse(raw.begin(), raw.end());
    body += raw;
  };
  const double places[3][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 5}};
  for (const auto& place : places) {
    put(static_cast<std::uint8_t>(9));
    for (const double x : place) put(x);
  }
  put(static_cast<std::uint16_t>(2));  // a list to be passed over
  put(1.0F);
  put(2.0F);
  put(static_cast<std::uint32_t>(3));
  for (const std::int16_t corner : {0, 1, 2}) put(corner);
  return "ply\r\nformat binary_" + std::string(big ? "big" : "little") +
         "_endian 1.0\r\nelement vertex 3\r\nproperty uint8 flag\r\nproperty float64 x\r\nproperty double "
         "y\r\nproperty double z\r\nelement face 1\r\nproperty list ushort float32 uv\r\nproperty list uint "
         "short vertex_index\r\nend_header\r\n" +
         body.substr(0, body.size() - bytes_short);
}

TEST(ReadMesh, TakesBinaryPlyOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const TriangleMesh mesh = mesh_of_text("a.ply", binary_ply(big));
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.corner(0, 2), Vec3(0, 10, 5));
  }
  EXPECT_TELLS(complaint("a.ply", binary_ply(false, 1)),
               "3 numbers follow, for which the file's other 5 bytes do not do");
  EXPECT_TELLS(complaint("a.ply", binary_ply(false, 8)), ": the file ends here: it is cut off");
}

TEST(ReadMesh, SaysWhereATextIsWrong) {
  EXPECT_EQ(complaint("a.off", with(kOff, "3 1 2 4", "3 1 2 7")),
            ":12: a face has corner 7, counted from 0; the file has 5 vertices");
  EXPECT_EQ(complaint("a.off", with(kOff, "10 10 0", "10 nan 0")),
            ":7: a coordinate is `nan`; it must be finite");
  EXPECT_EQ(complaint("a.off", with(kOff, "10 10 0", "10 ten 0")), ":7: `ten` is no number");
  EXPECT_EQ(complaint("a.off", with(kOff, "OFF", "OOF")),
            ":1: begins with `OOF`; an OFF file begins with OFF, COFF, NOFF or CNOFF");
  EXPECT_EQ(complaint("a.off", "OFF BINARY\n"), ":1: is a binary OFF file; save it as text");
  EXPECT_EQ(complaint("a.obj", with(kObj, "f 4 1 5", "f 4 1 9")),
            ":17: a face has corner 9; 5 vertices are told before it");
  EXPECT_EQ(complaint("a.obj", with(kObj, "f 4 1 5", "f 4 1 0")),
            ":17: a face has corner 0; corners count from 1, or backwards from -1");
  EXPECT_EQ(complaint("a.obj", with(kObj, "f 4 1 5", "f 4 1")),
            ":17: a face has 2 corners; it must have three or more");
  EXPECT_EQ(complaint("a.obj", with(kObj, "v 0 0 15", "v 0 0")),
            ":8: a number is missing at the end of the line");
  EXPECT_EQ(complaint("a.obj", with(kObj, "s off", "curv 0 1 2")),
            ":11: `curv` is no keyword of a surface of polygons (v, f)");
  EXPECT_EQ(complaint("a.ply", with(kPly, "3 1 2 4 0", "3 1 2 -4 0")),
            ":22: a face has corner -4, counted from 0; the file has 5 vertices");
  EXPECT_EQ(complaint("a.ply", with(kPly, "float y", "flaot y")),
            ":6: `flaot` is no type of PLY; known are: char, uchar, short, ushort, int, uint, float, double");
  EXPECT_EQ(complaint("a.ply", with(kPly, "property float z\n", "")),
            ":14: element `vertex` lacks one of x, y, z");
}

TEST(ReadMesh, SaysThatAFileIsCutOff) {
  EXPECT_EQ(complaint("a.off", kOff.substr(0, kOff.size() - 4)),
            ":14: says that 3 corners follow, for which the file's other 3 bytes do not do: it is cut off or "
            "damaged");
  EXPECT_EQ(complaint("a.off", kOff.substr(0, kOff.find("10 10 0"))),
            ":7: the file ends here, in the middle of what it begins: it is cut off");
  EXPECT_TELLS(complaint("a.ply", kPly.substr(0, kPly.size() - 3)), "it is cut off");
  EXPECT_TELLS(complaint("a.ply", kPly.substr(0, 80)), "has no `end_header`: it is cut off or no PLY file");
  EXPECT_TELLS(complaint("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
               ":5: the file ends without `endsolid`: it is cut off");
  const TestFolder folder;
  write_stl(folder / "b.stl", mesh_of(Box{{10, 10, 10}}));
  const std::string whole = folder.read("b.stl");
  EXPECT_EQ(complaint("a.stl", whole.substr(0, 300)),
            ": says that it holds 12 triangles, which take 684 bytes; it has 300: it is cut off or damaged");
  EXPECT_EQ(complaint("a.stl", whole.substr(0, 20)),
            ": is no STL file: it has 20 bytes, a binary one begins with 84");
}

TEST(ReadMesh, IsNotLedToTakeMemoryByAbsurdCounts) {
  EXPECT_TELLS(complaint("a.off", "OFF\n2000000000000 1 0\n0 0 0\n"),
               ":2: says that 2000000000000 vertices follow, for which the file's other");
  EXPECT_TELLS(complaint("a.ply", with(kPly, "vertex 5", "vertex 999999999999")),
               "the header says that 999999999999 of element `vertex` follow");
  EXPECT_TELLS(complaint("a.ply", with(kPly, "vertex 5", "vertex -5")), "says that it holds -5 of element");
  EXPECT_TELLS(complaint("a.ply", with(kPly, "4 3 2 1 0", "4e18 3 2 1 0")),
               "numbers follow, for which the file's other");
}

TEST(ReadMesh, RefusesABinaryCoordinateThatIsNotANumber) {
  const TestFolder folder;
  write_stl(folder / "b.stl", mesh_of(Box{{10, 10, 10}}));
  std::string bytes = folder.read("b.stl");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 84 + 50 + 12 + 12, &nan, 4);
  EXPECT_EQ(complaint("a.stl", bytes), ": byte 158: a coordinate is not a finite number");
}

TEST(ReadMesh, RefusesWhatIsNoMesh) {
  EXPECT_EQ(complaint("a.step", "ISO-10303"),
            ": is no mesh by its name; readable are: .stl, .obj, .off, .ply");
  EXPECT_EQ(complaint("a.obj", "v 0 0 0\n"), ": holds no triangles");
  EXPECT_EQ(complaint("a.off", "OFF 0 0 0\n"), ": holds no triangles");
}

TEST(ReadMesh, NeverCrashesOnDamage) {
  const TestFolder folder;
  write_stl(folder / "whole.stl", mesh_of(Box{{10, 10, 10}}));
  write_ply(folder / "whole.ply", mesh_of(Box{{10, 10, 10}}));
  const std::vector<std::pair<std::string, std::string>> files = {{"a.off", kOff},
                                                                  {"a.obj", kObj},
                                                                  {"a.ply", kPly},
                                                                  {"b.ply", binary_ply(true)},
                                                                  {"c.ply", folder.read("whole.ply")},
                                                                  {"a.stl", folder.read("whole.stl")}};
  using Reader = TriangleMesh (*)(std::string_view, const std::filesystem::path&);
  const std::map<std::string, Reader> readers = {
      {"off", mesh_of_off}, {"obj", mesh_of_obj}, {"ply", mesh_of_ply}, {"stl", mesh_of_stl}};
  RandomStream random(11, 0);
  for (int trial = 0; trial < 1200; ++trial) {
    auto [name, bytes] = files[static_cast<std::size_t>(trial) % files.size()];
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(bytes.size())));
      bytes[at] = static_cast<char>(random.uniform(0, 256));
    }
    if (trial % 3 == 0) bytes.resize(bytes.size() / 2);
    try {
      const TriangleMesh mesh = readers.at(name.substr(2))(bytes, name);
      for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
      }
    } catch (const InputError&) {  // anything else fails the test
    }
  }
}

}  // namespace
}  // namespace asterism
