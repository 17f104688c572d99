// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asterism {
namespace {

// Perfect centres (simulated without noise) have no covariance to weigh by; this stands in for it.
constexpr double kLeastSigma_px = 1e-4;

Mat2 covariance_of(const Centre& centre) {
  return centre.covariance + kLeastSigma_px * kLeastSigma_px * Mat2::Identity();
}

/// A centre's sight line as the angle of the plane that holds it and the baseline; sight lines that meet
/// have the same.
struct PlaneAngle {
  int centre;
  double angle_rad;
  double variance;  // rad², by the centre's covariance
  double slope;     // |∂angle / ∂px|, rad / px
};

/// Axes for the plane angle, in the tracker's frame: along the baseline, and across it towards the scene.
struct BaselineFrame {
  Vec3 forward, down;
};

BaselineFrame baseline_frame(const StereoRig& rig) {
  const RigidMotion tracker_from_right = rig.right_from_left.inverse();
  const Vec3 along = tracker_from_right.translation.normalized();
  const Vec3 view = Vec3::UnitZ() + tracker_from_right.rotation * Vec3::UnitZ();
  const Vec3 down = view.cross(along).normalized();
  return {along.cross(down), down};
}

/// The brightest `most` of them, in their own order.
std::vector<int> chosen(std::span<const Centre> centres, int most) {
  std::vector<int> order(centres.size());
  std::iota(order.begin(), order.end(), 0);
  if (centres.size() <= static_cast<std::size_t>(most)) return order;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(centres[static_cast<std::size_t>(a)].amplitude) >
           std::abs(centres[static_cast<std::size_t>(b)].amplitude);
  });
  order.resize(static_cast<std::size_t>(most));
  std::sort(order.begin(), order.end());
  return order;
}

std::vector<PlaneAngle> plane_angles(std::span<const Centre> centres, const StereoRig& rig, Side side,
                                     const BaselineFrame& frame, int most) {
  const Mat3 tracker_from_camera = rig.camera_from_tracker(side).rotation.conjugate().toRotationMatrix();
  const Vec3 forward = tracker_from_camera.transpose() * frame.forward;
  const Vec3 down = tracker_from_camera.transpose() * frame.down;
  std::vector<PlaneAngle> angles;
  angles.reserve(centres.size());
  for (const int i : chosen(centres, most)) {
    const Centre& centre = centres[static_cast<std::size_t>(i)];
    const auto line = sight_line(rig.lens(side), centre.px());
    if (!line) continue;
    const Vec3 ray = line->xy.homogeneous();
    const double f = forward.dot(ray), d = down.dot(ray);
    const Vec2 by_xy = (f * down.head<2>() - d * forward.head<2>()) / (f * f + d * d);
    const Vec2 by_px = line->by_px.transpose() * by_xy;
    angles.push_back({i, std::atan2(d, f), by_px.dot(covariance_of(centre) * by_px), by_px.norm()});
  }
  return angles;
}

struct Pair {
  const PlaneAngle* left;
  const PlaneAngle* right;
  double misfit;  // in sigmas
};

std::vector<Pair> pairs_that_meet(const std::vector<PlaneAngle>& left, std::vector<PlaneAngle>& right,
                                  const TriangulationOptions& options) {
  std::sort(right.begin(), right.end(), [](const PlaneAngle& a, const PlaneAngle& b) {
    return a.angle_rad != b.angle_rad ? a.angle_rad < b.angle_rad : a.centre < b.centre;
  });
  const double rig_variance = options.rig_error_px * options.rig_error_px;
  double largest = 0;
  for (const PlaneAngle& r : right)
    largest = std::max(largest, r.variance + rig_variance * r.slope * r.slope);

  std::vector<Pair> pairs;
  for (const PlaneAngle& l : left) {
    const double own = l.variance + rig_variance * l.slope * l.slope;
    const double reach = options.gate_sigmas * std::sqrt(own + largest);
    auto r = std::lower_bound(right.begin(), right.end(), l.angle_rad - reach,
                              [](const PlaneAngle& a, double angle) { return a.angle_rad < angle; });
    for (; r != right.end() && r->angle_rad <= l.angle_rad + reach; ++r) {
      const double sigma = std::sqrt(own + r->variance + rig_variance * r->slope * r->slope);
      const double misfit = std::abs(r->angle_rad - l.angle_rad) / sigma;
      if (misfit <= options.gate_sigmas) pairs.push_back({&l, &*r, misfit});
    }
  }
  if (pairs.size() > static_cast<std::size_t>(options.max_points)) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.misfit < b.misfit; });
    pairs.resize(static_cast<std::size_t>(options.max_points));
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.left->centre != b.left->centre ? a.left->centre < b.left->centre
                                            : a.right->centre < b.right->centre;
  });
  return pairs;
}

/// Both images must tell about the same disc: its diameter is (major axis) · depth / f.
bool sizes_agree(const Centre& left, const Centre& right, const Vec3& in_tracker, const StereoRig& rig,
                 double max_ratio) {
  if (max_ratio <= 0) return true;
  const double left_size = left.ellipse.semi_major * in_tracker.z() / rig.left.fx;
  const double right_size = right.ellipse.semi_major * (rig.right_from_left * in_tracker).z() / rig.right.fx;
  return left_size <= max_ratio * right_size && right_size <= max_ratio * left_size;
}

}  // namespace

void describe(TriangulationOptions& options, OptionVisitor& visit) {
  visit.number("gate_sigmas", options.gate_sigmas, {0.1, 100}, "how far from meeting two sight lines may be");
  visit.number("rig_error_px", options.rig_error_px, {0, 100},
               "epipolar error of the calibration, one sigma");
  visit.number("min_depth_mm", options.min_depth_mm, {0, 1e9},
               "nearest point kept, along the left camera's axis");
  visit.number("max_depth_mm", options.max_depth_mm, {0, 1e9}, "furthest point kept");
  visit.number("max_size_ratio", options.max_size_ratio, {0, 100},
               "of the disc's sizes in both images; 0 = any");
  visit.integer("max_centres", options.max_centres, {1, 1000000},
                "in one image; beyond, the brightest are taken");
  visit.integer("max_points", options.max_points, {1, 10000000},
                "in one frame; beyond, those that meet best");
}

std::vector<Point> triangulate(std::span<const Centre> left, std::span<const Centre> right,
                               const StereoRig& rig, const TriangulationOptions& options) {
  const BaselineFrame frame = baseline_frame(rig);
  const auto left_angles = plane_angles(left, rig, Side::Left, frame, options.max_centres);
  auto right_angles = plane_angles(right, rig, Side::Right, frame, options.max_centres);

  std::vector<Point> points;
  for (const Pair& pair : pairs_that_meet(left_angles, right_angles, options)) {
    const Centre& l = left[static_cast<std::size_t>(pair.left->centre)];
    const Centre& r = right[static_cast<std::size_t>(pair.right->centre)];
    const auto at = triangulate_pair(rig, l.px(), covariance_of(l), r.px(), covariance_of(r));
    if (!at || at->in_tracker.z() < options.min_depth_mm || at->in_tracker.z() > options.max_depth_mm)
      continue;
    if (!sizes_agree(l, r, at->in_tracker, rig, options.max_size_ratio)) continue;
    const double excess = at->epipolar_error_px / at->epipolar_sigma_px;
    const double widen = std::abs(excess) > 3.0 ? excess * excess : 1.0;
    points.push_back({at->in_tracker, widen * at->covariance, at->epipolar_error_px, pair.left->centre,
                      pair.right->centre});
  }
  return points;
}

}  // namespace asterism
