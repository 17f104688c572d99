// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace asterism {

/// Told by long jobs how far they are. The library calls it; the apps draw it.
/// `stage` is a short phrase ("rendering images"); done counts up to total.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// For callers that do not care.
inline void no_progress(std::string_view, std::size_t, std::size_t) {}

}  // namespace asterism
