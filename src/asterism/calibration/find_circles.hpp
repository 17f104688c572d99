// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/calibration/find_board.hpp"

namespace asterism {

/// The circle grids of find_board: detection's targets, ordered into the grid by OpenCV, dark circles on
/// light or light on dark.
[[nodiscard]] Result<BoardView, BoardFailure> find_circles(const Image& image, const Board& board);

}  // namespace asterism
