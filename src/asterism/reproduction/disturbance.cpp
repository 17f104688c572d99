// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/disturbance.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/camera/two_view.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/geometry/rigid_fit.hpp"
#include "asterism/reproduction/papers_cell.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kDisturbing = 0x64697374;  // the purpose of its random streams

std::uint64_t stream_of(std::uint64_t experiment, std::size_t runs, std::size_t run) {
  return experiment * runs + run;
}

/// Adds the error of the fit of `seen` to where `targets` truly are.
void add_error(PoseErrorSample& sample, std::span<const Vec3> seen, std::span<const Vec3> truth) {
  const auto fit = fit_rigid_motion(seen, truth);
  if (!fit) throw MeasurementError("the targets lie on one line");
  const Vec3 centre = centroid_of(truth);
  sample.rotation_deg.push_back(deg_from_rad(rotation_angle(fit->a_from_b.rotation, Quaternion::Identity())));
  sample.translation_mm.push_back((fit->a_from_b * centre - centre).norm());
}

struct Images {
  Vec2 left, right;
};

std::vector<Images> images_of(const StereoRig& rig, std::span<const Vec3> in_rig) {
  std::vector<Images> images;
  for (const Vec3& target : in_rig) {
    const auto left = project(rig.left, target), right = project(rig.right, rig.right_from_left * target);
    const auto inside = [&](const Vec2& px) {
      return px.minCoeff() >= 0 && px.x() < rig.left.width_px && px.y() < rig.left.height_px;
    };
    if (!left || !right || !inside(left->px) || !inside(right->px)) {
      throw MeasurementError("a target lies outside the images");
    }
    images.push_back({left->px, right->px});
  }
  return images;
}

Expected expected_of(const std::vector<double>& values) {
  const Summary summary = summarize(values);
  return {summary.mean, summary.deviation};
}

}  // namespace

PoseErrorSample disturb_isotropic(std::span<const Vec3> targets, double sigma_mm, std::size_t runs,
                                  std::uint64_t seed, std::uint64_t experiment) {
  PoseErrorSample sample;
  std::vector<Vec3> seen(targets.size());
  for (std::size_t run = 0; run < runs; ++run) {
    RandomStream random(seed, stream_of(experiment, runs, run), kDisturbing);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      seen[i] = targets[i] + sigma_mm * Vec3(x, y, z);
    }
    add_error(sample, seen, targets);
  }
  return sample;
}

PoseErrorSample disturb_images(std::span<const Vec3> targets, double sigma_px, std::size_t runs,
                               std::uint64_t seed, std::uint64_t experiment) {
  const StereoRig rig = stereo_rig();
  const RigidMotion in_tracker = rig_from_platform();
  std::vector<Vec3> truth;
  for (const Vec3& target : targets) truth.push_back(in_tracker * target);
  const std::vector<Images> images = images_of(rig, truth);
  const Mat2 covariance = Mat2::Identity() * (sigma_px * sigma_px);
  PoseErrorSample sample;
  std::vector<Vec3> seen(targets.size());
  for (std::size_t run = 0; run < runs; ++run) {
    RandomStream random(seed, stream_of(experiment, runs, run), kDisturbing);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double a = random.normal(), b = random.normal(), c = random.normal(), d = random.normal();
      const auto point = triangulate_pair(rig, images[i].left + sigma_px * Vec2(a, b), covariance,
                                          images[i].right + sigma_px * Vec2(c, d), covariance);
      if (!point) throw MeasurementError("a target cannot be triangulated");
      seen[i] = point->in_tracker;
    }
    add_error(sample, seen, truth);
  }
  return sample;
}

double rms_rotation_deg(std::span<const Vec3> targets, double sigma_mm) {
  const Vec3 centre = centroid_of(targets);
  Mat3 a = Mat3::Zero();
  for (const Vec3& target : targets) {
    const Vec3 r = target - centre;
    a += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  return deg_from_rad(sigma_mm * std::sqrt(a.inverse().trace()));
}

ExpectedErrors expect_errors(std::span<const Vec3> targets, Disturbance disturbance, double sigma,
                             std::size_t runs, std::size_t experiments, std::uint64_t seed) {
  std::vector<double> mean_r(experiments), max_r(experiments), mean_t(experiments), max_t(experiments);
  parallel_for(experiments, [&](std::size_t e) {
    const PoseErrorSample sample = disturbance == Disturbance::Isotropic
                                       ? disturb_isotropic(targets, sigma, runs, seed, e)
                                       : disturb_images(targets, sigma, runs, seed, e);
    const Summary rotation = summarize(sample.rotation_deg), translation = summarize(sample.translation_mm);
    mean_r[e] = rotation.mean;
    max_r[e] = rotation.highest;
    mean_t[e] = translation.mean;
    max_t[e] = translation.highest;
  });
  return {expected_of(mean_r), expected_of(max_r), expected_of(mean_t), expected_of(max_t)};
}

}  // namespace asterism
