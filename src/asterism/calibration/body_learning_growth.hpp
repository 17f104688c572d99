// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/calibration/body_learning.hpp"
#include "asterism/measurement/label.hpp"

namespace asterism {

/// One frame in which a rigid set was found.
struct Sighting {
  std::size_t frame;  // index into the frames given
  RigidMotion tracker_from_set;
  Mat6 covariance;                    // of that motion
  std::vector<LabelledPoint> points;  // point of the frame, target of the set
};

/// Points that keep their mutual distances from frame to frame, in coordinates of their own.
struct RigidSet {
  std::vector<Point> targets;       // in_tracker: in the set's frame; covariance mm²
  std::vector<Sighting> sightings;  // by frame
  double motion_mm = 0;             // largest RMS way of its targets between the first and any sighting
  int ambiguous_frames = 0;         // left out: two labellings fit alike
};

/// Points of one frame that moved together: where a set begins.
struct GrowthSeed {
  std::size_t frame;
  std::vector<int> points;
};

/// Looks for the seed's points in all frames (four of them, or three where few points are about), averages
/// their places, adds the points that come back at one place of the set's frame, and so on until nothing
/// is added. Where several labellings fit a frame alike, the one that turned clearly least from the
/// neighbouring frame is taken, or none.
[[nodiscard]] RigidSet grow_rigid_set(const GrowthSeed& seed, std::span<const ObservedFrame> frames,
                                      const BodyLearningOptions& options);

/// The set with only those of its targets that `keep` names.
[[nodiscard]] RigidSet with_targets(const RigidSet& set, const std::vector<bool>& keep);

/// In how many sightings each target was seen.
[[nodiscard]] std::vector<int> sightings_of_targets(const RigidSet& set);

/// Three points make a body of three; else four, which chance hardly lays alike.
[[nodiscard]] std::size_t least_size(const BodyLearningOptions& options);

/// A frame's points; none where there are so many (250) that the frame is clutter.
[[nodiscard]] std::span<const Point> points_of(const ObservedFrame& frame);

/// RMS way of the targets from one pose to the other.
[[nodiscard]] double rms_motion(const RigidMotion& from, const RigidMotion& to,
                                std::span<const Point> targets);

}  // namespace asterism
