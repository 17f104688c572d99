// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/bundle.hpp"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <array>
#include <cmath>

#include "asterism/calibration/bundle_costs.hpp"
#include "asterism/camera/two_view.hpp"

namespace asterism {
namespace {

using Six = std::array<double, 6>;
constexpr Side kSides[] = {Side::Left, Side::Right};
constexpr int kSkew = 2;

Six six_of(const RigidMotion& motion) {
  const Vec3& t = motion.translation;
  return {0, 0, 0, t.x(), t.y(), t.z()};
}

/// The numbers being estimated and the Ceres problem over them.
struct Adjustment {
  ceres::Problem problem;
  std::array<std::vector<double>, 2> lens;
  Six rig{};
  double radius = 0, scale = 1;
  std::vector<Six> boards, ends;
  MotionReference rig_reference;
  std::vector<MotionReference> board_references;
  std::vector<double*> front;  // blocks of the rig, in order; then the board's scale, the radius
  std::vector<double*> back;   // blocks of six: placings, then scale bars
  int lens_columns[2] = {0, 0};
};

bool has_side(const Bundle& bundle, Side side) {
  for (const BundleView& view : bundle.views) {
    if (view.seen_by(side)) return true;
  }
  return false;
}

Vec6 bar_start(const ScaleBarView& bar, const StereoRig& rig) {
  Vec6 ends;
  for (int end = 0; end < 2; ++end) {
    const auto point =
        triangulate_pair(rig, bar.px[0][end], bar.covariance[0][end], bar.px[1][end], bar.covariance[1][end]);
    ends.segment<3>(3 * end) = point ? point->in_tracker : Vec3(end, 0, 1000);
  }
  return ends;
}

void add_marks(Adjustment& a, const Bundle& bundle, std::size_t index, Side side, double robust_sigmas) {
  const auto& seen = bundle.views[index].seen_by(side);
  if (!seen) return;
  const auto points = board_points(bundle.board);
  const Mat2 model = bundle.model_sigma_px * bundle.model_sigma_px * Mat2::Identity();
  for (const BoardPoint& point : seen->points) {
    const BoardMark mark{points[static_cast<std::size_t>(point.point)], a.radius};
    auto* cost = mark_cost({mark, side, point.px, point.covariance + model}, bundle.rig.lens(side),
                           a.rig_reference, a.board_references[index]);
    std::vector<double*> blocks = {a.lens[static_cast<std::size_t>(side)].data()};
    if (side == Side::Right) blocks.push_back(a.rig.data());
    blocks.push_back(a.boards[index].data());
    blocks.push_back(&a.scale);
    if (a.radius > 0) blocks.push_back(&a.radius);
    auto* loss = robust_sigmas > 0 ? new ceres::HuberLoss(robust_sigmas) : nullptr;
    a.problem.AddResidualBlock(cost, loss, blocks);
  }
}

void add_bar(Adjustment& a, const Bundle& bundle, std::size_t index) {
  const ScaleBarView& bar = bundle.bars[index];
  for (const Side side : kSides) {
    for (int end = 0; end < 2; ++end) {
      const int s = static_cast<int>(side);
      auto* cost = bar_end_cost(bar.px[s][end], bar.covariance[s][end], side, end, bundle.rig.lens(side),
                                a.rig_reference);
      std::vector<double*> blocks = {a.lens[static_cast<std::size_t>(side)].data()};
      if (side == Side::Right) blocks.push_back(a.rig.data());
      blocks.push_back(a.ends[index].data());
      a.problem.AddResidualBlock(cost, nullptr, blocks);
    }
  }
  a.problem.AddResidualBlock(length_cost(bar.length_mm, bar.sigma_mm), nullptr, a.ends[index].data());
}

void hold_and_list(Adjustment& a, const Bundle& bundle) {
  for (const Side side : kSides) {
    auto& lens = a.lens[static_cast<std::size_t>(side)];
    if (!a.problem.HasParameterBlock(lens.data())) continue;
    const int size = static_cast<int>(lens.size());
    if (!bundle.estimate_skew) a.problem.SetManifold(lens.data(), new ceres::SubsetManifold(size, {kSkew}));
    a.lens_columns[static_cast<int>(side)] = size - (bundle.estimate_skew ? 0 : 1);
    a.front.push_back(lens.data());
  }
  if (a.problem.HasParameterBlock(a.rig.data())) {
    const bool stereo = has_side(bundle, Side::Left) && has_side(bundle, Side::Right);
    if (stereo)
      a.front.push_back(a.rig.data());
    else
      a.problem.SetParameterBlockConstant(a.rig.data());
  }
  if (bundle.hold_rig) {
    for (double* block : a.front) a.problem.SetParameterBlockConstant(block);
    a.front.clear();
  }
  // A scale bar is better known than a printed board: then the bars tell the length.
  if (!bundle.bars.empty() && !bundle.hold_rig) {
    a.front.push_back(&a.scale);
  } else {
    a.problem.SetParameterBlockConstant(&a.scale);
  }
  if (a.radius > 0) {
    if (bundle.estimate_diameter && !bundle.hold_rig)
      a.front.push_back(&a.radius);
    else
      a.problem.SetParameterBlockConstant(&a.radius);
  }
}

void build(Adjustment& a, const Bundle& bundle, double robust_sigmas) {
  for (const Side side : kSides) {
    auto& lens = a.lens[static_cast<std::size_t>(side)];
    lens.resize(static_cast<std::size_t>(parameter_count(bundle.rig.lens(side))));
    write_parameters(bundle.rig.lens(side), lens.data());
  }
  a.rig_reference = {bundle.rig.right_from_left.rotation};
  a.rig = six_of(bundle.rig.right_from_left);
  a.radius = bundle.board.pattern == BoardPattern::Chessboard ? 0.0 : 0.5 * bundle.board.circle_diameter_mm;
  a.boards.reserve(bundle.views.size());
  for (const BundleView& view : bundle.views) {
    a.board_references.push_back({view.tracker_from_board.rotation});
    a.boards.push_back(six_of(view.tracker_from_board));
  }
  for (const ScaleBarView& bar : bundle.bars) {
    a.ends.emplace_back();
    Eigen::Map<Vec6>(a.ends.back().data()) = bar_start(bar, bundle.rig);
  }
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    for (const Side side : kSides) add_marks(a, bundle, i, side, robust_sigmas);
    a.back.push_back(a.boards[i].data());
  }
  for (std::size_t i = 0; i < bundle.bars.size(); ++i) {
    add_bar(a, bundle, i);
    a.back.push_back(a.ends[i].data());
  }
  hold_and_list(a, bundle);
}

bool sound(const Lens& lens) {
  const double most = 1e3 * std::max(lens.width_px, lens.height_px);
  return lens.fx > 1 && lens.fy > 1 && lens.fx < most && lens.fy < most && std::isfinite(lens.cx + lens.cy);
}

/// The rig's normal matrix with the placings and bars eliminated; columns as in `front`.
MatX reduced_normal(Adjustment& a) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = a.front;
  options.parameter_blocks.insert(options.parameter_blocks.end(), a.back.begin(), a.back.end());
  options.apply_loss_function = false;
  ceres::CRSMatrix jacobian;
  a.problem.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);
  const int front = jacobian.num_cols - 6 * static_cast<int>(a.back.size());
  MatX normal = MatX::Zero(front, front);
  std::vector<Mat6> corner(a.back.size(), Mat6::Zero());
  std::vector<MatX> across(a.back.size(), MatX::Zero(front, 6));
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int i = jacobian.rows[static_cast<std::size_t>(row)];
         i < jacobian.rows[static_cast<std::size_t>(row) + 1]; ++i) {
      for (int k = jacobian.rows[static_cast<std::size_t>(row)];
           k < jacobian.rows[static_cast<std::size_t>(row) + 1]; ++k) {
        const int ci = jacobian.cols[static_cast<std::size_t>(i)],
                  ck = jacobian.cols[static_cast<std::size_t>(k)];
        const double product =
            jacobian.values[static_cast<std::size_t>(i)] * jacobian.values[static_cast<std::size_t>(k)];
        const auto block = static_cast<std::size_t>(std::max(0, ck - front) / 6);
        if (ci < front && ck < front)
          normal(ci, ck) += product;
        else if (ci < front)
          across[block](ci, (ck - front) % 6) += product;
        else if (ck >= front)
          corner[block]((ci - front) % 6, (ck - front) % 6) += product;
      }
    }
  }
  for (std::size_t block = 0; block < corner.size(); ++block) {
    if (const auto inverse = inverse_positive(corner[block])) {
      normal -= across[block] * *inverse * across[block].transpose();
    }
  }
  return normal;
}

}  // namespace

