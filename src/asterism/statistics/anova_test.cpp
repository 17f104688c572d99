// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/anova.hpp"

#include <gtest/gtest.h>

#include "asterism/core/result.hpp"
#include "asterism/statistics/student.hpp"

namespace asterism {
namespace {

TEST(OneWayAnova, IsTheSquareOfTheTTestForTwoGroups) {
  const std::vector<std::vector<double>> groups = {{1.1, 2.3, 0.4, 1.9}, {2.8, 3.1, 2.2}};
  const Anova anova = one_way_anova(groups);
  const TTest test = pooled_t_test(summarize(groups[0]), summarize(groups[1]));
  EXPECT_NEAR(anova.f, test.t * test.t, 1e-12);
  EXPECT_NEAR(anova.p, test.p, 1e-13);
}

TEST(OneWayAnova, RefusesWhatCannotBeCompared) {
  using Groups = std::vector<std::vector<double>>;
  EXPECT_THROW(static_cast<void>(one_way_anova(Groups{{1, 2}})), ContractViolation);
  EXPECT_THROW(static_cast<void>(one_way_anova(Groups{{1, 2}, {}})), ContractViolation);
  EXPECT_THROW(static_cast<void>(one_way_anova(Groups{{1}, {2}})), ContractViolation);
  EXPECT_THROW(static_cast<void>(one_way_anova(Groups{{1, 1}, {2, 2}})), ContractViolation);
}

}  // namespace
}  // namespace asterism
