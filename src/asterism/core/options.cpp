// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string SectionVisitor::full(std::string_view name) const { return fmt::format("{}.{}", section_, name); }

void SectionVisitor::number(std::string_view name, double& value, Limits limits, std::string_view help) {
  whole_.number(full(name), value, limits, help);
}

void SectionVisitor::integer(std::string_view name, int& value, Limits limits, std::string_view help) {
  whole_.integer(full(name), value, limits, help);
}

void SectionVisitor::flag(std::string_view name, bool& value, std::string_view help) {
  whole_.flag(full(name), value, help);
}

void SectionVisitor::text(std::string_view name, std::string& value, std::string_view help) {
  whole_.text(full(name), value, help);
}

void SectionVisitor::choice(std::string_view name, int& index, const std::vector<std::string>& words,
                            std::string_view help) {
  whole_.choice(full(name), index, words, help);
}

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, wrong.size() / 2) + 1;
  for (const auto& name : known) {
    const std::size_t distance = edit_distance(wrong, name);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = name;
  }
  return best;
}

std::string unknown_name_message(std::string_view wrong, std::string_view of,
                                 const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(wrong, known);
  if (!nearest.empty()) return fmt::format("`{}` is no key of {}; did you mean `{}`?", wrong, of, nearest);
  return fmt::format("`{}` is no key of {}; known are: {}", wrong, of, fmt::join(known, ", "));
}

void check_number(std::string_view name, double value, Limits limits) {
  if (std::isfinite(value) && value >= limits.lowest && value <= limits.highest) return;
  throw InputError(
      fmt::format("`{}` is {}; it must lie between {} and {}", name, value, limits.lowest, limits.highest));
}

}  // namespace asterism
