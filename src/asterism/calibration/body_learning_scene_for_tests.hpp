// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "asterism/calibration/body_learning.hpp"
#include "asterism/camera/disc_image.hpp"
#include "asterism/camera/two_view.hpp"
#include "asterism/core/random.hpp"

// Recordings at the level of centres with known truth, for the tests of body learning.

namespace asterism::learning {

/// Two cameras 1 m apart, 2.3 m before the body, turned towards it.
inline StereoRig converging_rig(int coefficients = 0) {
  StereoRig rig;
  rig.left = Lens{3200, 3200, 0, 1018.4, 771.3, {-0.12, 0.08, 3e-4, -2e-4, -0.01}, coefficients, 2048, 1536};
  rig.right = Lens{3212, 3212, 0, 1031.8, 762.9, {-0.11, 0.07, -2e-4, 1e-4, -0.01}, coefficients, 2048, 1536};
  rig.right_from_left = RigidMotion{exp_rotation({0, 0.42, 0}), Vec3(-960, 0, 230)};
  return rig;
}

/// The six-target scheme S3 of the paper's Table 1; discs face out of the body.
inline Body six_target_body() {
  const std::vector<Vec3> positions = {{200, -100, 590}, {-100, 300, 610}, {-200, 100, 600},
                                       {0, -250, 605},   {210, 180, 580},  {-200, -240, 590}};
  Body body{"platform", {}};
  for (const Vec3& p : positions) {
    const Vec3 normal = Vec3(p.x() / 900, p.y() / 900, 1.0).normalized();
    body.targets.push_back({"P" + std::to_string(body.targets.size() + 1), p, normal, 12.0, std::nullopt});
  }
  return body;
}

/// A pose in which the body faces the cameras, turned up to `turn_rad` about each axis.
inline RigidMotion pose_near(RandomStream& random, double turn_rad, const Vec3& centre = Vec3(200, 0, 2300)) {
  const Quaternion facing = exp_rotation({std::numbers::pi, 0, 0}) * exp_rotation({0, -0.2, 0});
  const Vec3 omega(random.uniform(-turn_rad, turn_rad), random.uniform(-turn_rad, turn_rad),
                   random.uniform(-turn_rad, turn_rad));
  const Quaternion rotation = facing * exp_rotation(omega);
  const Vec3 shift(random.uniform(-60, 60), random.uniform(-60, 60), random.uniform(-60, 60));
  return {rotation, centre + shift - rotation * Vec3(0, 0, 600)};
}

struct SceneOptions {
  double sigma_px = 0.01;
  double shape_sigma_px = 0.01;
  double hidden = 0.0;       // share of views hidden
  double gate_sigmas = 5.0;  // of the epipolar test: ghosts come from here
  bool shapes = true;
};

/// Adds the image of a disc to one camera's centres, with noise.
inline void add_view(std::vector<Centre>& centres, const Lens& lens, const Disc& disc,
                     const SceneOptions& options, RandomStream& random) {
  const auto image = image_of_disc(lens, disc);
  if (!image) return;
  Centre centre;
  centre.ellipse = *image;
  centre.ellipse.centre += options.sigma_px * Vec2(random.normal(), random.normal());
  centre.ellipse.semi_major += options.shape_sigma_px * random.normal();
  centre.ellipse.semi_minor += options.shape_sigma_px * random.normal();
  if (!options.shapes) centre.ellipse.semi_major = centre.ellipse.semi_minor = 0;
  centre.covariance = options.sigma_px * options.sigma_px * Mat2::Identity();
  centres.push_back(centre);
}

inline void add_body(StereoCentres& centres, const StereoRig& rig, const Body& body, const RigidMotion& pose,
                     const SceneOptions& options, RandomStream& random) {
  for (const Target& target : body.targets) {
    const double radius = 0.5 * target.diameter_mm.value_or(12.0);
    for (const Side side : {Side::Left, Side::Right}) {
      if (random.uniform() < options.hidden) continue;
      const RigidMotion camera_from_body = rig.camera_from_tracker(side) * pose;
      const Disc disc{camera_from_body * target.position,
                      camera_from_body.rotation * target.normal.value_or(Vec3::UnitZ()), radius};
      add_view(side == Side::Left ? centres.left : centres.right, rig.lens(side), disc, options, random);
    }
  }
}

/// All pairs of centres that pass the epipolar test: ghosts included.
inline ObservedFrame observed(StereoCentres centres, const StereoRig& rig, const SceneOptions& options = {}) {
  ObservedFrame frame{std::move(centres), {}};
  for (std::size_t l = 0; l < frame.centres.left.size(); ++l) {
    for (std::size_t r = 0; r < frame.centres.right.size(); ++r) {
      const Centre& left = frame.centres.left[l];
      const Centre& right = frame.centres.right[r];
      const auto point = triangulate_pair(rig, left.px(), left.covariance, right.px(), right.covariance);
      if (!point || std::abs(point->epipolar_error_px) > options.gate_sigmas * point->epipolar_sigma_px)
        continue;
      frame.points.push_back({point->in_tracker, point->covariance, point->epipolar_error_px,
                              static_cast<int>(l), static_cast<int>(r)});
    }
  }
  return frame;
}

/// Lamps and reflections that stay where they are.
inline Body clutter(int count, std::uint64_t seed) {
  RandomStream random(seed, 0, 7);
  Body body{"clutter", {}};
  for (int i = 0; i < count; ++i) {
    const Vec3 place(random.uniform(-300, 700), random.uniform(-450, 450), random.uniform(1900, 2900));
    body.targets.push_back({std::to_string(i), place, -Vec3::UnitZ(), 10.0, std::nullopt});
  }
  return body;
}

/// RMS over all pairs of the difference of their distances; targets in the order of `ids`.
inline double distance_rms(const Body& learnt, const Body& truth,
                           const std::vector<std::size_t>& truth_of_learnt) {
  double sum = 0;
  int pairs = 0;
  for (std::size_t i = 0; i < learnt.targets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++pairs) {
      const double got = (learnt.targets[i].position - learnt.targets[j].position).norm();
      const double is =
          (truth.targets[truth_of_learnt[i]].position - truth.targets[truth_of_learnt[j]].position).norm();
      sum += (got - is) * (got - is);
    }
  }
  return std::sqrt(sum / pairs);
}

