// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/calibration/bundle.hpp"

namespace asterism {

/// A first pose of the board from one view (homography, then OpenCV's iterative resection); empty when it
/// does not come off.
[[nodiscard]] std::optional<RigidMotion> board_pose(const BoardView& view, const Board& board,
                                                    const Lens& lens);

/// A first lens from several views: Zhang's focal length with the principal point in the middle, then a
/// bundle of this camera alone. `poses` gets camera_from_board, one a view.
struct LensStart {
  Lens lens;
  std::vector<RigidMotion> poses;
  double rms_px = 0;
};
[[nodiscard]] std::optional<LensStart> start_lens(const std::vector<BoardView>& views, const Board& board,
                                                  int width_px, int height_px, int coefficients);

/// The motion between the cameras on which most pairs agree. A symmetric board may have been read from
/// the other end in one image: of each pair the way is taken that agrees, and `right` renumbered to it.
/// `agrees[i]` is false for pairs that fit in no way.
struct PairStart {
  RigidMotion right_from_left;
  std::vector<bool> agrees;
};
struct PairPoses {
  RigidMotion left_from_board, right_from_board;
};
[[nodiscard]] PairStart start_pair(const std::vector<PairPoses>& pairs, std::vector<BoardView*> right,
                                   const Board& board);

}  // namespace asterism
