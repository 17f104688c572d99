// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace asterism {

/// How many threads parallel loops may use; 0 = as many as the machine has. Results never depend on it.
void set_thread_count(int threads);

/// Calls `body(i)` for each i in [0, count), in any order, on several threads. Each call writes its own
/// slot; whatever is combined is combined by the caller in index order, so the bits stay the same.
/// The first exception thrown is thrown on.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace asterism
