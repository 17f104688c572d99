// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/calibration_start.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

struct Matches {
  std::vector<cv::Point3f> board;
  std::vector<cv::Point2f> image;
};

Matches matches_of(const BoardView& view, const Board& board) {
  const auto points = board_points(board);
  Matches matches;
  for (const BoardPoint& seen : view.points) {
    const Vec3& p = points[static_cast<std::size_t>(seen.point)];
    matches.board.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
    matches.image.emplace_back(static_cast<float>(seen.px.x()), static_cast<float>(seen.px.y()));
  }
  return matches;
}

double first_focal_length(const std::vector<BoardView>& views, const Board& board, int width, int height) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_image;
  for (const BoardView& view : views) {
    auto [points, pixels] = matches_of(view, board);
    on_board.push_back(std::move(points));
    in_image.push_back(std::move(pixels));
  }
  const double usual = 1.2 * std::max(width, height);
  const cv::Mat camera = cv::initCameraMatrix2D(on_board, in_image, {width, height}, 1.0);
  const double focal = camera.at<double>(0, 0);
  // Boards seen face-on leave it undetermined: then any usual lens is as good a start.
  return focal > 0.3 * usual && focal < 30 * usual ? focal : usual;
}

/// Left- and right-numbered poses agree on the motion between the cameras to within this.
bool agree(const RigidMotion& a, const RigidMotion& b, double distance_mm) {
  return rotation_angle(a.rotation, b.rotation) < rad_from_deg(6) &&
         (a.translation - b.translation).norm() < 0.1 * distance_mm;
}

/// board_from_board when the board is read in another way: point i lies where ways[k][i] says.
std::vector<RigidMotion> symmetry_motions(const Board& board) {
  const auto points = board_points(board);
  std::vector<RigidMotion> motions;
  for (const auto& way : board_symmetries(board)) {
    std::vector<Vec3> taken;
    for (const int other : way) taken.push_back(points[static_cast<std::size_t>(other)]);
    const auto fit = fit_rigid_motion(taken, points);
    motions.push_back(fit ? fit->a_from_b : RigidMotion{});
  }
  return motions;
}

}  // namespace

std::optional<RigidMotion> board_pose(const BoardView& view, const Board& board, const Lens& lens) {
  if (view.points.size() < 6) return std::nullopt;
  Matches matches = matches_of(view, board);
  for (std::size_t i = 0; i < matches.image.size(); ++i) {
    const auto ray = sight_line(lens, view.points[i].px);
    if (!ray) return std::nullopt;
    matches.image[i] = {static_cast<float>(ray->xy.x()), static_cast<float>(ray->xy.y())};
  }
  cv::Mat rotation, translation;
  if (!cv::solvePnP(matches.board, matches.image, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotation,
                    translation)) {
    return std::nullopt;
  }
  const auto vec = [](const cv::Mat& m) { return Vec3(m.at<double>(0), m.at<double>(1), m.at<double>(2)); };
  RigidMotion pose{exp_rotation(vec(rotation)), vec(translation)};
  if (!pose.translation.allFinite() || !pose.rotation.coeffs().allFinite()) return std::nullopt;
  for (const Vec3& point : board_points(board)) {
    if (!((pose * point).z() > 0)) return std::nullopt;
  }
  return pose;
}

std::optional<LensStart> start_lens(const std::vector<BoardView>& views, const Board& board, int width_px,
                                    int height_px, int coefficients) {
  Bundle bundle;
  bundle.board = board;
  Lens& lens = bundle.rig.left;
  lens.fx = lens.fy = first_focal_length(views, board, width_px, height_px);
  lens.cx = 0.5 * (width_px - 1);
  lens.cy = 0.5 * (height_px - 1);
  lens.width_px = width_px;
  lens.height_px = height_px;
  lens.coefficients = coefficients;
  for (const BoardView& view : views) {
    const auto pose = board_pose(view, board, lens);
    if (!pose) return std::nullopt;
    bundle.views.push_back({view, std::nullopt, *pose});
  }
  // A start needs no weights finer than the model's own error, and none that a bad image could hijack.
  bundle.model_sigma_px = 0.3;
  if (!adjust(bundle)) return std::nullopt;
  LensStart start{bundle.rig.left, {}, 0};
  for (const BundleView& view : bundle.views) start.poses.push_back(view.tracker_from_board);
  const auto residuals = residuals_of(bundle);
  for (const auto& residual : residuals) start.rms_px += residual.px.squaredNorm();
  start.rms_px = std::sqrt(start.rms_px / static_cast<double>(residuals.size()));
  return start;
}

PairStart start_pair(const std::vector<PairPoses>& pairs, std::vector<BoardView*> right, const Board& board) {
  require(pairs.size() == right.size(), "each pair of poses has its right view");
  const auto turns = symmetry_motions(board);
  const auto ways = board_symmetries(board);
  std::vector<std::vector<RigidMotion>> candidates;
  for (const PairPoses& pair : pairs) {
    candidates.emplace_back();
    for (const RigidMotion& turn : turns) {
      candidates.back().push_back(pair.right_from_board * turn.inverse() * pair.left_from_board.inverse());
    }
  }
  // The candidate with which most pairs agree in one way or another.
  PairStart best;
  std::size_t most = 0;
  std::vector<std::size_t> way_of(pairs.size(), 0);
  for (const auto& own : candidates) {
    for (const RigidMotion& candidate : own) {
      std::vector<bool> agrees(pairs.size(), false);
      std::vector<std::size_t> chosen(pairs.size(), 0);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double distance = pairs[i].left_from_board.translation.norm();
        for (std::size_t way = turns.size(); way-- > 0;) {
          if (!agree(candidates[i][way], candidate, distance)) continue;
          agrees[i] = true;
          chosen[i] = way;
        }
      }
      const auto count = static_cast<std::size_t>(std::count(agrees.begin(), agrees.end(), true));
      if (count <= most) continue;
      most = count;
      best = {candidate, agrees};
      way_of = chosen;
    }
  }
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (!best.agrees[i] || way_of[i] == 0) continue;
    for (BoardPoint& point : right[i]->points) {
      point.point = ways[way_of[i]][static_cast<std::size_t>(point.point)];
    }
  }
  return best;
}

}  // namespace asterism
