// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "asterism/camera/disc_image.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/evaluation/observed_body.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFewestFrames = 9;  // three in each third
constexpr double kSigmas = 5;
constexpr double kMadToSigma = 1.4826;    // of a normal sample
constexpr double kMedianToMean = 1.2533;  // its median is so much less sure than its mean

/// Where a target was found in one frame, beside its place, by a pose from the others.
struct Offset {
  double time_s;
  Vec3 mm;  // in the body's frame
};

std::optional<Offset> offset_in(const SightedFrame& frame, const Body& body, std::size_t target,
                                TargetMask left_out, const StereoRig& rig) {
  const auto& own = frame.sights[target];
  if (!own[0] || !own[1]) return std::nullopt;
  std::vector<TargetView> views;
  for (std::size_t t = 0; t < body.targets.size(); ++t) {
    if (t == target || (left_out >> t & 1) != 0) continue;
    for (const auto& sight : frame.sights[t]) {
      if (sight && sight->near) views.push_back(sight->view);
    }
  }
  const auto pose = estimate_pose(body, views, rig, frame.tracker_from_body, PoseOptions{});
  if (!pose) return std::nullopt;
  const RigidMotion& tracker_from_body = pose->estimate.tracker_from_body;
  const Target& at = body.targets[target];
  MatX normal = MatX::Zero(3, 3);
  VecX right = VecX::Zero(3);
  for (const auto& sight : own) {
    const RigidMotion camera_from_body = rig.camera_from_tracker(sight->view.side) * tracker_from_body;
    const auto image = project_disc_centre(
        rig.lens(sight->view.side),
        {camera_from_body * at.position, camera_from_body.rotation * at.normal.value_or(Vec3::UnitZ()),
         at.imaged_radius_mm()});
    if (!image) return std::nullopt;
    const Mat23 by_body = image->by_centre * camera_from_body.rotation.toRotationMatrix();
    normal += by_body.transpose() * by_body;
    right += by_body.transpose() * (sight->view.px - image->px);
  }
  const auto mm = solve_positive(normal, right);
  if (!mm) return std::nullopt;
  return Offset{frame.time_s, Vec3(*mm)};
}

struct Middle {
  Vec3 mm = Vec3::Zero(), sigma_mm = Vec3::Zero();
};
Middle middle_of(std::span<const Offset> offsets) {
  Middle middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Offset& offset : offsets) values.push_back(offset.mm(axis));
    middle.mm(axis) = quantile_of(values, 0.5);
    for (double& value : values) value = std::abs(value - middle.mm(axis));
    middle.sigma_mm(axis) = kMedianToMean * kMadToSigma * quantile_of(values, 0.5) /
                            std::sqrt(static_cast<double>(offsets.size()));
  }
  return middle;
}

/// How many times what is allowed.
double excess(const Middle& middle, const ObserveOptions& options) {
  return middle.mm.norm() / std::max(options.displaced_mm, kSigmas * middle.sigma_mm.norm());
}

/// From which frame on the target stands where it does at the end: fewest frames on the wrong side.
std::size_t first_displaced(std::span<const Offset> offsets, const Vec3& at_end) {
  const auto displaced = [&](const Offset& offset) {
    return offset.mm.dot(at_end) > 0.5 * at_end.squaredNorm();
  };
  auto wrong = static_cast<std::ptrdiff_t>(
      std::count_if(offsets.begin(), offsets.end(), [&](const Offset& o) { return !displaced(o); }));
  std::ptrdiff_t fewest = wrong;
  std::size_t first = 0;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    wrong += displaced(offsets[i]) ? 1 : -1;
    if (wrong >= fewest) continue;
    fewest = wrong;
    first = i + 1;
  }
  return first;
}

/// What the last third of the recording says, by how many times it is more than allowed.
struct Found {
  double excess = 0;
  Displacement displacement;
};
Found displacement_of(std::span<const SightedFrame* const> frames, const Body& body, std::size_t target,
                      TargetMask left_out, const StereoRig& rig, const ObserveOptions& options) {
  std::vector<std::optional<Offset>> each(frames.size());
  parallel_for(frames.size(),
               [&](std::size_t i) { each[i] = offset_in(*frames[i], body, target, left_out, rig); });
  std::vector<Offset> offsets;
  for (const auto& one : each) {
    if (one) offsets.push_back(*one);
  }
  if (offsets.size() < kFewestFrames) return {};
  const Middle at_end = middle_of(std::span(offsets).last(offsets.size() / 3));
  Found found;
  found.excess = excess(at_end, options);
  const std::size_t first = first_displaced(offsets, at_end.mm);
  const Middle since = middle_of(std::span(offsets).subspan(std::min(first, offsets.size() - 1)));
  found.displacement = {since.mm, since.sigma_mm, {}, offsets.size()};
  if (first > 0 && first < offsets.size()) found.displacement.since_s = offsets[first].time_s;
  return found;
}

}  // namespace

std::vector<std::optional<Displacement>> displacements(std::span<const SightedFrame> frames, const Body& body,
                                                       const StereoRig& rig, const ObserveOptions& options) {
  std::vector<const SightedFrame*> sample;
  std::size_t measured = 0;
  for (const SightedFrame& frame : frames) measured += frame.measured ? 1 : 0;
  const std::size_t stride = std::max<std::size_t>(1, (measured + options.frames - 1) / options.frames);
  std::size_t next = 0;
  for (const SightedFrame& frame : frames) {
    if (frame.measured && next++ % stride == 0) sample.push_back(&frame);
  }
  std::vector<std::optional<Displacement>> displaced(body.targets.size());
  TargetMask left_out = 0;
  // Three must stay to tell a pose by.
  for (std::size_t named = 0; named + 3 < body.targets.size(); ++named) {
    std::vector<Found> found(body.targets.size());
    std::size_t worst = 0;
    for (std::size_t t = 0; t < body.targets.size(); ++t) {
      if ((left_out >> t & 1) != 0) continue;
      found[t] = displacement_of(sample, body, t, left_out, rig, options);
      if (found[t].excess > found[worst].excess) worst = t;
    }
    if (!(found[worst].excess > 1)) break;
    displaced[worst] = found[worst].displacement;
    left_out |= TargetMask{1} << worst;
  }
  return displaced;
}

}  // namespace asterism
