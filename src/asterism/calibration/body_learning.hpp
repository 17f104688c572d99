// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/calibration/body_learning_ambiguity.hpp"
#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/core/options.hpp"
#include "asterism/measurement/frame.hpp"

namespace asterism {

/// What both cameras saw at one moment: the centres, and the points triangulation made of them.
struct ObservedFrame {
  StereoCentres centres;
  std::vector<Point> points;
};

struct BodyLearningOptions {
  int targets = 0;                // how many the body has; must be told
  double deformation_mm = 0.1;    // how far a distance may change beyond what the covariances allow
  double least_motion_mm = 1.0;   // what moves less than this belongs to the background
  double view_gate_px = 1.5;      // how far a centre may lie from where the learnt body expects it
  double shape_error_px = 0.03;   // error of an ellipse's semi-axes that its noise does not tell
  double least_margin_mm = 5.0;   // wrong labels that fit better than this are worth a warning
  double nominal_error_mm = 3.0;  // how far nominal coordinates may be off
};
void describe(BodyLearningOptions& options, OptionVisitor& visit);

enum class BodyLearningFailure {
  TooFewFrames,
  NothingMoves,
  TooFewTargets,
  TooManyTargets,
  SeveralBodies,
  KnownBody,
  Ambiguous,
  NotTheNominalBody
};

/// Why no body was learnt: the reason to count, the words to read.
struct NoBody {
  BodyLearningFailure reason;
  std::string what;
};

/// How well one target was learnt.
struct LearntTarget {
  int frames = 0;                          // in which it was seen
  int views = 0;                           // images in which it was seen
  double rms_px = 0;                       // of its centres, per axis
  Vec3 sigma_mm = Vec3::Zero();            // of its coordinates
  std::optional<double> normal_sigma_rad;  // of its normal, where it has one
};

struct LearntBody {
  Body body;
  std::vector<LearntTarget> targets;
  MatX covariance;           // mm², of all coordinates (x y z of each target)
  double distance_sigma_mm;  // RMS over the pairs of what is stated for their distances
  int frames_used = 0, frames_given = 0;
  int views_rejected = 0;
  double rms_px = 0;           // of all centres, per axis
  double variance_factor = 1;  // χ² per degree of freedom: 1 when the centres' covariances are right
  double rotation_rad = 0;     // largest turn between two frames
  double translation_mm = 0;   // largest way of the body's origin between two frames
  BodyAmbiguity ambiguity;
  std::vector<std::string> warnings;
};

/// Learns the target coordinates of a body from a recording of it in motion; the rig is fixed.
///   1. Sets of points that keep their distances over the frames, without any model (rigid_sets).
///   2. The one that moves and has as many targets as told; background and other bodies fall away.
///   3. Bundle adjustment over its coordinates and its pose in each frame, on the centres in both images
///      with the exact conic; normals and diameters from the ellipses' shapes.
/// Body frame: origin in the targets' centroid, z across the plane that fits them best, towards the
/// cameras, x towards the target farthest from the centroid in that plane: T1. The others follow
/// counter-clockwise as the cameras see them. With `nominal` the frame and the ids are the nominal
/// body's (least squares onto its coordinates).
/// Of several bodies in motion `nominal` also tells which is meant; `others` are bodies known already,
/// which are passed over, and refused by name where nothing else moves.
/// Covariances hold with the centroid and the mean rotation fixed (inner constraints); the rig's own
/// covariance is carried in where it is known.
[[nodiscard]] Result<LearntBody, NoBody> learn_body(
    const StereoRig& rig, std::span<const ObservedFrame> frames, const std::string& name,
    const BodyLearningOptions& options, const Body* nominal = nullptr, std::span<const Body> others = {});

}  // namespace asterism