inline constexpr double kTurn_rad = 0.26;  // 15°

/// A body in motion, and the truth.
struct SeenBody {
  StereoRig rig = converging_rig();
  Body truth = six_target_body();
  std::vector<ObservedFrame> frames;
  std::vector<RigidMotion> poses;
};

inline SeenBody record(int frames, std::uint64_t seed, const SceneOptions& scene = {},
                       double turn_rad = kTurn_rad, const Body& background = {}) {
  SeenBody recording;
  for (int f = 0; f < frames; ++f) {
    RandomStream random(seed, static_cast<std::uint64_t>(f));
    StereoCentres centres{f, 0.1 * f, {}, {}};
    recording.poses.push_back(pose_near(random, turn_rad));
    SceneOptions seen = scene;
    seen.hidden = 0;
    add_body(centres, recording.rig, background, RigidMotion{}, seen, random);
    add_body(centres, recording.rig, recording.truth, recording.poses.back(), scene, random);
    recording.frames.push_back(observed(std::move(centres), recording.rig, scene));
  }
  return recording;
}

inline BodyLearningOptions six_targets() {
  BodyLearningOptions options;
  options.targets = 6;
  return options;
}

/// Which true target each learnt one is, by laying one body on the other in the best of all orders.
inline std::vector<std::size_t> match(const Body& learnt, const Body& truth) {
  std::vector<std::size_t> order(truth.targets.size()), best;
  std::iota(order.begin(), order.end(), 0);
  double least = 1e9;
  do {
    const double rms = distance_rms(learnt, truth, order);
    if (rms < least) {
      least = rms;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace asterism::learning