bool adjust(Bundle& bundle, const BundleSettings& settings) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // a refused step is Ceres' daily business, not the user's
  Adjustment a;
  build(a, bundle, settings.robust_sigmas);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = settings.iterations;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  options.max_trust_region_radius =
      1e10;  // keeps a little damping where coefficients trade against each other
  options.gradient_tolerance = 1e-12;
  options.num_threads = 1;  // sums in one order: the same bits
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &a.problem, &summary);
  if (!summary.IsSolutionUsable()) return false;

  bundle.rig.left = lens_with(bundle.rig.left, a.lens[0].data());
  bundle.rig.right = lens_with(bundle.rig.right, a.lens[1].data());
  bundle.rig.right_from_left = a.rig_reference.motion(a.rig.data());
  bundle.board.pitch_mm *= a.scale;
  if (a.radius > 0) bundle.board.circle_diameter_mm = 2 * a.radius;
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    bundle.views[i].tracker_from_board = a.board_references[i].motion(a.boards[i].data());
  }
  return (!has_side(bundle, Side::Left) || sound(bundle.rig.left)) &&
         (!has_side(bundle, Side::Right) || sound(bundle.rig.right));
}

std::vector<BundleResidual> residuals_of(const Bundle& bundle) {
  const auto points = board_points(bundle.board);
  const double radius =
      bundle.board.pattern == BoardPattern::Chessboard ? 0.0 : 0.5 * bundle.board.circle_diameter_mm;
  std::vector<BundleResidual> residuals;
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    for (const Side side : kSides) {
      const auto& seen = bundle.views[i].seen_by(side);
      if (!seen) continue;
      for (std::size_t k = 0; k < seen->points.size(); ++k) {
        const BoardPoint& point = seen->points[k];
        const auto image = image_of_mark({points[static_cast<std::size_t>(point.point)], radius}, side,
                                         bundle.rig, bundle.views[i].tracker_from_board);
        const Vec2 off = image ? Vec2(point.px - image->px) : Vec2(1e3, 1e3);  // behind the camera
        residuals.push_back({static_cast<int>(i), side, static_cast<int>(k), off, point.covariance});
      }
    }
  }
  return residuals;
}

