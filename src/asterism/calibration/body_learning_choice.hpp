// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/calibration/body_learning_search.hpp"

namespace asterism {

struct ChosenSet {
  RigidSet set;
  std::vector<std::string> warnings;
};

/// Of the rigid sets that move the one with as many targets as told, or the words why there is none:
/// nothing moves, too few or too many targets move together, several bodies answer the description,
/// or most frames can be read in two ways. Points that came along in less than half as many frames as
/// the rarest target are no targets.
[[nodiscard]] Result<ChosenSet, NoBody> choose_set(const std::vector<RigidSet>& sets,
                                                   std::span<const ObservedFrame> frames,
                                                   const BodyLearningOptions& options);

}  // namespace asterism
