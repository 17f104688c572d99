// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/layout/suggestion.hpp"

namespace asterism {

void describe(SuggestOptions& options, OptionVisitor& visit) {
  visit.text("kinds", options.kinds, "what may be done with a target, by commas: move, add, remove");
  visit.text("objective", options.objective,
             "what to better: worst-error, worst-error-1-lost or worst-error-2-lost; empty: that after the "
             "task's losses");
  visit.text("constraints", options.constraints,
             "bounds to hold, by commas: \"worst-error <= 0.2, thickness >= 20\"; beside the task's own");
  visit.integer("places", options.places, {10, 100000}, "of the surface, each tried for each target");
  visit.integer("alternatives", options.alternatives, {1, 64}, "told of each kind");
  visit.number("least_gain", options.least_gain, {0, 1},
               "share by which the error must fall to be worth a change");
  visit.number("finest_mm", options.finest_mm, {0.01, 100}, "to which the best places are sought");
  visit.number("placing_mm", options.placing_mm, {0, 1000},
               "how far beside its place a foot may come to stand");
  SectionVisitor visibility("visibility", visit);
  describe(options.visibility, visibility);
  SectionVisitor accuracy("accuracy", visit);
  describe(options.accuracy, accuracy);
}

DesignerOptions designer_options(const SuggestOptions& options) {
  DesignerOptions designer;
  designer.constraints = options.constraints;
  designer.places = options.places;
  designer.visibility = options.visibility;
  designer.accuracy = options.accuracy;
  return designer;
}

std::string text_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::Relearn:
      return "relearn";
    case ChangeKind::Move:
      return "move";
    case ChangeKind::Add:
      return "add";
    case ChangeKind::Remove:
      return "remove";
  }
  return "";
}

std::vector<ChangeKind> kinds_from(const std::string& text) {
  std::vector<ChangeKind> kinds;
  std::string word;
  const auto take = [&] {
    if (word.empty()) return;
    const std::vector<ChangeKind> all = {ChangeKind::Move, ChangeKind::Add, ChangeKind::Remove};
    const auto named =
        std::find_if(all.begin(), all.end(), [&](ChangeKind kind) { return text_of(kind) == word; });
    if (named == all.end()) {
      throw InputError("kinds", fmt::format("`{}` is none of move, add, remove", word));
    }
    if (std::find(kinds.begin(), kinds.end(), *named) != kinds.end()) {
      throw InputError("kinds", fmt::format("`{}` is given twice", word));
    }
    kinds.push_back(*named);
    word.clear();
  };
  for (const char letter : text) {
    if (letter == ',')
      take();
    else if (letter != ' ')
      word += letter;
  }
  take();
  if (kinds.empty()) throw InputError("kinds", "none is named; some of move, add, remove");
  return kinds;
}

}  // namespace asterism
