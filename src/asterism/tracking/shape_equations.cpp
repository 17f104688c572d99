// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/shape_equations.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "asterism/statistics/summary.hpp"
#include "asterism/tracking/pose_model.hpp"
#include "asterism/tracking/refused_targets.hpp"

namespace asterism {
namespace {

constexpr double kAstray_mm = 3;
constexpr double kOften = 0.1;

/// A point beside the place of a target that has no label.
struct Beside {
  std::size_t shape;  // index into the seen shapes
  std::size_t point, frame;
  Vec3 shift_mm;
};

/// Where the body is; empty when the frame does not tell.
std::optional<RigidMotion> place_of(const TrackedFrame& frame, std::size_t body, const BodyLabels* labels) {
  const BodyPose& pose = frame.poses[body];
  const bool measured = pose.status == PoseStatus::Ok || pose.status == PoseStatus::Partial;
  if (measured && pose.estimate) return pose.estimate->tracker_from_body;
  if (labels != nullptr && labels->status == LabelStatus::Ok) return labels->tracker_from_body;
  return std::nullopt;
}

void add_views(const TrackedFrame& frame, std::size_t point, int target, const ViewOptions& options,
               std::vector<TargetView>& views) {
  const Point& at = frame.points[point];
  const Centre& left = frame.centres.left[static_cast<std::size_t>(at.left)];
  const Centre& right = frame.centres.right[static_cast<std::size_t>(at.right)];
  if (((left.flags | right.flags) & kBorder) != 0) return;
  views.push_back(view_of(left, target, Side::Left, options));
  views.push_back(view_of(right, target, Side::Right, options));
}

Vec3 median_of(const std::vector<Beside>& points) {
  Vec3 middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Beside& point : points) values.push_back(point.shift_mm(axis));
    middle(axis) = quantile_of(values, 0.5);
  }
  return middle;
}

/// Σ over one frame's views of the shape's equations, its pose eliminated.
bool add_frame(const SeenShape& seen, const Body& body, const StereoRig& rig, const PoseOptions& options,
               ShapeEquations& sum) {
  const PoseProblem problem(body, seen.views, rig, options);
  const auto fit = minimise(problem, seen.tracker_from_body, options.max_iterations);
  if (!fit) return false;
  const Mat3 rotation = fit->pose.rotation.toRotationMatrix();
  const auto size = sum.gradient.size();
  MatX own = MatX::Zero(size, size);
  MatX cross = MatX::Zero(size, 6);
  VecX pull = VecX::Zero(size);
  Mat6 of_pose = Mat6::Zero();
  Vec6 pose_pull = Vec6::Zero();
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const auto at = problem.linearised(fit->pose, i);
    if (!at) return false;
    const auto target = 3 * (&problem.target(i) - body.targets.data());
    const Mat23 by_target = at->by_point * rotation;
    const Mat23 weighted = problem.weight(i) * by_target;
    const Mat26 weighted_pose = problem.weight(i) * at->by_pose;
    own.block<3, 3>(target, target) += by_target.transpose() * weighted;
    cross.block<3, 6>(target, 0) += by_target.transpose() * weighted_pose;
    pull.segment<3>(target) += weighted.transpose() * at->residual;
    of_pose += at->by_pose.transpose() * weighted_pose;
    pose_pull += weighted_pose.transpose() * at->residual;
  }
  const auto inverse = inverse_positive(of_pose);
  if (!inverse) return false;
  sum.normal += own - cross * *inverse * cross.transpose();
  sum.gradient += pull - cross * *inverse * pose_pull;
  return true;
}

/// nᵀ N⁺ n. Moving the whole body is no change of shape: N is blind to it, and n stands square on it.
double chi_square_of_shape(const ShapeEquations& equations, const Body& body) {
  MatX whole = MatX::Zero(equations.gradient.size(), 6);
  MatX normal = equations.normal;
  Vec3 middle = Vec3::Zero();
  for (const Target& target : body.targets)
    middle += target.position / static_cast<double>(body.targets.size());
  for (std::size_t t = 0; t < body.targets.size(); ++t) {
    const auto at = static_cast<Eigen::Index>(3 * t);
    if (equations.frames_seen[t] == 0) {
      normal.block<3, 3>(at, at) = Mat3::Identity();
      continue;
    }
    whole.block<3, 3>(at, 0) = -skew(body.targets[t].position - middle) / 100.0;
    whole.block<3, 3>(at, 3) = Mat3::Identity();
  }
  const double scale = equations.normal.trace() / static_cast<double>(equations.gradient.size());
  const auto solved = solve_positive(MatX(normal + scale * whole * whole.transpose()), equations.gradient);
  return solved ? equations.gradient.dot(*solved) : 0.0;
}

}  // namespace

