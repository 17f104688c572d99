// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/shape_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace asterism {
namespace {

TEST(DistanceFrom, IsSignedAndExact) {
  EXPECT_NEAR(distance_from(Box{{20, 20, 20}}, {13, 14, 0}), 5, 1e-12);
  EXPECT_NEAR(distance_from(Box{{20, 20, 20}}, {7, 0, 0}), -3, 1e-12);
  EXPECT_NEAR(distance_from(Capsule{{0, 0, 0}, {0, 0, 100}, 10}, {0, 30, 50}), 20, 1e-12);
  EXPECT_NEAR(distance_from(Frustum{10, 10, 100}, {3, 4, 50}), -5, 1e-12);
  EXPECT_NEAR(distance_from(Frustum{10, 10, 100}, {0, 0, 98}), -2, 1e-12);
  EXPECT_NEAR(distance_from(Frustum{10, 10, 100}, {13, 0, 104}), 5, 1e-12);
  EXPECT_NEAR(distance_from(Frustum{10, 0, 10}, {10, 0, 10}), 10 / std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace asterism
