// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/calibration/body_learning_growth.hpp"

namespace asterism {

/// The rigid sets of a recording that move, best (most observations) first; no model is needed and
/// frames may be far apart. Pairs of frames give congruent subsets (pair distances equal within their
/// covariances, then a proper rotation); each that moved is looked for in all frames and grows by the
/// points that come back at one place of its frame. What stays where it is, is background: its points
/// are congruent too, with no motion, and are passed over.
[[nodiscard]] std::vector<RigidSet> find_rigid_sets(std::span<const ObservedFrame> frames,
                                                    const BodyLearningOptions& options);

/// How many points are seen at the same place in at least half of the frames.
[[nodiscard]] int count_static_points(std::span<const ObservedFrame> frames,
                                      const BodyLearningOptions& options);

}  // namespace asterism