std::optional<MatX> rig_covariance(const Bundle& bundle) {
  require(!bundle.hold_rig, "a rig that is held has no covariance");
  Adjustment a;
  build(a, bundle, 0);
  const MatX normal = reduced_normal(a);
  const VecX scale = normal.diagonal().cwiseMax(0).cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const auto inverse = inverse_positive(MatX(scale.asDiagonal() * normal * scale.asDiagonal()));
  if (!inverse) return std::nullopt;
  const MatX estimated = scale.asDiagonal() * *inverse * scale.asDiagonal();

  // Held skews get zero rows; the board's scale and a circle's radius are left out.
  std::vector<int> place;
  int next = 0;
  for (const Side side : kSides) {
    const int size = parameter_count(bundle.rig.lens(side));
    for (int i = 0; i < size; ++i, ++next) {
      if (i != kSkew || bundle.estimate_skew) place.push_back(next);
    }
  }
  for (int i = 0; i < 6; ++i, ++next) place.push_back(next);
  require(static_cast<Eigen::Index>(place.size()) <= estimated.rows(),
          "both cameras take part in a rig's covariance");
  MatX covariance = MatX::Zero(next, next);
  for (std::size_t i = 0; i < place.size(); ++i) {
    for (std::size_t k = 0; k < place.size(); ++k) {
      covariance(place[i], place[k]) = estimated(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  return covariance;
}

int parameter_count(const Bundle& bundle) {
  const int held = bundle.estimate_skew ? 0 : 1;
  int count = 6 * static_cast<int>(bundle.views.size() + bundle.bars.size());
  if (bundle.hold_rig) return count;
  int cameras = 0;
  for (const Side side : kSides) {
    if (!has_side(bundle, side)) continue;
    count += parameter_count(bundle.rig.lens(side)) - held;
    ++cameras;
  }
  if (cameras == 2) count += 6;
  return count + (bundle.estimate_diameter ? 1 : 0) + (bundle.bars.empty() ? 0 : 1);
}

}  // namespace asterism
