// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/design.hpp"

#include <algorithm>

namespace asterism {

void describe(DesignerOptions& options, OptionVisitor& visit) {
  visit.text(
      "objectives", options.objectives,
      "what to better, by commas: targets, worst-error-1-lost, identifiability, …; empty: these three");
  visit.text("constraints", options.constraints,
             "bounds to hold, by commas: \"worst-error <= 0.2, thickness >= 20\"; beside the task's own");
  visit.number("identifiability_cap_mm", options.identifiability_cap_mm, {0.1, 1000},
               "larger margins count as this one");
  visit.flag("published_seeds", options.published_seeds,
             "start from the paper's layouts too, where they fit");
  visit.integer("places", options.places, {10, 100000},
                "of the surface that are asked for visibility and by the greedy layouts");
  visit.integer("most_designs", options.most_designs, {1, 100000}, "of the front that are told in full");
  SectionVisitor optimizer("optimizer", visit);
  describe(options.optimizer, optimizer);
  SectionVisitor visibility("visibility", visit);
  describe(options.visibility, visibility);
  SectionVisitor occlusion("occlusion", visit);
  describe(options.occlusion, occlusion);
  SectionVisitor accuracy("accuracy", visit);
  describe(options.accuracy, accuracy);
}

ConstraintState state_of(const LayoutConstraint& constraint, const std::optional<double>& value) {
  const LayoutQuantityInfo& info = info_of(constraint.quantity);
  ConstraintState state{info.name, info.unit, info.more_is_better, constraint.bound, value, 0};
  state.violation = value ? violation_of(constraint, *value) : info.scale;
  return state;
}

bool LayoutDesign::feasible() const {
  return std::all_of(constraints.begin(), constraints.end(),
                     [](const ConstraintState& constraint) { return constraint.violation == 0; }) &&
         std::all_of(objectives.begin(), objectives.end(),
                     [](const NamedValue& objective) { return objective.value.has_value(); });
}

std::optional<double> LayoutDesign::value_of(LayoutQuantity quantity) const {
  return quantities[static_cast<std::size_t>(quantity)].value;
}

}  // namespace asterism
