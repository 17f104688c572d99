// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_ambiguity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "asterism/geometry/congruence_margin.hpp"

namespace asterism {
namespace {

constexpr std::size_t kMostSubsets = 5000;  // 26 targets have 14,950

std::vector<int> first_of(std::size_t count) {
  std::vector<int> chosen(count);
  std::iota(chosen.begin(), chosen.end(), 0);
  return chosen;
}

/// The next subset in lexicographic order; false after the last.
bool advance(std::vector<int>& chosen, int total) {
  const auto size = static_cast<int>(chosen.size());
  for (int i = size - 1; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    if (chosen[at] == total - size + i) continue;
    ++chosen[at];
    for (std::size_t k = at + 1; k < chosen.size(); ++k) chosen[k] = chosen[k - 1] + 1;
    return true;
  }
  return false;
}

std::vector<Vec3> picked(const std::vector<Vec3>& positions, const std::vector<int>& chosen) {
  std::vector<Vec3> some;
  for (const int t : chosen) some.push_back(positions[static_cast<std::size_t>(t)]);
  return some;
}

std::string names_of(const std::vector<int>& targets, const Body& body) {
  std::vector<std::string> names;
  for (const int t : targets) names.push_back(body.targets[static_cast<std::size_t>(t)].id);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

BodyAmbiguity find_ambiguity(const Body& body, double least_mm, double cap_mm) {
  const std::vector<Vec3> positions = positions_of(body.targets);
  BodyAmbiguity ambiguity{cap_mm, cap_mm, cap_mm, true, {}, {}, std::nullopt};
  if (positions.size() < 3) return ambiguity;
  const auto everything = first_of(positions.size());
  const auto whole = best_wrong_labelling(positions, positions, everything, cap_mm);
  if (whole.best) ambiguity.all_seen_mm = whole.best->rms_mm;
  ambiguity.complete = whole.complete;

  std::vector<int> blame(positions.size(), 0);
  auto chosen = first_of(std::min<std::size_t>(positions.size(), 4));
  std::size_t tried = 0;
  do {
    if (++tried > kMostSubsets) ambiguity.complete = false;
    if (tried > kMostSubsets) break;
    const double cap = std::max(least_mm, ambiguity.four_seen_mm);
    const auto search = best_wrong_labelling(picked(positions, chosen), positions, chosen, cap);
    ambiguity.complete = ambiguity.complete && search.complete;
    if (!search.best) continue;
    if (search.best->rms_mm < least_mm) {
      for (const int t : chosen) ++blame[static_cast<std::size_t>(t)];
    }
    if (search.best->rms_mm >= ambiguity.four_seen_mm) continue;
    ambiguity.four_seen_mm = search.best->rms_mm;
    ambiguity.seen = chosen;
    ambiguity.taken_for = search.best->label;
  } while (advance(chosen, static_cast<int>(positions.size())));
  const auto most = std::max_element(blame.begin(), blame.end());
  if (*most > 0) ambiguity.culprit = static_cast<int>(most - blame.begin());
  return ambiguity;
}

std::string advice_against(const BodyAmbiguity& ambiguity, const Body& body, double least_mm) {
  if (ambiguity.four_seen_mm >= least_mm || ambiguity.seen.empty()) return "";
  std::string text =
      ambiguity.all_seen_mm < least_mm
          ? fmt::format(
                "even with all targets seen the body passes for itself under other labels within {:.2f} mm; ",
                ambiguity.all_seen_mm)
          : "";
  text +=
      fmt::format("if only {} are seen, they pass for {} within {:.2f} mm", names_of(ambiguity.seen, body),
                  names_of(ambiguity.taken_for, body), ambiguity.four_seen_mm);
  if (ambiguity.culprit) {
    text += fmt::format(": move {} by some centimetres, out of line with the others",
                        body.targets[static_cast<std::size_t>(*ambiguity.culprit)].id);
  }
  return text;
}

}  // namespace asterism
