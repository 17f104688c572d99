// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asterism/accuracy/accuracy_options.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

/// The largest predicted error and where it occurs.
struct WorstError {
  double mm = 0;
  std::size_t pose = 0;
  std::size_t point = 0;
  std::vector<std::size_t> lost;  // the targets whose loss is worst
};

/// Predicted error √tr Σ of points fixed in the body, over a motion; after losses, that of the worst loss.
struct ErrorOverMotion {
  std::optional<WorstError> worst;  // of the determined poses; none when no pose is
  double mean_mm = 0;               // over the determined poses and the points
  std::size_t undetermined = 0;     // poses that are not determined, or not after some loss
  std::vector<double> by_pose_mm;   // largest over the points and losses; infinite where not determined
};

struct MotionAccuracy {
  std::vector<ErrorOverMotion> after;  // [0] all targets seen; [m] after any m of them are lost

  [[nodiscard]] const ErrorOverMotion& nominal() const { return after.front(); }
  [[nodiscard]] const ErrorOverMotion& after_losses() const { return after.back(); }
};

/// The Cramér–Rao bound (pose_accuracy.hpp) of every pose at every point, with all targets that are seen and
/// after the loss of any 1 … `options.losses` of them. `points` are in the body's frame; none: the targets'
/// mean. The information of what remains is summed up anew for each loss, never subtracted, so that nothing
/// cancels. A disc counts by its centre. The rig's own covariance is left out: it does not depend on the
/// targets but through the pose (predict_pose_accuracy has it).
[[nodiscard]] MotionAccuracy predict_accuracy(std::span<const Target> targets, const SeenMotion& motion,
                                              const MotionVisibility& visibility,
                                              std::span<const Vec3> points, const AccuracyOptions& options);

}  // namespace asterism
