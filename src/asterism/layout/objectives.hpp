// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asterism {

/// What can be asked of a layout; each may be an objective, or be held by a constraint. Errors are √tr Σ at
/// the task's points over the motion (accuracy/motion_accuracy.hpp), in the order of `layout_quantities()`.
enum class LayoutQuantity {
  Targets,            // how many
  MeanSpacing,        // the paper's Eq. 24: more is better
  OriginDistance,     // f1 of its Section 4.2: mean distance to the body's origin
  Coverage,           // −f2 of its Section 4.2: sum of pair distances
  WorstError,         // all targets there
  MeanError,          //
  WorstErrorOneLost,  // after the worst loss of one target; so below
  MeanErrorOneLost,
  WorstErrorTwoLost,
  MeanErrorTwoLost,
  Visible,          // fewest targets that both cameras see, over the motion
  Availability,     // share of frames with four left when each target is lost at random (Section 3.3)
  Identifiability,  // smallest RMS of a wrong labelling, within the body and with other bodies; capped
  Thickness,        // RMS distance from the plane of best fit
  Spacing,          // smallest distance between two targets: d_min of Eq. 28
  Moving            // from the present layout: way of all targets; see moving_cost_mm
};

struct LayoutQuantityInfo {
  LayoutQuantity quantity;
  std::string name;  // as chosen by: "worst-error-1-lost"
  std::string unit;  // empty for a pure number
  bool more_is_better;
  double scale;  // as much as counts like one unit of another constraint
  std::string help;
};
[[nodiscard]] const std::vector<LayoutQuantityInfo>& layout_quantities();
[[nodiscard]] const LayoutQuantityInfo& info_of(LayoutQuantity quantity);

/// The quantity's value must be at least the bound where more is better, at most where less is.
struct LayoutConstraint {
  LayoutQuantity quantity;
  double bound;
};
/// How much is missing, 0 when it holds.
[[nodiscard]] double violation_of(const LayoutConstraint& constraint, double value);

/// "targets, worst-error-1-lost" → quantities. Throws InputError for an unknown name, with the nearest one,
/// for a name given twice and for none.
[[nodiscard]] std::vector<LayoutQuantity> objectives_from(std::string_view text);
/// "visible >= 5, worst-error <= 0.2" → constraints. Throws InputError likewise, and for a bound on the
/// wrong side.
[[nodiscard]] std::vector<LayoutConstraint> constraints_from(std::string_view text);

/// What to say of objectives that do not make sense together; empty when all is well. Mean spacing and the
/// number of targets do not conflict: the mean spacing of n targets is the mean of that of their subsets of
/// n − 1, so one target can always be left out without loss, and the front is the fewest targets alone.
[[nodiscard]] std::vector<std::string> warnings_about(const std::vector<LayoutQuantity>& objectives);

}  // namespace asterism
