// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/find_board.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/calibration/rig_for_tests.hpp"

namespace asterism {
namespace {

const Lens kLens{700, 700, 0, 319.5, 239.5, {}, 0, 640, 480};
const RigidMotion kPose{exp_rotation(Vec3(0.35, -0.3, 0.1)), Vec3(-110, -75, 620)};

/// The ideal grey level of the board's plane at a place, mm.
double grey_on(const Board& board, const Vec3& place) {
  const double pitch = board.pitch_mm;
  if (board.pattern == BoardPattern::Chessboard) {
    const double right = board.columns * pitch, bottom = board.rows * pitch;
    if (place.x() < -pitch || place.y() < -pitch || place.x() >= right || place.y() >= bottom) return 200;
    const auto square = static_cast<int>(std::floor(place.x() / pitch) + std::floor(place.y() / pitch));
    return square % 2 == 0 ? 200 : 40;
  }
  for (const Vec3& centre : board_points(board)) {
    if ((place - centre).norm() < 0.5 * board.circle_diameter_mm) return 40;
  }
  return 200;
}

Image render(const Board& board) {
  constexpr int kFine = 6;
  const RigidMotion board_from_camera = kPose.inverse();
  Raster8 image(kLens.width_px, kLens.height_px);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double sum = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const Vec2 px(x + (k % kFine + 0.5) / kFine - 0.5, y + (k / kFine + 0.5) / kFine - 0.5);
        const Vec3 ray = board_from_camera.rotation * sight_line(kLens, px)->xy.homogeneous();
        const Vec3& from = board_from_camera.translation;
        sum += grey_on(board, from - ray * (from.z() / ray.z()));
      }
      image.row(y)[x] = static_cast<std::uint8_t>(std::lround(sum / (kFine * kFine)));
    }
  }
  return image;
}

/// The largest distance of a point from where it should be, the better of the ways round.
double worst_error(const BoardView& view, const Board& board) {
  double best = 1e9;
  for (const auto& way : board_symmetries(board)) {
    double worst = 0;
    for (const BoardPoint& point : view.points) {
      const auto truth =
          board_points(board)[static_cast<std::size_t>(way[static_cast<std::size_t>(point.point)])];
      const Disc disc{kPose * truth, kPose.rotation * Vec3::UnitZ(), 0.5 * board.circle_diameter_mm};
      worst = std::max(worst, (project_disc_centre(kLens, disc)->px - point.px).norm());
    }
    best = std::min(best, worst);
  }
  return best;
}

TEST(FindBoard, MeasuresEachCornerOfATiltedChessboard) {
  const Board board{BoardPattern::Chessboard, 9, 6, 25, 0};
  const auto view = find_board(render(board), board);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->points.size(), 54U);
  EXPECT_LT(worst_error(*view, board), 0.05);  // no lens blur here: edges alias, 6 × 6 samples a pixel
}

TEST(FindBoard, MeasuresTheCentresOfBothCircleGrids) {
  for (const Board& board :
       {Board{BoardPattern::Circles, 9, 6, 25, 15}, Board{BoardPattern::AsymmetricCircles, 4, 9, 20, 18}}) {
    const auto view = find_board(render(board), board);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->points.size(), static_cast<std::size_t>(board.columns * board.rows));
    EXPECT_LT(worst_error(*view, board), 0.02);
    EXPECT_NEAR(view->diameter_of_pitch, board.circle_diameter_mm / board.pitch_mm, 0.03);
  }
}

TEST(FindBoard, SaysThatABoardOfAnotherSizeIsNotThere) {
  const Board board{BoardPattern::Chessboard, 9, 6, 25, 0};
  EXPECT_EQ(find_board(render(board), {BoardPattern::Chessboard, 8, 5, 25, 0}).error(),
            BoardFailure::NotFound);
  EXPECT_EQ(find_board(Raster8(640, 480), board).error(), BoardFailure::NotFound);
}

TEST(ViewImage, RefusesAnImageOfAnotherSize) {
  const CalibrationImage image =
      view_image("left3.png", Raster8(640, 400), 640, 480, {BoardPattern::Chessboard, 9, 6, 25, 0}, {});
  EXPECT_EQ(image.refused, "size 640 x 400 differs from the first image's 640 x 480");
}

TEST(ReadBoardSize, SaysHowASizeIsWritten) {
  Board board;
  read_board_size("11x8", board);
  EXPECT_EQ(board.columns, 11);
  EXPECT_EQ(board.rows, 8);
  for (const char* wrong : {"", "11", "11x", "x8", "11*8", "11x8x2"})
    EXPECT_THROW(read_board_size(wrong, board), InputError) << wrong;
}

TEST(CheckBoard, RefusesBoardsTooSmallOrWithoutLength) {
  EXPECT_THROW(check_board({BoardPattern::Chessboard, 2, 6, 25, 0}), InputError);
  EXPECT_THROW(check_board({BoardPattern::Chessboard, 9, 6, 0, 0}), InputError);
  EXPECT_THROW(check_board({BoardPattern::Circles, 9, 6, 25, 26}), InputError);
}

}  // namespace
}  // namespace asterism
