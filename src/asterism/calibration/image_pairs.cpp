// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/image_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// The last run of digits of a name without folder and ending, leading zeros taken off; empty without one.
std::string last_number(const std::string& name) {
  const std::size_t folder = name.find_last_of('/');
  std::string stem = folder == std::string::npos ? name : name.substr(folder + 1);
  if (const std::size_t dot = stem.find_last_of('.'); dot != std::string::npos) stem.resize(dot);
  constexpr const char* kDigits = "0123456789";
  const std::size_t end = stem.find_last_of(kDigits);
  if (end == std::string::npos) return "";
  const std::size_t before = stem.find_last_not_of(kDigits, end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t first = stem.find_first_not_of('0', begin);
  return first == std::string::npos || first > end ? "0" : stem.substr(first, end - first + 1);
}

/// Name's number → index; empty when a name has none or two have the same.
std::map<std::string, std::size_t> by_number(const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string number = last_number(names[i]);
    if (number.empty() || !numbers.emplace(number, i).second) return {};
  }
  return numbers;
}

}  // namespace

ImagePairing pair_images(const std::vector<std::string>& left, const std::vector<std::string>& right) {
  if (left.empty() || right.empty()) {
    throw InputError(fmt::format("the {} camera has no images", left.empty() ? "left" : "right"));
  }
  ImagePairing pairing;
  auto left_numbers = by_number(left), right_numbers = by_number(right);
  const bool any_common = std::any_of(left_numbers.begin(), left_numbers.end(),
                                      [&](const auto& entry) { return right_numbers.contains(entry.first); });
  if (any_common) {
    pairing.by_number = true;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto partner = right_numbers.find(last_number(left[i]));
      if (partner == right_numbers.end()) {
        pairing.pairs.push_back({i, std::nullopt});
        continue;
      }
      pairing.pairs.push_back({i, partner->second});
      right_numbers.erase(partner);
    }
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (right_numbers.contains(last_number(right[i]))) pairing.pairs.push_back({std::nullopt, i});
    }
    return pairing;
  }
  if (left.size() != right.size()) {
    throw InputError(
        fmt::format("{} left and {} right images, and their names do not say which belong together: "
                    "number them alike (left07.png, right07.png) or give as many of each",
                    left.size(), right.size()));
  }
  for (std::size_t i = 0; i < left.size(); ++i) pairing.pairs.push_back({i, i});
  return pairing;
}

}  // namespace asterism
