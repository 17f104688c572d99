// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "asterism/calibration/board.hpp"
#include "asterism/calibration/board_view.hpp"
#include "asterism/camera/image.hpp"
#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"

namespace asterism {

enum class BoardFailure { NotFound, SquaresTooSmall, PointsNotSharp, Blurred };
[[nodiscard]] std::string_view text_of(BoardFailure failure);

struct BoardSearchOptions {
  double max_blur_of_pitch = 0.12;  // a corner's edges blurred by more of a square: refused
  double reach_squares = 0.45;      // how far from the corner its edges are used
};
void describe(BoardSearchOptions& options, OptionVisitor& visit);

/// Finds the whole board and measures each of its points with covariance. OpenCV says where the board is
/// (findChessboardCornersSB, then findChessboardCorners; findCirclesGrid); the points are our own: a
/// maximum-likelihood fit of the crossing edges, or of the ellipse's edge. Which end of a symmetric board is
/// point 0 is the finder's guess (see board_symmetries).
[[nodiscard]] Result<BoardView, BoardFailure> find_board(const Image& image, const Board& board,
                                                         const BoardSearchOptions& options = {});

}  // namespace asterism
