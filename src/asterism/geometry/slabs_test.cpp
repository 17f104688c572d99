// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/slabs.hpp"

#include <gtest/gtest.h>

#include "asterism/geometry/ray_scene.hpp"
#include "asterism/geometry/rays_for_tests.hpp"

namespace asterism {
namespace {

TriangleMesh pipe(const Vec3& from, const Vec3& way, double radius_mm) {
  const TriangleMesh upright =
      surface_of_revolution({{0, 0}, {radius_mm, 0}, {radius_mm, way.norm()}, {0, way.norm()}}, 24);
  return moved(upright, {Quaternion::FromTwoVectors(Vec3::UnitZ(), way), from});
}

TEST(Slabs, HoldTheSurfaceTightly) {
  const Slabs slabs = slabs_of(pipe({10, 20, 30}, {0, 0, 100}, 5));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(slabs.low[axis], axis == 2 ? 30 : 10.0 + 10.0 * static_cast<double>(axis) - 5, 1e-9);
    EXPECT_NEAR(slabs.high[axis], axis == 2 ? 130 : 10.0 + 10.0 * static_cast<double>(axis) + 5, 1e-9);
  }
  // An oblique pipe is thin across its own axes.
  const Slabs oblique = slabs_of(pipe({0, 0, 0}, {300, 300, 300}, 5));
  EXPECT_NEAR(oblique.high[3] - oblique.low[3], 10, 0.2);
  EXPECT_NEAR(oblique.high[4] - oblique.low[4], 10, 0.2);
}

TEST(OutOfReach, KnowsHowFarADiscReaches) {
  const Slabs slabs = slabs_of(pipe({0, 0, 0}, {0, 0, 100}, 50));  // its lid at z = 100
  const Vec3 up = Vec3::UnitZ(), aside = Vec3::UnitX();
  // Flat on the lid, half a millimetre proud; whatever its radius.
  EXPECT_TRUE(out_of_reach(slabs, {0, 0, 100.5}, up, 40, {300, 0, 2000}));
  EXPECT_FALSE(out_of_reach(slabs, {0, 0, 99.5}, up, 40, {300, 0, 2000}));
  // On edge it reaches down beside its centre.
  EXPECT_FALSE(out_of_reach(slabs, {0, 0, 106}, aside, 7, {300, 0, 2000}));
  EXPECT_TRUE(out_of_reach(slabs, {0, 0, 108}, aside, 7, {300, 0, 2000}));
  // The eye is on the near side; the pipe lies beyond it.
  EXPECT_TRUE(out_of_reach(slabs, {0, 0, 1000}, up, 7, {0, 0, 500}));
  EXPECT_FALSE(out_of_reach(slabs, {0, 0, 1000}, up, 7, {0, 0, 50}));
}

TEST(OutOfReach, IsTrueOfNothing) {
  EXPECT_TRUE(out_of_reach(slabs_of({}), {0, 0, 0}, Vec3::UnitZ(), 10, {0, 0, 100}));
}

TEST(OutOfReach, NeverLeavesOutWhatIsHit) {
  int out = 0, hit = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    RandomStream random(1, i);
    const TriangleMesh mesh = pipe(rays::in_box(random, 300), rays::in_box(random, 300), 60);
    const rays::Way way = {rays::in_box(random, 500), rays::in_box(random, 500)};
    const Vec3 normal = rays::in_box(random, 1).normalized();
    const Vec3 rim = way.from + 20 * normal.unitOrthogonal();
    const bool blocked = blocked_exactly(mesh, way.from, way.to) || blocked_exactly(mesh, rim, way.to);
    const bool is_out = out_of_reach(slabs_of(mesh), way.from, normal, 20, way.to);
    EXPECT_FALSE(blocked && is_out);
    out += is_out ? 1 : 0;
    hit += blocked ? 1 : 0;
  }
  EXPECT_GT(out, 5000);
  EXPECT_GT(hit, 300);
}

}  // namespace
}  // namespace asterism
