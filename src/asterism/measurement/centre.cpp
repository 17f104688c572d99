// SPDX-License-Identifier: Apache-2.0
#include "asterism/measurement/centre.hpp"

#include <array>
#include <sstream>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

const std::vector<std::string> kFlagNames = {"saturated", "occluded", "border",
                                             "touching",  "small",    "coarse"};

}  // namespace

std::string text_of_flags(std::uint32_t flags) {
  std::string text;
  for (std::size_t bit = 0; bit < kFlagNames.size(); ++bit) {
    if ((flags >> bit & 1U) == 0) continue;
    if (!text.empty()) text += '|';
    text += kFlagNames[bit];
  }
  return text;
}

std::uint32_t flags_of_text(const std::string& text) {
  std::uint32_t flags = 0;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, '|');) {
    std::size_t bit = 0;
    while (bit < kFlagNames.size() && kFlagNames[bit] != word) ++bit;
    if (bit == kFlagNames.size()) throw InputError(unknown_name_message(word, "flags", kFlagNames));
    flags |= 1U << bit;
  }
  return flags;
}

}  // namespace asterism
