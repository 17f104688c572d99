// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "asterism/camera/disc_image.hpp"
#include "asterism/cell/motion.hpp"
#include "asterism/evaluation/observed_body.hpp"

namespace asterism {
namespace {

constexpr std::array<Side, 2> kSides = {Side::Left, Side::Right};

const RigidMotion* measured_pose(const TrackedFrame& frame, int body) {
  for (const BodyPose& pose : frame.poses) {
    const bool measured = pose.status == PoseStatus::Ok || pose.status == PoseStatus::Partial;
    if (pose.body == body && measured && pose.estimate) return &pose.estimate->tracker_from_body;
  }
  return nullptr;
}

std::optional<Vec2> predicted_px(const Target& target, const RigidMotion& tracker_from_body,
                                 const StereoRig& rig, Side side) {
  const RigidMotion camera_from_body = rig.camera_from_tracker(side) * tracker_from_body;
  const Vec3 normal = camera_from_body.rotation * target.normal.value_or(Vec3::UnitZ());
  const auto image = project_disc_centre(
      rig.lens(side), {camera_from_body * target.position, normal, target.imaged_radius_mm()});
  return image ? std::optional(image->px) : std::nullopt;
}

const std::vector<Centre>& centres_of(const TrackedFrame& frame, Side side) {
  return side == Side::Left ? frame.centres.left : frame.centres.right;
}

/// Which centre of a camera is which target's: those of labels, for this body and to keep the others' apart.
struct Claims {
  std::vector<char> taken;
  std::vector<int> of_target;  // −1: none
};
Claims labelled(const TrackedFrame& frame, int body, std::size_t targets, Side side) {
  Claims claims{std::vector<char>(centres_of(frame, side).size(), 0), std::vector<int>(targets, -1)};
  for (const BodyLabels& labels : frame.labels) {
    if (labels.status != LabelStatus::Ok) continue;
    for (const LabelledPoint& label : labels.points) {
      const Point& point = frame.points[static_cast<std::size_t>(label.point)];
      const int centre = side == Side::Left ? point.left : point.right;
      if (centre < 0 || static_cast<std::size_t>(centre) >= claims.taken.size()) continue;
      claims.taken[static_cast<std::size_t>(centre)] = 1;
      if (labels.body == body) claims.of_target[static_cast<std::size_t>(label.target)] = centre;
    }
  }
  return claims;
}

/// The nearest unclaimed centres within reach go to the targets that have none, nearest pairs first.
void claim_within(double reach_px, const std::vector<Centre>& centres,
                  const std::vector<std::optional<Vec2>>& predicted, Claims& claims) {
  struct Pair {
    double off_px;
    std::size_t target, centre;
  };
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < predicted.size(); ++t) {
    if (!predicted[t] || claims.of_target[t] >= 0) continue;
    for (std::size_t c = 0; c < centres.size(); ++c) {
      const double off = (centres[c].px() - *predicted[t]).norm();
      if (claims.taken[c] == 0 && off < reach_px) pairs.push_back({off, t, c});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.off_px < b.off_px; });
  for (const Pair& pair : pairs) {
    if (claims.taken[pair.centre] != 0 || claims.of_target[pair.target] >= 0) continue;
    claims.taken[pair.centre] = 1;
    claims.of_target[pair.target] = static_cast<int>(pair.centre);
  }
}

void take_sights(const TrackedFrame& frame, const Body& body, int body_index, const StereoRig& rig,
                 const ObserveOptions& options, SightedFrame& sighted) {
  sighted.sights.resize(body.targets.size());
  for (const Side side : kSides) {
    const auto s = static_cast<std::size_t>(side);
    const std::vector<Centre>& centres = centres_of(frame, side);
    sighted.has_image[s] = !centres.empty();
    std::vector<std::optional<Vec2>> predicted;
    for (const Target& target : body.targets)
      predicted.push_back(predicted_px(target, sighted.tracker_from_body, rig, side));
    Claims claims = labelled(frame, body_index, body.targets.size(), side);
    // Where no pose was measured, one between others is not good to the pixel.
    if (sighted.measured) claim_within(options.near_px, centres, predicted, claims);
    claim_within(options.far_px, centres, predicted, claims);
    for (std::size_t t = 0; t < body.targets.size(); ++t) {
      if (claims.of_target[t] < 0 || !predicted[t]) continue;
      const Centre& centre = centres[static_cast<std::size_t>(claims.of_target[t])];
      const Vec2 residual = centre.px() - *predicted[t];
      sighted.sights[t][s] = {{static_cast<int>(t), side, centre.px(), centre.covariance},
                              residual,
                              residual.norm() < (sighted.measured ? options.near_px : options.far_px)};
    }
  }
}

}  // namespace

void describe(ObserveOptions& options, OptionVisitor& visit) {
  visit.number("near_px", options.near_px, {0.01, 100},
               "a centre so near to where the pose puts a target is its image");
  visit.number("far_px", options.far_px, {0.01, 1000},
               "an unclaimed centre so near may be of a target out of its place");
  visit.number("gap_s", options.gap_s, {0, 60}, "over which poses are carried between measured ones");
  visit.integer("hidden_frames", options.hidden_frames, {1, 100000},
                "missed so many frames on end a target counts as hidden; fewer is chance");
  visit.number("displaced_mm", options.displaced_mm, {0.001, 1000},
               "a target so far beside its place is called out");
  visit.number("noisy_ratio", options.noisy_ratio, {1, 1000},
               "so is one whose residuals are so many times those of the others");
}

std::vector<SightedFrame> sighted_frames(std::span<const TrackedFrame> frames, const Body& body,
                                         int body_index, const StereoRig& rig,
                                         const ObserveOptions& options) {
  KeyedMotion measured;
  for (const TrackedFrame& frame : frames) {
    const RigidMotion* pose = measured_pose(frame, body_index);
    if (pose != nullptr) measured.keys.push_back({frame.centres.time_s, *pose});
  }
  std::vector<SightedFrame> all;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    SightedFrame sighted;
    sighted.frame = i;
    sighted.time_s = frames[i].centres.time_s;
    const RigidMotion* pose = measured_pose(frames[i], body_index);
    sighted.measured = pose != nullptr;
    if (pose != nullptr) {
      sighted.tracker_from_body = *pose;
    } else {
      const auto after =
          std::lower_bound(measured.keys.begin(), measured.keys.end(), sighted.time_s,
                           [](const KeyPose& key, double time_s) { return key.time_s < time_s; });
      if (after == measured.keys.begin() || after == measured.keys.end()) continue;
      if (after->time_s - (after - 1)->time_s > options.gap_s) continue;
      sighted.tracker_from_body = pose_at(measured, sighted.time_s);
    }
    take_sights(frames[i], body, body_index, rig, options, sighted);
    if (sighted.has_image[0] || sighted.has_image[1]) all.push_back(std::move(sighted));
  }
  return all;
}

}  // namespace asterism
