// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/optimization/cover_model.hpp"

namespace asterism {

/// What is left of a problem when all is taken out that does not matter to the least cost.
struct ReducedCover {
  CoverModel model;
  std::vector<std::uint32_t> column;  // the original number of each column left
  std::vector<std::uint32_t> forced;  // in every cover; original numbers
};

/// Again and again until nothing more goes:
///   rows alike become one, with the sum of their weights; where all must be covered, a row goes that is
///   covered whenever another is (its columns are among this one's, its demand as high);
///   columns go in without which a row cannot have what it demands, where all must be covered;
///   a column goes whose rows another covers too for no more, a group's opening included, where none of its
///   rows demands two.
/// (Beasley 1987; Caprara, Toth & Fischetti 2000.)
[[nodiscard]] ReducedCover reduced(CoverModel model);

}  // namespace asterism
