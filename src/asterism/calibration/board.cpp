// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {

std::vector<Vec3> board_points(const Board& board) {
  std::vector<Vec3> points;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const int x = board.pattern == BoardPattern::AsymmetricCircles ? 2 * column + row % 2 : column;
      points.emplace_back(x * board.pitch_mm, row * board.pitch_mm, 0.0);
    }
  }
  return points;
}

std::vector<std::vector<int>> board_symmetries(const Board& board) {
  const int count = board.count();
  std::vector<int> same(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) same[static_cast<std::size_t>(i)] = i;
  std::vector<std::vector<int>> ways = {same};
  // An asymmetric grid turned by 180° is itself only when it has an odd number of rows.
  if (board.pattern == BoardPattern::AsymmetricCircles && board.rows % 2 == 0) return ways;
  ways.emplace_back(same.rbegin(), same.rend());
  if (board.pattern != BoardPattern::AsymmetricCircles && board.columns == board.rows) {
    std::vector<int> quarter(same.size());
    for (int row = 0; row < board.rows; ++row) {
      for (int column = 0; column < board.columns; ++column) {
        quarter[static_cast<std::size_t>(board.index(row, column))] =
            board.index(column, board.columns - 1 - row);
      }
    }
    ways.push_back(quarter);
    ways.emplace_back(quarter.rbegin(), quarter.rend());
  }
  return ways;
}

void read_board_size(const std::string& text, Board& board) {
  const char* end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, board.columns);
  const bool crossed = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x';
  const auto rows = crossed ? std::from_chars(columns.ptr + 1, end, board.rows) : columns;
  if (!crossed || rows.ec != std::errc() || rows.ptr != end) {
    throw InputError(
        fmt::format("board size `{}`: expected columns x rows of inner corners or circles, e.g. 11x8", text));
  }
}

void check_board(const Board& board) {
  if (board.columns < 3 || board.rows < 3) {
    throw InputError(fmt::format("board size {}x{}: at least 3x3 inner corners or circles are needed",
                                 board.columns, board.rows));
  }
  if (!(board.pitch_mm > 0) || !std::isfinite(board.pitch_mm)) {
    throw InputError(fmt::format("board pitch {} mm: must be a positive length", board.pitch_mm));
  }
  const double room_mm =
      board.pitch_mm * (board.pattern == BoardPattern::AsymmetricCircles ? std::sqrt(2.0) : 1.0);
  if (!(board.circle_diameter_mm >= 0 && board.circle_diameter_mm < room_mm)) {
    throw InputError(
        fmt::format("circle diameter {} mm: must be positive and less than the {} mm between circles",
                    board.circle_diameter_mm, room_mm));
  }
}

}  // namespace asterism
