// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

#include "asterism/core/parallel.hpp"

namespace asterism {

/// Calls body(i) for each i below `count`. The first calls tell whether the rest is worth sharing among
/// threads, whose start costs some 10 µs; results do not depend on it.
template <class Body>
void share_work(std::size_t count, const Body& body) {
  using Clock = std::chrono::steady_clock;
  constexpr double kWorthSharing_s = 100e-6;
  double call_s = std::numeric_limits<double>::infinity();  // the fastest: the system may hold up others
  Clock::time_point last = Clock::now();
  std::size_t timed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    body(i);
    const std::size_t done = i + 1, left = count - done;
    if ((done & i) != 0 || left == 0) continue;  // ask the clock after 1, 2, 4, 8 … calls
    const Clock::time_point now = Clock::now();
    call_s = std::min(call_s,
                      std::chrono::duration<double>(now - last).count() / static_cast<double>(done - timed));
    last = now;
    timed = done;
    if (call_s * static_cast<double>(left) > kWorthSharing_s) {
      parallel_for(left, [&](std::size_t k) { body(done + k); });
      return;
    }
  }
}

}  // namespace asterism
