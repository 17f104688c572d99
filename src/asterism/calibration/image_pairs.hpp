// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace asterism {

/// Which image of each camera belongs to which; an index is missing where there is no partner.
struct ImagePair {
  std::optional<std::size_t> left, right;
};

struct ImagePairing {
  bool by_number = false;  // else in the order given
  std::vector<ImagePair> pairs;
};

/// Pairs image names by the last number in each (left07.jpg with right07.jpg), where every name has one
/// and no camera has one twice; else in the order given. Throws InputError when a camera has no images, or
/// the numbers of images differ and nothing in the names says which belong together.
[[nodiscard]] ImagePairing pair_images(const std::vector<std::string>& left,
                                       const std::vector<std::string>& right);

}  // namespace asterism
