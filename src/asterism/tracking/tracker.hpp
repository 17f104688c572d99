// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "asterism/detection/detect.hpp"
#include "asterism/measurement/frame.hpp"
#include "asterism/tracking/filter.hpp"
#include "asterism/tracking/identification.hpp"
#include "asterism/tracking/pose.hpp"
#include "asterism/tracking/triangulation.hpp"
#include "asterism/tracking/view_matching.hpp"

namespace asterism {

struct TrackerOptions {
  DetectionOptions detection;
  TriangulationOptions triangulation;
  IdentificationOptions identification;
  ViewOptions views;
  PoseOptions pose;
  FilterOptions filter;
  int full_search_interval = 10;   // frames; between, tracked bodies are looked for where they should be
  double window_margin_px = 16.0;  // about where a target should be
};
/// Each part's options under its name: `detection.min_diameter_px`.
void describe(TrackerOptions& options, OptionVisitor& visit);

/// From two images to poses, frame by frame: detect, triangulate, identify, estimate, filter.
///
/// A body is OK with four targets seen by both cameras, PARTIAL with fewer that still determine it (those
/// seen by one camera count, found by where the pose or the last frames put them), AMBIGUOUS when another
/// labelling or the body turned over fits as well, else LOST.
class Tracker {
 public:
  /// Throws InputError for a wrong rig or body.
  Tracker(StereoRig rig, std::vector<Body> bodies, TrackerOptions options = {});

  /// Throws InputError when an image's size is not the rig's or time goes back; both name the frame.
  [[nodiscard]] TrackedFrame process(const StereoImage& image);
  [[nodiscard]] TrackedFrame process(StereoCentres centres);

  [[nodiscard]] const std::vector<Body>& bodies() const { return catalogue_.bodies(); }
  /// How often a body that was found got no pose for this reason.
  [[nodiscard]] int failures(PoseFailure reason) const { return failures_[static_cast<std::size_t>(reason)]; }

 private:
  using Predictions = std::vector<std::optional<PoseEstimate>>;
  struct Windows {
    std::vector<SearchWindow> left, right;
  };
  [[nodiscard]] Predictions predictions(double time_s) const;
  [[nodiscard]] std::optional<Windows> windows(const Predictions& predicted) const;
  [[nodiscard]] bool covered(const TrackedFrame& frame, const Windows& windows) const;
  [[nodiscard]] TrackedFrame measure(StereoCentres centres, const Predictions& predicted);
  [[nodiscard]] BodyPose measure_body(std::size_t body, const TrackedFrame& frame,
                                      const Predictions& predicted, CentreUse& use);
  [[nodiscard]] bool fits_as_usual(std::size_t body, const PoseSolution& solution) const;
  [[nodiscard]] TrackedFrame over_time(TrackedFrame frame);
  void check_time(int frame, double time_s) const;
  void check_size(const StereoImage& image) const;

  StereoRig rig_;
  BodyCatalogue catalogue_;
  TrackerOptions options_;
  std::vector<PoseFilter> filters_;
  std::array<int, kPoseFailures> failures_{};
  std::vector<double> misfit_, usual_misfit_;  // χ²/dof a body: of this frame, and as OK poses have had it
  std::optional<int> last_frame_;
  double last_time_s_ = 0;
  int since_full_search_ = 0;
};

}  // namespace asterism
