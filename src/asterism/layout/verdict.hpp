// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "asterism/layout/design.hpp"

namespace asterism {

/// In words: why this design of the front is the one to start from, and what the nearest designs with a
/// target fewer and a target more would cost and win.
[[nodiscard]] std::string why_the_knee(std::span<const LayoutDesign> front, std::size_t knee,
                                       std::size_t front_found);

/// In words: what a design gives up in each objective against the best of the front.
[[nodiscard]] std::string given_up_by(const LayoutDesign& design, std::span<const LayoutDesign> front);

}  // namespace asterism
