// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asterism/cell/body.hpp"

namespace asterism {

/// How far a body is from being taken for itself under wrong labels, by its coordinates alone.
struct BodyAmbiguity {
  double all_seen_mm = 0;   // RMS of the best wrong labelling of all targets; the cap where none is below
  double four_seen_mm = 0;  // the same for the worst four (three of a body of three)
  double cap_mm = 0;
  bool complete = true;  // false: too many choices to try them all
  std::vector<int> seen,
      taken_for;               // the worst four and their wrong labels; empty when none is below the cap
  std::optional<int> culprit;  // takes part most often in what fits below `least_mm`
};

/// Tries every four of a body's targets (all proper rigid fits onto wrong labels). A tracker that sees only
/// those four cannot tell the two poses apart when the margin is near its noise.
[[nodiscard]] BodyAmbiguity find_ambiguity(const Body& body, double least_mm, double cap_mm = 100.0);

/// "if only T1, T2, T4, T5 are seen they pass for T2, T1, T5, T4 within 0.27 mm: move T4 by 5 mm or more";
/// empty when every margin is `least_mm` or more.
[[nodiscard]] std::string advice_against(const BodyAmbiguity& ambiguity, const Body& body, double least_mm);

}  // namespace asterism
