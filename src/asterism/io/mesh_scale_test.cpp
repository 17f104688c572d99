// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/mesh_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/files_for_tests.hpp"

namespace asterism {
namespace {

const TriangleMesh kBox = mesh_of(Box{{400, 300, 200}});

std::string doubt(const TriangleMesh& mesh, const MeshScale& scale) {
  return input_error_of([&] { static_cast<void>(checked_mesh(mesh, scale, "part.stl")); });
}

TEST(CheckedMesh, IsInMillimetres) {
  EXPECT_NEAR(facts_of(checked_mesh(scaled(kBox, 1e-3), {LengthUnit::Metre, {}, false}, "")).highest.x(), 200,
              1e-9);
  EXPECT_NEAR(facts_of(checked_mesh(scaled(kBox, 1 / 25.4), {LengthUnit::Inch, {}, false}, "")).highest.x(),
              200, 1e-9);
  EXPECT_NEAR(facts_of(checked_mesh(kBox, {{}, 1200, false}, "")).highest.x(), 600, 1e-9);
}

TEST(CheckedMesh, DoubtsAUnitThatMakesAPartOfHalfAMillimetreOrHalfAKilometre) {
  EXPECT_EQ(doubt(scaled(kBox, 1e-3), {LengthUnit::Millimetre, {}, false}),
            "part.stl: is 0.4 mm long in mm; centimetres would make it 4 mm: say unit = \"cm\"; metres would "
            "make it 400 mm: say unit = \"m\"; inches would make it "
            "10.16 mm: say unit = \"inch\"");
  EXPECT_EQ(
      doubt(kBox, {LengthUnit::Metre, {}, false}),
      "part.stl: is 400 m long in m; millimetres would make it 400 mm: say unit = \"mm\"; centimetres would "
      "make it 4000 mm: say unit = \"cm\"; inches would make it 10.16 m: say unit = \"inch\"");
  EXPECT_TELLS(doubt(kBox, {}),
               "part.stl: a mesh file does not tell its unit; millimetres would make it 400 mm");
  EXPECT_TELLS(doubt(kBox, {LengthUnit::Inch, 300, false}), "by its `unit` or to its `longest_mm`, not both");
  EXPECT_TELLS(doubt(kBox, {{}, 0.1, false}),
               "`longest_mm` is 0.1; a part is 5 mm to 50 m from corner to corner");
}

TEST(CheckedMesh, SaysThatASurfaceIsInsideOutAndFlipsIt) {
  const MeshScale mm{LengthUnit::Millimetre, {}, false}, flip{LengthUnit::Millimetre, {}, true};
  EXPECT_EQ(doubt(flipped(kBox), mm),
            "part.stl: the mesh is inside out: its triangles face inwards; say flip = true");
  EXPECT_EQ(doubt(kBox, flip), "part.stl: the mesh is inside out when flipped; leave `flip` out");
  EXPECT_GT(facts_of(checked_mesh(flipped(kBox), flip, "")).volume_mm3, 0);
}

TEST(CheckedMesh, RefusesWhatIsEmptyFlatOrNotANumber) {
  const MeshScale mm{LengthUnit::Millimetre, {}, false};
  EXPECT_EQ(doubt({}, mm), "part.stl: the mesh holds no triangles");
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {100, 0, 0}, {50, 0, 0}};
  line.triangles = {{0, 1, 2}};
  EXPECT_EQ(doubt(line, mm), "part.stl: the mesh has no area: all its triangles are lines");
  TriangleMesh broken = kBox;
  broken.vertices[3].y() = std::nan("");
  EXPECT_EQ(doubt(broken, mm), "part.stl: a coordinate of the mesh is not a finite number");
  TriangleMesh open = kBox;
  open.triangles.pop_back();
  EXPECT_EQ(checked_mesh(open, mm, "").triangles.size(), 11U);  // is let through
}

TEST(LengthUnitOf, IsTheUnitOfEachWordAndNoneOfAnother) {
  EXPECT_EQ(length_unit_of("mm"), LengthUnit::Millimetre);
  EXPECT_EQ(length_unit_of("m"), LengthUnit::Metre);
  EXPECT_EQ(length_unit_of("inch"), LengthUnit::Inch);
  EXPECT_FALSE(length_unit_of("").has_value());
  EXPECT_FALSE(length_unit_of("furlong").has_value());
}

}  // namespace
}  // namespace asterism
