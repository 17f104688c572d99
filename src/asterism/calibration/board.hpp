// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

enum class BoardPattern { Chessboard, Circles, AsymmetricCircles };

/// A flat calibration board. Its frame: x along a row, y along a column, z = x × y, origin at point 0.
struct Board {
  BoardPattern pattern = BoardPattern::Chessboard;
  int columns = 0, rows = 0;  // inner corners, or circles
  /// Chessboard and circles: between neighbours of a row. Asymmetric circles: between rows, which is half
  /// the distance of neighbours in a row (as OpenCV).
  double pitch_mm = 0;
  double circle_diameter_mm = 0;  // 0 = not known: estimated from the images

  [[nodiscard]] int count() const { return columns * rows; }
  /// The place of a point in the board's order, row by row.
  [[nodiscard]] int index(int row, int column) const { return row * columns + column; }
};

/// Where the points lie, row by row, mm, z = 0.
[[nodiscard]] std::vector<Vec3> board_points(const Board& board);

/// The ways in which the board can be taken for itself when it is turned: `ways[k][i]` is the point that
/// point i is taken for. The first is the identity. A finder that starts at the wrong end of the board
/// uses another way.
[[nodiscard]] std::vector<std::vector<int>> board_symmetries(const Board& board);

/// "11x8" → columns 11, rows 8. Throws InputError.
void read_board_size(const std::string& text, Board& board);

/// Throws InputError when there are fewer than 3 × 3 points or lengths that are not positive.
void check_board(const Board& board);

}  // namespace asterism
