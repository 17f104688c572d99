// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/body.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

Target target(const std::string& id, const Vec3& position) { return {id, position, {}, {}, {}}; }

std::string refusal(const std::vector<Body>& bodies) {
  try {
    check_bodies(bodies, "bodies.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckBodies, AcceptsASoundBody) {
  EXPECT_EQ(refusal({{"platform", {target("P1", {0, 0, 0}), target("P2", {100, 0, 0})}}}), "");
}

TEST(CheckBodies, NamesWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal({{"platform", {}}}), "bodies.toml: body `platform`: it has no targets");
  EXPECT_EQ(refusal({{"platform", {target("P1", {0, 0, 0}), target("P1", {1, 0, 0})}}}),
            "bodies.toml: body `platform`: target id `P1` is given twice");
  EXPECT_EQ(refusal({{"platform", {target("P1", {0, 0, 0}), target("P2", {0, 0, 0})}}}),
            "bodies.toml: body `platform`: targets `P1` and `P2` are at the same place");
  EXPECT_EQ(refusal({{"a", {target("1", {0, 0, 0})}}, {"a", {target("1", {0, 0, 0})}}}),
            "bodies.toml: body `a` is given twice");
  Target broken = target("P1", {0, 0, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(refusal({{"a", {broken}}}),
            "bodies.toml: body `a`: target `P1`: a coordinate is not a finite number");
  Target flat = target("P1", {0, 0, 0});
  flat.normal = Vec3(0, 0, 2);
  EXPECT_EQ(refusal({{"a", {flat}}}),
            "bodies.toml: body `a`: target `P1`: its normal must have length 1, not 2");
}

}  // namespace
}  // namespace asterism
