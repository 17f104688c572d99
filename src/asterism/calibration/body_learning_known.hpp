// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "asterism/calibration/body_learning_growth.hpp"

namespace asterism {

/// Of the sets those that may be meant: none that is one of the `others`, which are known already, and
/// where some are the nominal body only these. The words which known bodies move when nothing else does.
[[nodiscard]] Result<std::vector<RigidSet>, NoBody> unknown_sets(std::vector<RigidSet> sets,
                                                                 const std::string& name, const Body* nominal,
                                                                 std::span<const Body> others,
                                                                 double error_mm);

/// The words when a set that is about to be learnt as `name` is one of the `others` in more than half of
/// its targets (four or more): a known body of which the rest was not seen, or not seen well. Empty else,
/// and when the set is the nominal body, which is meant whatever else it is called.
[[nodiscard]] std::optional<NoBody> mistaken_for_known(const RigidSet& set, const std::string& name,
                                                       const Body* nominal, std::span<const Body> others,
                                                       double error_mm);

}  // namespace asterism
