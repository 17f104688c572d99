// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/find_board.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "asterism/calibration/corner_fit.hpp"
#include "asterism/calibration/find_circles.hpp"

namespace asterism {
namespace {

Vec2 vec(const cv::Point2f& p) { return {p.x, p.y}; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// An 8-bit copy for OpenCV's finders, stretched to the range of a 16-bit image.
cv::Mat grey8(const Image& image) {
  if (const auto* raster = std::get_if<Raster8>(&image)) {
    cv::Mat copy(raster->height, raster->width, CV_8U);
    std::copy(raster->pixels.begin(), raster->pixels.end(), copy.data);
    return copy;
  }
  const auto& raster = std::get<Raster16>(image);
  const double top = *std::max_element(raster.pixels.begin(), raster.pixels.end());
  cv::Mat copy(raster.height, raster.width, CV_8U);
  std::transform(raster.pixels.begin(), raster.pixels.end(), copy.data, [&](std::uint16_t grey) {
    return static_cast<std::uint8_t>(255.0 * grey / std::max(1.0, top));
  });
  return copy;
}

/// OpenCV's corners in one image; empty when it sees no board.
std::vector<cv::Point2f> opencv_corners(const cv::Mat& grey, const Board& board) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (cv::findChessboardCornersSB(grey, size, corners)) return corners;
  if (cv::findChessboardCorners(grey, size, corners)) return corners;
  return {};
}

/// Corners good to a pixel or so. Sought in a small copy first: that is many times faster, and blur and
/// noise disturb the finder less; the fit that follows needs no more.
std::vector<cv::Point2f> rough_corners(const cv::Mat& grey, const Board& board) {
  constexpr int kQuickWidth = 1100;
  if (const int shrink = (grey.cols + kQuickWidth - 1) / kQuickWidth; shrink > 1) {
    cv::Mat small;
    cv::resize(grey, small, {grey.cols / shrink, grey.rows / shrink}, 0, 0, cv::INTER_AREA);
    auto corners = opencv_corners(small, board);
    for (auto& corner : corners) {
      const float scale = static_cast<float>(shrink);
      corner = (corner + cv::Point2f(0.5F, 0.5F)) * scale - cv::Point2f(0.5F, 0.5F);
    }
    if (!corners.empty()) return corners;
  }
  return opencv_corners(grey, board);
}

/// The image of one step along the board, by the neighbours on both sides where there are two.
Vec2 step_at(const std::vector<cv::Point2f>& corners, int index, int place, int count, int stride) {
  const int before = place > 0 ? index - stride : index;
  const int after = place + 1 < count ? index + stride : index;
  const int steps = (after - before) / stride;
  return (vec(corners[static_cast<std::size_t>(after)]) - vec(corners[static_cast<std::size_t>(before)])) /
         steps;
}

Result<BoardView, BoardFailure> find_chessboard(const Image& image, const Board& board,
                                                const BoardSearchOptions& options) {
  const auto corners = rough_corners(grey8(image), board);
  if (corners.empty()) return because(BoardFailure::NotFound);
  BoardView view;
  std::vector<double> pitches, blurs;
  for (int index = 0; index < static_cast<int>(corners.size()); ++index) {
    CornerStart start{vec(corners[static_cast<std::size_t>(index)]), Mat2::Zero()};
    start.px_by_square.col(0) = step_at(corners, index, index % board.columns, board.columns, 1);
    start.px_by_square.col(1) = step_at(corners, index, index / board.columns, board.rows, board.columns);
    pitches.push_back(std::sqrt(std::abs(start.px_by_square.determinant())));
    const auto corner = fit_corner(image, start, options.reach_squares);
    if (!corner) {
      if (corner.error() == CornerFailure::SquareTooSmall) return because(BoardFailure::SquaresTooSmall);
      continue;
    }
    view.points.push_back({index, corner->px, corner->covariance});
    blurs.push_back(corner->blur_px);
  }
  if (view.points.size() * 10 < corners.size() * 9) return because(BoardFailure::PointsNotSharp);
  view.pitch_px = median(pitches);
  view.blur_px = median(blurs);
  if (view.blur_px > options.max_blur_of_pitch * view.pitch_px) return because(BoardFailure::Blurred);
  return view;
}

}  // namespace

std::string_view text_of(BoardFailure failure) {
  switch (failure) {
    case BoardFailure::NotFound:
      return "board not found";
    case BoardFailure::SquaresTooSmall:
      return "the board's squares are too small in the image";
    case BoardFailure::PointsNotSharp:
      return "too many of the board's points could not be measured";
    case BoardFailure::Blurred:
      return "blurred";
  }
  return "";
}

void describe(BoardSearchOptions& options, OptionVisitor& visit) {
  visit.number("max_blur_of_pitch", options.max_blur_of_pitch, {0.01, 1},
               "refuse images blurred by more of a square");
  visit.number("reach_squares", options.reach_squares, {0.1, 0.9},
               "how far from a corner its edges are used");
}

Result<BoardView, BoardFailure> find_board(const Image& image, const Board& board,
                                           const BoardSearchOptions& options) {
  check_board(board);
  if (board.pattern == BoardPattern::Chessboard) return find_chessboard(image, board, options);
  return find_circles(image, board);
}

}  // namespace asterism
