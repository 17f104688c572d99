// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/verified_body.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

TEST(VerificationOf, TellsCentroidAndOriginAlways) {
  const VerifiedBody body = verification_of(test_cell());
  ASSERT_EQ(body.points.size(), 2U);
  EXPECT_FALSE(body.has_named());
  EXPECT_LT((body.points[VerifiedBody::kCentroid].in_body_mm - Vec3(-15, -10.0 / 6, 595.8333)).norm(), 1e-3);
  EXPECT_EQ(body.points[VerifiedBody::kOrigin].in_body_mm, Vec3::Zero());
}

TEST(VerificationOf, AsksVerificationThenLayoutThenThePartsBox) {
  Cell cell = test_cell();
  TriangleMesh box;
  box.vertices = {Vec3(0, 0, 0), Vec3(1, 2, 3)};
  box.triangles = {{0, 1, 0}};
  Solid part;
  part.name = "part";
  part.surface = std::make_shared<const TriangleMesh>(box);
  part.body = "platform";
  part.carrier_from_solid.translation = Vec3(10, 0, 0);
  cell.workpiece = part;
  const VerifiedBody corners = verification_of(cell);
  ASSERT_EQ(corners.points.size(), 10U);
  EXPECT_EQ(corners.points[9].name, "part corner 8");
  EXPECT_EQ(corners.points[9].in_body_mm, Vec3(11, 2, 3));
  cell.layout = LayoutTask{};
  cell.layout->body = "platform";
  cell.layout->points = {{"rim", Vec3(1, 0, 0)}};
  EXPECT_EQ(verification_of(cell).points.at(2).name, "rim");
  cell.verification.points = {{"tip", Vec3(2, 0, 0)}};
  EXPECT_EQ(verification_of(cell).points.at(2).name, "tip");
}

TEST(VerificationOf, NamesTheBodiesWhenTheOneAskedForIsNotThere) {
  Cell cell = test_cell();
  cell.verification.body = "table";
  const std::string message = input_error_of([&] { static_cast<void>(verification_of(cell)); });
  EXPECT_TELLS(message, "`table`");
  EXPECT_TELLS(message, "platform");
}

}  // namespace
}  // namespace asterism
