// SPDX-License-Identifier: Apache-2.0
#include "asterism/measurement/pose.hpp"

#include <array>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

const std::vector<std::string> kNames = {"OK", "PARTIAL", "PREDICTED", "AMBIGUOUS", "LOST"};

}  // namespace

std::string_view text_of(PoseStatus status) { return kNames[static_cast<std::size_t>(status)]; }

PoseStatus status_of_text(std::string_view text) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == text) return static_cast<PoseStatus>(i);
  }
  throw InputError(unknown_name_message(text, "status", kNames));
}

}  // namespace asterism
