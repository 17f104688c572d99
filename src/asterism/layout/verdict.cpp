// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "asterism/layout/knee.hpp"

namespace asterism {
namespace {

std::string with_unit(const NamedValue& value) {
  if (!value.value) return fmt::format("{} without a value", value.name);
  return fmt::format("{} {:.3g}{}{}", value.name, *value.value, value.unit.empty() ? "" : " ", value.unit);
}

/// Less is better.
double minimised(const NamedValue& value) {
  return value.value ? (value.more_is_better ? -*value.value : *value.value) : HUGE_VAL;
}

std::string all_objectives(const LayoutDesign& design) {
  std::vector<std::string> words;
  for (const NamedValue& objective : design.objectives) words.push_back(with_unit(objective));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// "worst-error-1-lost 0.12 mm instead of 0.1 mm (+20 %)"
std::string change(const NamedValue& to, const NamedValue& from) {
  std::string text = fmt::format("{} instead of {:.3g}{}{}", with_unit(to), *from.value,
                                 from.unit.empty() ? "" : " ", from.unit);
  if (*from.value > 0) text += fmt::format(" ({:+.0f} %)", 100 * (*to.value / *from.value - 1));
  return text;
}

std::string changes(const LayoutDesign& to, const LayoutDesign& from) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < to.objectives.size(); ++k) {
    const NamedValue& a = to.objectives[k];
    const NamedValue& b = from.objectives[k];
    if (a.name == "targets" || !a.value || !b.value || *a.value == *b.value) continue;
    words.push_back(change(a, b));
  }
  return words.empty() ? "nothing else" : fmt::format("{}", fmt::join(words, ", "));
}

/// Of the designs with so many targets, the front's best compromise.
const LayoutDesign* best_with(std::span<const LayoutDesign> front, std::size_t targets) {
  std::vector<double> objectives;
  for (const LayoutDesign& design : front) {
    for (const NamedValue& objective : design.objectives) objectives.push_back(minimised(objective));
  }
  const std::size_t m = front.front().objectives.size();
  const std::vector<double> shares = by_range(objectives, m);
  const LayoutDesign* best = nullptr;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < front.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < m; ++k) sum += shares[i * m + k];
    if (front[i].targets.size() != targets || !(sum < least)) continue;
    least = sum;
    best = &front[i];
  }
  return best;
}

}  // namespace

std::string why_the_knee(std::span<const LayoutDesign> front, std::size_t knee, std::size_t front_found) {
  const LayoutDesign& design = front[knee];
  std::string why = fmt::format(
      "{} ({}): of the {} designs of the front it comes nearest to the best of every "
      "objective at once, each counted by its way from the best to the worst",
      design.name, all_objectives(design), front_found);
  const std::size_t count = design.targets.size();
  if (const LayoutDesign* fewer = best_with(front, count - 1)) {
    why += fmt::format("; a target fewer ({}) means {}", fewer->name, changes(*fewer, design));
  }
  if (const LayoutDesign* more = best_with(front, count + 1)) {
    why += fmt::format("; a target more ({}) means {}", more->name, changes(*more, design));
  }
  return why;
}

std::string given_up_by(const LayoutDesign& design, std::span<const LayoutDesign> front) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < design.objectives.size(); ++k) {
    const LayoutDesign* best = &design;
    for (const LayoutDesign& other : front) {
      if (minimised(other.objectives[k]) < minimised(best->objectives[k])) best = &other;
    }
    if (best == &design || !design.objectives[k].value) continue;
    words.push_back(
        fmt::format("{}, which {} has", change(design.objectives[k], best->objectives[k]), best->name));
  }
  return words.empty() ? "nothing" : fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace asterism
