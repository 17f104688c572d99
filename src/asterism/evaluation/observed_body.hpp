// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/core/options.hpp"
#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/pose.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

// What a tracked recording shows of a body's targets: when each camera saw them, how well they fit, and
// whether they stand where the body's file has them. No truth is needed.

struct ObserveOptions {
  double near_px = 1.5;       // a centre so near to where the pose puts a target is its image
  double far_px = 15;         // one so near that no other target claims may be of a target out of its place
  double gap_s = 0.5;         // poses are carried over gaps up to it, from measured poses on both sides
  int hidden_frames = 3;      // missed so many frames on end a target counts as hidden there; fewer is chance
  double displaced_mm = 0.2;  // a target so far beside its place is called out, and
  double noisy_ratio = 2.0;   // one whose residuals are so many times those of the others
  std::size_t frames = 200;   // looked at for displacements, evenly over the recording
};
void describe(ObserveOptions& options, OptionVisitor& visit);

/// A body in one frame, with the image of each target where one was found.
struct SightedFrame {
  std::size_t frame = 0;  // of those that were tracked
  double time_s = 0;
  RigidMotion tracker_from_body;
  bool measured = false;          // else between measured poses
  std::array<bool, 2> has_image;  // by side
  struct Sight {
    TargetView view;
    Vec2 residual_px;  // measured less where the pose puts it
    bool near = false;
  };
  std::vector<std::array<std::optional<Sight>, 2>> sights;  // [target][side]
};

/// Frames in which the body's pose is known. Labelled centres first, then the nearest unclaimed ones.
[[nodiscard]] std::vector<SightedFrame> sighted_frames(std::span<const TrackedFrame> frames, const Body& body,
                                                       int body_index, const StereoRig& rig,
                                                       const ObserveOptions& options);

/// A target that stands beside where the body's file has it: knocked, or learnt wrongly.
struct Displacement {
  Vec3 mm = Vec3::Zero();         // in the body's frame
  Vec3 sigma_mm = Vec3::Zero();   // of this median, by the scatter over the frames
  std::optional<double> since_s;  // when it was knocked; none: from the start
  std::size_t frames = 0;         // with a pose from the others and the target in both images
};

/// One a target, where it is displaced. Each is held against poses from the others alone; the one that stands
/// out most is named, left out, and the others are asked again.
[[nodiscard]] std::vector<std::optional<Displacement>> displacements(std::span<const SightedFrame> frames,
                                                                     const Body& body, const StereoRig& rig,
                                                                     const ObserveOptions& options);

struct ObservedTarget {
  std::array<double, 2> seen{};    // share of the frames that had an image, by side
  double seen_by_both = 0;         // of the frames in which both had one
  std::optional<double> sigma_px;  // robust, of one coordinate; none when it was hardly seen
  bool noisy = false;              // much more than the others: dirty, half hidden or loose
  std::optional<Displacement> displaced;
};

struct ObservedBody {
  std::vector<SightedFrame> frames;  // with a pose
  std::size_t frames_in_all = 0;
  std::size_t measured = 0;
  std::vector<ObservedTarget> targets;
  MotionVisibility unhidden;  // by `frames`: bit i cleared where target i was missed `hidden_frames` on end
  TargetMask unsound = 0;     // targets that are displaced
  double sigma_px = 0;        // of one coordinate of a sound target's centre: 1.4826 MAD, widened by what the
                              // poses took up of the residuals
};
[[nodiscard]] ObservedBody observe_body(std::span<const TrackedFrame> frames, const Body& body,
                                        int body_index, const StereoRig& rig, const ObserveOptions& options);

}  // namespace asterism
