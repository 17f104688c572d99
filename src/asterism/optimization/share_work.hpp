// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

#include "asterism/core/parallel.hpp"

namespace asterism {

/// Calls body(i) for each i below `count`. The first calls tell whether the rest is worth sharing among
/// threads, whose start costs some 10 µs; results do not depend on it.
template <class Body>
void share_work(std::size_t count, const Body& body) {
  constexpr double kWorthSharing_s = 100e-6;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < count; ++i) {
    body(i);
    const std::size_t done = i + 1, left = count - done;
    if ((done & i) != 0 || left == 0) continue;  // ask the clock after 1, 2, 4, 8 … calls
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (spent.count() > kWorthSharing_s / 10 &&
        spent.count() * static_cast<double>(left) > kWorthSharing_s * static_cast<double>(done)) {
      parallel_for(left, [&](std::size_t k) { body(done + k); });
      return;
    }
  }
}

}  // namespace asterism
