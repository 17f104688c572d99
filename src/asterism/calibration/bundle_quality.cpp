// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/bundle_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

double chi_square(const std::vector<BundleResidual>& residuals, double model_sigma) {
  double sum = 0;
  for (const BundleResidual& residual : residuals) {
    const Mat2 covariance = residual.covariance + model_sigma * model_sigma * Mat2::Identity();
    sum += residual.px.dot(covariance.inverse() * residual.px);
  }
  return sum;
}

/// Numbers measured minus numbers estimated; the bars' four image points and length beside their six.
double degrees_of_freedom(const Bundle& bundle, std::size_t points) {
  return std::max(1.0, 2.0 * static_cast<double>(points) + 9.0 * static_cast<double>(bundle.bars.size()) -
                           parameter_count(bundle));
}

bool is_pair(const BundleView& view) { return view.left && view.right; }

}  // namespace

double variance_factor(const Bundle& bundle) {
  const auto residuals = residuals_of(bundle);
  return chi_square(residuals, bundle.model_sigma_px) / degrees_of_freedom(bundle, residuals.size());
}

bool adjust_with_model_sigma(Bundle& bundle) {
  for (int round = 0; round < 4; ++round) {
    if (!adjust(bundle)) return false;
    const auto residuals = residuals_of(bundle);
    const double freedom = degrees_of_freedom(bundle, residuals.size());
    double low = 0, high = 10;
    if (chi_square(residuals, 0) <= freedom) high = 0;
    for (int step = 0; step < 60 && high > 0; ++step) {
      const double middle = 0.5 * (low + high);
      (chi_square(residuals, middle) > freedom ? low : high) = middle;
    }
    const double before = bundle.model_sigma_px;
    bundle.model_sigma_px = high;
    if (std::abs(high - before) <= 0.005 * std::max(high, 1e-4)) break;
  }
  return adjust(bundle);
}

double stereo_rms(const Bundle& bundle) {
  double sum = 0;
  int count = 0;
  for (const BundleResidual& residual : residuals_of(bundle)) {
    if (!is_pair(bundle.views[static_cast<std::size_t>(residual.view)])) continue;
    sum += residual.px.squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

std::vector<ImageRms> image_rms(const Bundle& bundle) {
  std::vector<ImageRms> result(bundle.views.size());
  const auto slot = [&](const BundleResidual& residual) -> double& {
    ImageRms& rms = result[static_cast<std::size_t>(residual.view)];
    return residual.side == Side::Left ? rms.left_px : rms.right_px;
  };
  for (const BundleResidual& residual : residuals_of(bundle)) slot(residual) += residual.px.squaredNorm();
  for (std::size_t i = 0; i < result.size(); ++i) {
    const BundleView& view = bundle.views[i];
    if (view.left)
      result[i].left_px = std::sqrt(result[i].left_px / static_cast<double>(view.left->points.size()));
    if (view.right)
      result[i].right_px = std::sqrt(result[i].right_px / static_cast<double>(view.right->points.size()));
  }
  return result;
}

int drop_outliers(Bundle& bundle, double sigmas) {
  int dropped = 0;
  const auto residuals = residuals_of(bundle);
  for (const auto& residual : std::views::reverse(residuals)) {
    const Mat2 covariance =
        residual.covariance + bundle.model_sigma_px * bundle.model_sigma_px * Mat2::Identity();
    if (residual.px.dot(covariance.inverse() * residual.px) <= sigmas * sigmas) continue;
    BundleView& view = bundle.views[static_cast<std::size_t>(residual.view)];
    auto& points = (residual.side == Side::Left ? view.left : view.right)->points;
    points.erase(points.begin() + residual.point);
    ++dropped;
  }
  return dropped;
}

double held_out_rms(const Bundle& bundle, int folds) {
  std::vector<std::size_t> pairs;
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    if (is_pair(bundle.views[i])) pairs.push_back(i);
  }
  const auto groups = std::min(static_cast<std::size_t>(folds), pairs.size());
  std::vector<double> sums(groups, 0);
  std::vector<int> counts(groups, 0);
  parallel_for(groups, [&](std::size_t group) {
    Bundle others = bundle, held = bundle;
    others.views.clear();
    held.views.clear();
    held.bars.clear();
    std::size_t pair = 0;
    for (const BundleView& view : bundle.views) {
      const bool out = is_pair(view) && pair++ % groups == group;
      (out ? held : others).views.push_back(view);
    }
    if (!adjust(others)) return;
    held.rig = others.rig;
    held.board = others.board;
    held.hold_rig = true;
    if (!adjust(held)) return;
    for (const BundleResidual& residual : residuals_of(held)) {
      sums[group] += residual.px.squaredNorm();
      ++counts[group];
    }
  });
  double sum = 0;
  int count = 0;
  for (std::size_t group = 0; group < groups; ++group) {
    if (counts[group] == 0) return std::numeric_limits<double>::infinity();  // a fold that did not converge
    sum += sums[group];
    count += counts[group];
  }
  return count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::infinity();
}

double largest_tilt_rad(const Bundle& bundle) {
  double largest = 0;
  for (const BundleView& a : bundle.views) {
    for (const BundleView& b : bundle.views) {
      const Vec3 na = a.tracker_from_board.rotation * Vec3::UnitZ();
      const Vec3 nb = b.tracker_from_board.rotation * Vec3::UnitZ();
      largest = std::max(largest, std::atan2(na.cross(nb).norm(), na.dot(nb)));
    }
  }
  return largest;
}

BoardForm board_form(const Bundle& bundle) {
  const auto points = board_points(bundle.board);
  std::vector<Vec2> sum(points.size(), Vec2::Zero());
  std::vector<double> squares(points.size(), 0);
  std::vector<int> count(points.size(), 0);
  for (const BundleResidual& residual : residuals_of(bundle)) {
    const BundleView& view = bundle.views[static_cast<std::size_t>(residual.view)];
    const auto index = static_cast<std::size_t>(
        view.seen_by(residual.side)->points[static_cast<std::size_t>(residual.point)].point);
    const RigidMotion camera_from_board =
        bundle.rig.camera_from_tracker(residual.side) * view.tracker_from_board;
    const auto image = project(bundle.rig.lens(residual.side), camera_from_board * points[index]);
    if (!image) continue;
    const Mat2 by_board = (image->by_point * camera_from_board.rotation.toRotationMatrix()).leftCols<2>();
    const Vec2 off = by_board.inverse() * residual.px;
    sum[index] += off;
    squares[index] += off.squaredNorm();
    ++count[index];
  }
  BoardForm form;
  int used = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (count[i] < 2) continue;
    const Vec2 mean = sum[i] / count[i];
    form.off_grid_mm += mean.squaredNorm();
    form.noise_mm += (squares[i] / count[i] - mean.squaredNorm()) / (count[i] - 1);
    ++used;
  }
  if (used == 0) return {};
  return {std::sqrt(form.off_grid_mm / used), std::sqrt(form.noise_mm / used)};
}

}  // namespace asterism
