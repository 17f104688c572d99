// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/pose.hpp"

// From centres to the views a pose is estimated from.

namespace asterism {

struct ViewOptions {
  double doubtful_sigma_px = 0.3;   // added to a centre that is occluded, touched or coarse
  double match_sigmas = 4.0;        // how near to where a target should be an unused centre must lie
  double match_error_px = 0.3;      // what rig and body may add to that, one sigma
  double max_size_ratio = 1.4;      // of a disc's seen and expected size, by the median of its body's
  double max_incidence_deg = 85.0;  // discs turned further away are not looked for
  double moved_reach_mm = 20.0;     // how far from its place a target that was knocked is looked for
};
void describe(ViewOptions& options, OptionVisitor& visit);

/// A centre as a target's view; its covariance widened where its flags call it doubtful.
[[nodiscard]] TargetView view_of(const Centre& centre, int target, Side side, const ViewOptions& options);

/// Which centres of a frame already belong to a target.
struct CentreUse {
  std::vector<char> left, right;

  explicit CentreUse(const StereoCentres& centres)
      : left(centres.left.size(), 0), right(centres.right.size(), 0) {}
  [[nodiscard]] std::vector<char>& of(Side side) { return side == Side::Left ? left : right; }
};

/// A target where a pose says it is, in one camera.
struct ExpectedView {
  int target;
  Side side;
  Ellipse image;    // px
  Mat2 covariance;  // px², by the pose's
};

/// What a camera should see of a body: targets that face it and lie in its image.
[[nodiscard]] std::vector<ExpectedView> expected_views(const Body& body, const StereoRig& rig,
                                                       const PoseEstimate& pose, const ViewOptions& options);

/// The views of a labelling: both centres of each point. Centres cut by the image's border are left out, as
/// are discs whose size stands apart from their body's others.
[[nodiscard]] std::vector<TargetView> labelled_views(const BodyLabels& labels, std::span<const Point> points,
                                                     const StereoCentres& centres, const Body& body,
                                                     const StereoRig& rig, const ViewOptions& options);

/// Adds views of targets that have none yet where exactly one unused centre lies within the gate and nothing
/// else near it: targets hidden from the other camera, above all. Marks the centres used. How many were
/// added.
int add_matched_views(std::vector<TargetView>& views, const Body& body, const PoseEstimate& pose,
                      const StereoCentres& centres, CentreUse& use, const StereoRig& rig,
                      const ViewOptions& options);

}  // namespace asterism
