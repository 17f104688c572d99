// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/optimization/optimizer.hpp"

namespace asterism {

std::string words(StopReason reason) {
  switch (reason) {
    case StopReason::Generations:
      return "all generations done";
    case StopReason::Evaluations:
      return "all evaluations done";
    case StopReason::Time:
      return "time used up";
    case StopReason::Stagnation:
      return "hypervolume hardly grows";
  }
  return "";
}

std::string infeasibility(const OptimizationResult& result) {
  if (result.shortfalls.empty()) return "";
  std::string text = "no candidate holds all constraints; the closest misses ";
  for (std::size_t i = 0; i < result.shortfalls.size(); ++i) {
    const auto& [constraint, violation] = result.shortfalls[i];
    const char* join = i == 0 ? "" : i + 1 == result.shortfalls.size() ? " and " : ", ";
    text += fmt::format("{}`{}` by {:.4g}{}{}", join, constraint.name, violation,
                        constraint.unit.empty() ? "" : " ", constraint.unit);
  }
  return text;
}

}  // namespace asterism
