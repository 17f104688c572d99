// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asterism/accuracy/motion_accuracy.hpp"
#include "asterism/layout/identifiability.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/layout/objectives.hpp"
#include "asterism/optimization/optimizer.hpp"
#include "asterism/visibility/occlusion.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

struct DesignerOptions {
  std::string objectives;   // names, by commas; empty: targets, the worst error after the task's losses,
                            // identifiability
  std::string constraints;  // "worst-error <= 0.2"; beside the task's own or in place of them
  double identifiability_cap_mm = 10;  // larger margins count as this
  bool published_seeds = true;         // start from the paper's layouts too, where they fit
  int places = 400;                    // of the surface, asked for visibility and by the greedy seeds
  int most_designs = 60;               // of the front shown: the knee, the extremes, then the most different
  OptimizerOptions optimizer;
  VisibilityOptions visibility;
  OcclusionOptions occlusion;
  AccuracyOptions accuracy;  // its `losses` is set by what is asked
};
void describe(DesignerOptions& options, OptionVisitor& visit);

/// A value by name; empty where it has none, as an error of poses that are not determined.
struct NamedValue {
  std::string name;
  std::string unit;
  bool more_is_better = false;
  std::optional<double> value;
};

struct ConstraintState {
  std::string name;
  std::string unit;
  bool at_least = true;  // else at most
  double bound = 0;
  std::optional<double> value;
  double violation = 0;  // in the unit; 0 = it holds
};

/// Without a value it is broken by one scale of its quantity.
[[nodiscard]] ConstraintState state_of(const LayoutConstraint& constraint,
                                       const std::optional<double>& value);

/// How nearly the layout is taken for another body of the cell.
struct MarginToBody {
  std::string body;
  IdentifiabilityMargin margin;
};

/// A layout with all that is known of it.
struct LayoutDesign {
  std::string name;             // "6 targets, 2"
  std::string origin;           // "present", "Table 1 S3", "greedy", "found"
  std::vector<Target> targets;  // P1 … Pn with normals and diameters, in the body's frame
  LayoutMetrics metrics;
  std::vector<NamedValue> quantities;  // all of layout_quantities(), in that order
  std::vector<NamedValue> objectives;  // those asked for
  std::vector<ConstraintState> constraints;
  IdentifiabilityMargin identifiability;  // within the body
  std::vector<MarginToBody> between_bodies;
  MotionVisibility visibility;  // by pose
  MotionAccuracy accuracy;      // [0] nominal, [1] any one lost, [2] any two

  [[nodiscard]] bool feasible() const;
  [[nodiscard]] std::optional<double> value_of(LayoutQuantity quantity) const;
};

/// A greedy layout of places a spacing apart, with the bound that proves it.
struct GreedyDesign {
  LayoutDesign design;
  double gain = 0;         // GreedyLayout's, nats a pose
  double upper_bound = 0;  // no choice of as many of the `places` gives more
  double guaranteed = 0;   // its gain is at least this share of the best
  std::size_t places = 0;  // chosen among so many
};

struct DesignResult {
  std::vector<LayoutDesign> front;      // feasible, non-dominated; by number of targets, then by objectives
  int knee = -1;                        // index in `front`; −1 when the front is empty
  std::string why;                      // why the knee: what its neighbours would win and cost
  std::vector<std::string> given_up;    // one a design: what it gives up against the best of the front
  std::optional<LayoutDesign> present;  // the body's targets in the cell as they stand
  std::vector<LayoutDesign> published;  // the paper's layouts that fit the surface
  std::vector<GreedyDesign> greedy;     // by number of targets
  std::optional<LayoutDesign> closest;  // where nothing is feasible: what breaks the constraints least
  std::string infeasible;               // and in words: which constraints, and by how much
  std::vector<std::string> warnings;
  std::vector<GenerationRecord> history;
  std::optional<StopReason> stopped;  // empty: it had not come to its end
  std::size_t front_found = 0;        // designs of the whole front, before the choice of `most_designs`
  std::uint64_t front_checksum = 0;
  std::vector<double> pose_times_s;  // of the poses of visibility and accuracy
};

}  // namespace asterism
