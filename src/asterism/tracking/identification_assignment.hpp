// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/tracking/identification_search.hpp"

namespace asterism {

/// The labelling of one body in the best disjoint set, and whether another set is nearly as good.
struct Choice {
  std::size_t labelling;  // index
  LabelStatus status = LabelStatus::Ok;
  std::vector<Correspondence> certain;  // the labels on which all sets nearly as good agree
  std::optional<double> rival_rms_mm;   // of the best fitting of those with as many labels
};

/// The set of labellings, at most one a body, sharing neither points nor claims, whose costs add up to the
/// least; one choice a body that has one, in the order of bodies. Exact (branch and bound), body by body
/// where they do not compete. A set within `decisive` of the best is a rival: what differs in it is not
/// certain, and a body left with fewer than `fewest` certain labels is Ambiguous.
[[nodiscard]] std::vector<Choice> choose_disjoint(std::span<const Labelling> labellings,
                                                  std::span<const Claims> claims, std::size_t bodies,
                                                  double decisive, std::size_t fewest);

}  // namespace asterism
