// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/find_circles.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "asterism/detection/detect.hpp"

namespace asterism {
namespace {

/// The centres in the grid's order; empty when they form no such grid.
std::vector<Centre> ordered_into_grid(const std::vector<Centre>& centres, const Board& board) {
  const auto count = static_cast<std::size_t>(board.count());
  if (centres.size() < count) return {};
  std::vector<cv::Point2f> candidates, grid;
  for (const Centre& centre : centres) {
    candidates.emplace_back(static_cast<float>(centre.px().x()), static_cast<float>(centre.px().y()));
  }
  const int pattern =
      board.pattern == BoardPattern::Circles ? cv::CALIB_CB_SYMMETRIC_GRID : cv::CALIB_CB_ASYMMETRIC_GRID;
  const cv::Size size(board.columns, board.rows);
  // Clustering stands clutter better, the other way stands perspective better.
  bool found = false;
  for (const int flags : {pattern, pattern | static_cast<int>(cv::CALIB_CB_CLUSTERING)}) {
    found = found || cv::findCirclesGrid(candidates, size, grid, flags, cv::Ptr<cv::FeatureDetector>());
  }
  if (!found || grid.size() != count) return {};
  std::vector<Centre> ordered;
  for (const cv::Point2f& place : grid) {
    const auto nearest = std::min_element(
        candidates.begin(), candidates.end(),
        [&](const auto& a, const auto& b) { return cv::norm(a - place) < cv::norm(b - place); });
    ordered.push_back(centres[static_cast<std::size_t>(nearest - candidates.begin())]);
  }
  return ordered;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Pitch and diameter over pitch from areas, which tilt shrinks alike.
void measure_sizes(BoardView& view, const std::vector<Centre>& grid, const Board& board) {
  std::vector<double> pitches, shares;
  const auto at = [&](int row, int column) -> const Centre& {
    return grid[static_cast<std::size_t>(board.index(row, column))];
  };
  // Two steps of an asymmetric grid span a parallelogram of two pitches squared.
  const double pitches_squared = board.pattern == BoardPattern::AsymmetricCircles ? 2.0 : 1.0;
  for (int row = 0; row + 1 < board.rows; ++row) {
    for (int column = 0; column + 1 < board.columns; ++column) {
      const Vec2 along = at(row, column + 1).px() - at(row, column).px();
      const Vec2 down = at(row + 1, column).px() - at(row, column).px();
      const double cell = std::abs(along.x() * down.y() - along.y() * down.x()) / pitches_squared;
      const Ellipse& ellipse = at(row, column).ellipse;
      pitches.push_back(std::sqrt(cell));
      shares.push_back(2 * std::sqrt(ellipse.semi_major * ellipse.semi_minor / cell));
    }
  }
  view.pitch_px = median(pitches);
  view.diameter_of_pitch = median(shares);
}

}  // namespace

Result<BoardView, BoardFailure> find_circles(const Image& image, const Board& board) {
  for (const Polarity polarity : {Polarity::Dark, Polarity::Bright}) {
    DetectionOptions options;
    options.polarity = polarity;
    const auto grid = ordered_into_grid(detect_targets(image, options), board);
    if (grid.empty()) continue;
    BoardView view;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if ((grid[i].flags & (kOccluded | kBorder | kCoarse)) != 0) continue;
      view.points.push_back({static_cast<int>(i), grid[i].px(), grid[i].covariance});
    }
    if (view.points.size() * 10 < grid.size() * 8) return because(BoardFailure::PointsNotSharp);
    measure_sizes(view, grid, board);
    return view;
  }
  return because(BoardFailure::NotFound);
}

}  // namespace asterism
