// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/objectives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using Q = LayoutQuantity;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> listed(std::string_view text) {
  std::vector<std::string_view> parts;
  if (trimmed(text).empty()) return parts;
  for (std::size_t from = 0;;) {
    const std::size_t comma = text.find(',', from);
    parts.push_back(trimmed(text.substr(from, comma - from)));
    if (comma == std::string_view::npos) return parts;
    from = comma + 1;
  }
}

LayoutQuantity quantity_of(std::string_view name, std::string_view of) {
  std::vector<std::string> known;
  for (const LayoutQuantityInfo& info : layout_quantities()) {
    if (info.name == name) return info.quantity;
    known.push_back(info.name);
  }
  throw InputError(unknown_name_message(name, of, known));
}

double bound_of(std::string_view text, std::string_view constraint) {
  double bound = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bound);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(bound)) {
    throw InputError(fmt::format("constraint `{}`: `{}` is no number", constraint, text));
  }
  return bound;
}

}  // namespace

const std::vector<LayoutQuantityInfo>& layout_quantities() {
  static const std::vector<LayoutQuantityInfo> infos = {
      {Q::Targets, "targets", "", false, 1, "how many targets"},
      {Q::MeanSpacing, "mean-spacing", "mm", true, 10, "mean distance of two targets (the paper's Eq. 24)"},
      {Q::OriginDistance, "origin-distance", "mm", false, 10,
       "mean distance to the body's origin (f1 of the paper's Section 4.2)"},
      {Q::Coverage, "coverage", "mm", true, 100,
       "sum of the distances of all pairs (-f2 of the paper's Section 4.2)"},
      {Q::WorstError, "worst-error", "mm", false, 0.1,
       "largest predicted error at the task's points over the motion"},
      {Q::MeanError, "mean-error", "mm", false, 0.1, "its mean over points and motion"},
      {Q::WorstErrorOneLost, "worst-error-1-lost", "mm", false, 0.1,
       "largest error after the loss of any one target"},
      {Q::MeanErrorOneLost, "mean-error-1-lost", "mm", false, 0.1, "its mean over points and motion"},
      {Q::WorstErrorTwoLost, "worst-error-2-lost", "mm", false, 0.1,
       "largest error after the loss of any two targets"},
      {Q::MeanErrorTwoLost, "mean-error-2-lost", "mm", false, 0.1, "its mean over points and motion"},
      {Q::Visible, "visible", "targets", true, 1, "fewest targets that both cameras see, over the motion"},
      {Q::Availability, "availability", "", true, 0.1,
       "share of frames with four targets left when each is lost at random"},
      {Q::Identifiability, "identifiability", "mm", true, 1,
       "smallest RMS at which a wrong labelling fits, of this body or another"},
      {Q::Thickness, "thickness", "mm", true, 10, "RMS distance of the targets from their plane"},
      {Q::Spacing, "spacing", "mm", true, 10, "smallest distance of two targets"},
      {Q::Moving, "moving", "mm", false, 100, "way of all targets from where they stand now"}};
  return infos;
}

const LayoutQuantityInfo& info_of(LayoutQuantity quantity) {
  return layout_quantities()[static_cast<std::size_t>(quantity)];
}

double violation_of(const LayoutConstraint& constraint, double value) {
  const double short_of =
      info_of(constraint.quantity).more_is_better ? constraint.bound - value : value - constraint.bound;
  return std::max(0.0, short_of);
}

std::vector<LayoutQuantity> objectives_from(std::string_view text) {
  std::vector<LayoutQuantity> objectives;
  for (const std::string_view name : listed(text)) {
    const LayoutQuantity quantity = quantity_of(name, "a layout's objectives");
    if (std::find(objectives.begin(), objectives.end(), quantity) != objectives.end()) {
      throw InputError(fmt::format("objective `{}` is given twice", name));
    }
    objectives.push_back(quantity);
  }
  if (objectives.empty()) throw InputError("no objective is named; for instance \"targets, worst-error\"");
  return objectives;
}

std::vector<LayoutConstraint> constraints_from(std::string_view text) {
  std::vector<LayoutConstraint> constraints;
  for (const std::string_view part : listed(text)) {
    const std::size_t sign = part.find_first_of("<>");
    if (sign == std::string_view::npos || sign + 1 >= part.size() || part[sign + 1] != '=') {
      throw InputError(
          fmt::format("constraint `{}` is not of the form \"visible >= 5\" or \"worst-error <= 0.2\"", part));
    }
    const LayoutQuantity quantity = quantity_of(trimmed(part.substr(0, sign)), "a layout's constraints");
    const LayoutQuantityInfo& info = info_of(quantity);
    if ((part[sign] == '>') != info.more_is_better) {
      throw InputError(fmt::format("constraint `{}`: {} of `{}` is better, so it takes {}=", part,
                                   info.more_is_better ? "more" : "less", info.name,
                                   info.more_is_better ? '>' : '<'));
    }
    for (const LayoutConstraint& other : constraints) {
      if (other.quantity == quantity)
        throw InputError(fmt::format("constraint `{}` is given twice", info.name));
    }
    constraints.push_back({quantity, bound_of(trimmed(part.substr(sign + 2)), part)});
  }
  return constraints;
}

std::vector<std::string> warnings_about(const std::vector<LayoutQuantity>& objectives) {
  const auto asks = [&](Q quantity) {
    return std::find(objectives.begin(), objectives.end(), quantity) != objectives.end();
  };
  const bool only_paper = std::all_of(objectives.begin(), objectives.end(), [](Q quantity) {
    return quantity == Q::Targets || quantity == Q::MeanSpacing || quantity == Q::OriginDistance ||
           quantity == Q::Coverage;
  });
  std::vector<std::string> warnings;
  if (objectives.size() == 1) {
    warnings.push_back("with one objective there is one best layout and no front");
  }
  if (asks(Q::Targets) && asks(Q::MeanSpacing)) {
    warnings.push_back(
        "`targets` and `mean-spacing` do not conflict: of any layout some target can be left out without "
        "lowering the mean spacing, so the front is the fewest targets alone");
  }
  if (asks(Q::OriginDistance) && asks(Q::Coverage)) {
    warnings.push_back(
        "`origin-distance` and `coverage` only rank layouts by size: every scaling of one layout is on the "
        "front");
  }
  if (only_paper) {
    warnings.push_back(
        "none of the objectives says how accurate the layout is, whether it is seen, or whether it can be "
        "mistaken for itself; ask for `worst-error-1-lost` and `identifiability`");
  }
  return warnings;
}

}  // namespace asterism