std::vector<SeenShape> seen_shapes(std::size_t body_index, std::span<const TrackedFrame> frames,
                                   const Body& body, const ViewOptions& options) {
  std::vector<SeenShape> shapes;
  std::map<int, std::vector<Beside>> beside;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const TrackedFrame& frame = frames[f];
    const BodyLabels* labels = nullptr;
    CentreUse use(frame.centres);
    std::vector<char> labelled(body.targets.size(), 0);
    for (const BodyLabels& of_body : frame.labels) {
      if (of_body.body == static_cast<int>(body_index)) labels = &of_body;
      for (const LabelledPoint& label : of_body.points) {
        const Point& point = frame.points[static_cast<std::size_t>(label.point)];
        use.left[static_cast<std::size_t>(point.left)] = 1;
        use.right[static_cast<std::size_t>(point.right)] = 1;
      }
    }
    const auto place = place_of(frame, body_index, labels);
    if (!place) continue;
    SeenShape shape{*place, {}};
    if (labels != nullptr && labels->status == LabelStatus::Ok) {
      for (const LabelledPoint& label : labels->points) {
        labelled[static_cast<std::size_t>(label.target)] = 1;
        add_views(frame, static_cast<std::size_t>(label.point), label.target, options, shape.views);
      }
    }
    for (std::size_t t = 0; t < body.targets.size(); ++t) {
      if (labelled[t] != 0) continue;
      const Vec3 expected = *place * body.targets[t].position;
      const auto point = displaced_point(expected, frame.points, use, options);
      if (!point) continue;
      const Vec3 shift = place->rotation.conjugate() * (frame.points[*point].in_tracker - expected);
      beside[static_cast<int>(t)].push_back({shapes.size(), *point, f, shift});
    }
    shapes.push_back(std::move(shape));
  }
  for (const auto& [target, points] : beside) {
    const Vec3 usual = median_of(points);
    std::vector<Beside> kept;
    std::copy_if(points.begin(), points.end(), std::back_inserter(kept),
                 [&](const Beside& point) { return (point.shift_mm - usual).norm() < kAstray_mm; });
    if (static_cast<double>(kept.size()) < kOften * static_cast<double>(shapes.size())) continue;
    for (const Beside& point : kept)
      add_views(frames[point.frame], point.point, target, options, shapes[point.shape].views);
  }
  std::erase_if(shapes, [](const SeenShape& shape) { return shape.views.size() < 8; });
  return shapes;
}

ShapeEquations shape_equations(std::span<const SeenShape> seen, const Body& body, const StereoRig& rig,
                               const VecX& about) {
  const auto size = static_cast<Eigen::Index>(3 * body.targets.size());
  Body shifted = body;
  for (std::size_t t = 0; t < body.targets.size(); ++t) {
    shifted.targets[t].position += about.segment<3>(static_cast<Eigen::Index>(3 * t));
    shifted.targets[t].covariance.reset();
  }
  ShapeEquations equations{MatX::Zero(size, size), VecX::Zero(size), 0, {}, 0};
  equations.frames_seen.assign(body.targets.size(), 0);
  const PoseOptions options;
  for (const SeenShape& shape : seen) {
    if (!add_frame(shape, shifted, rig, options, equations)) continue;
    ++equations.frames;
    for (const TargetView& view : shape.views) {
      if (view.side == Side::Left) ++equations.frames_seen[static_cast<std::size_t>(view.target)];
    }
  }
  equations.gradient += equations.normal * about;
  equations.shape_chi_square = chi_square_of_shape(equations, body);
  return equations;
}

}  // namespace asterism
