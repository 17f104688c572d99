// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr double kSmallTurn_rad = rad_from_deg(5.0);
// Covariances this many times too small (in sigmas) are worth a word.
constexpr double kPoorSigmas = 2.0;

double distance_sigma(const BodyModel& model, const MatX& covariance) {
  double sum = 0;
  int pairs = 0;
  const auto block = [&](std::size_t i, std::size_t j) {
    return Mat3(covariance.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)));
  };
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++pairs) {
      const Vec3 along = (model.positions[i] - model.positions[j]).normalized();
      sum += along.dot((block(i, i) + block(j, j) - block(i, j) - block(j, i)) * along);
    }
  }
  return std::sqrt(sum / pairs);
}

LearntTarget quality_of(const StereoRig& rig, const AdjustedBody& adjusted, std::size_t target) {
  LearntTarget quality;
  double squares = 0;
  std::size_t last_frame = adjusted.model.tracker_from_body.size();
  for (const BodyView& view : adjusted.views) {
    if (view.target != target || view.rejected) continue;
    ++quality.views;
    // Views come by frame, left before right.
    if (view.frame != last_frame) ++quality.frames;
    last_frame = view.frame;
    const auto expected = expect_view(rig, adjusted.model, view.frame, target, view.side);
    if (expected) squares += (view.centre.px() - expected->px).squaredNorm();
  }
  if (quality.views > 0) quality.rms_px = std::sqrt(squares / (2.0 * quality.views));
  const auto at = static_cast<Eigen::Index>(3 * target);
  quality.sigma_mm = adjusted.summary.covariance.block<3, 3>(at, at).diagonal().cwiseSqrt();
  if (adjusted.shapes[target]) quality.normal_sigma_rad = adjusted.shapes[target]->normal_sigma_rad;
  return quality;
}

void measure_motion(const BodyModel& model, LearntBody& learnt) {
  for (const RigidMotion& a : model.tracker_from_body) {
    for (const RigidMotion& b : model.tracker_from_body) {
      learnt.rotation_rad = std::max(learnt.rotation_rad, rotation_angle(a.rotation, b.rotation));
      learnt.translation_mm = std::max(learnt.translation_mm, (a.translation - b.translation).norm());
    }
  }
}

std::string_view words_of(ShapeFailure failure) {
  switch (failure) {
    case ShapeFailure::TooFewEllipses:
      return "too few whole ellipses were seen";
    case ShapeFailure::NoDisc:
      return "its images are not those of a flat disc";
    case ShapeFailure::Undetermined:
      return "its images tell its direction to more than 10° only";
  }
  return "";
}

void add_warnings(const AdjustedBody& adjusted, LearntBody& learnt) {
  if (learnt.rotation_rad < kSmallTurn_rad) {
    learnt.warnings.push_back(
        fmt::format("the body turned by {:.1f}° only: its normals, and its shape along the lines of "
                    "sight, are poorly checked; turn it by 10° and more",
                    deg_from_rad(learnt.rotation_rad)));
  }
  for (std::size_t t = 0; t < learnt.targets.size(); ++t) {
    const std::string& id = learnt.body.targets[t].id;
    if (learnt.targets[t].frames < 3) {
      learnt.warnings.push_back(fmt::format("{} was seen in {} frames only", id, learnt.targets[t].frames));
    }
    if (!adjusted.shapes[t]) {
      learnt.warnings.push_back(
          fmt::format("{} has no normal: {}", id, words_of(adjusted.shapes[t].error())));
    }
  }
  const double factor = std::sqrt(learnt.variance_factor);
  if (factor > kPoorSigmas) {
    learnt.warnings.push_back(
        fmt::format("the centres scatter {:.1f} times more than stated: is the rig still good, is "
                    "the body rigid, are the images sharp?",
                    factor));
  }
}

/// Told in the body's frame and order.
AdjustedBody in_frame(AdjustedBody adjusted, const BodyFrame& frame) {
  std::vector<std::size_t> place(frame.order.size());
  std::vector<Result<DiscShape, ShapeFailure>> shapes;
  for (std::size_t t = 0; t < frame.order.size(); ++t) {
    place[frame.order[t]] = t;
    shapes.push_back(adjusted.shapes[frame.order[t]]);
  }
  adjusted.shapes = std::move(shapes);
  adjusted.model = in_frame(adjusted.model, frame);
  adjusted.summary.covariance = in_frame(adjusted.summary.covariance, frame);
  for (BodyView& view : adjusted.views) view.target = place[view.target];
  return adjusted;
}

int frames_used(const AdjustedBody& adjusted) {
  std::vector<bool> used(adjusted.model.tracker_from_body.size(), false);
  for (const BodyView& view : adjusted.views) used[view.frame] = used[view.frame] || !view.rejected;
  return static_cast<int>(std::count(used.begin(), used.end(), true));
}

}  // namespace

LearntBody report_body(const StereoRig& rig, AdjustedBody in_set, const BodyFrame& frame,
                       const std::string& name, std::size_t frames_given) {
  const AdjustedBody adjusted = in_frame(std::move(in_set), frame);
  LearntBody learnt;
  learnt.body.name = name;
  for (std::size_t t = 0; t < frame.order.size(); ++t) {
    Target target{frame.ids[t], adjusted.model.positions[t], adjusted.model.normals[t], std::nullopt,
                  std::nullopt};
    if (target.normal) target.diameter_mm = 2 * adjusted.model.radii_mm[t];
    const auto at = static_cast<Eigen::Index>(3 * t);
    target.covariance = Mat3(adjusted.summary.covariance.block<3, 3>(at, at));
    learnt.body.targets.push_back(std::move(target));
    learnt.targets.push_back(quality_of(rig, adjusted, t));
  }
  learnt.covariance = adjusted.summary.covariance;
  learnt.distance_sigma_mm = distance_sigma(adjusted.model, learnt.covariance);
  learnt.frames_given = static_cast<int>(frames_given);
  learnt.frames_used = frames_used(adjusted);
  learnt.views_rejected = adjusted.summary.rejected;
  learnt.rms_px = adjusted.summary.rms_px;
  learnt.variance_factor = adjusted.summary.variance_factor;
  measure_motion(adjusted.model, learnt);
  add_warnings(adjusted, learnt);
  return learnt;
}

}  // namespace asterism
