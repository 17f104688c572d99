// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "asterism/camera/image.hpp"
#include "asterism/measurement/centre.hpp"
#include "asterism/measurement/label.hpp"
#include "asterism/measurement/point.hpp"
#include "asterism/measurement/pose.hpp"

namespace asterism {

/// What both cameras took at one moment; a camera that lost the frame has no image.
struct StereoImage {
  int frame = 0;
  double time_s = 0;
  std::optional<Image> left, right;
};

/// The centres found in both images of one frame.
struct StereoCentres {
  int frame = 0;
  double time_s = 0;
  std::vector<Centre> left, right;
};

/// All that tracking made of one frame.
struct TrackedFrame {
  StereoCentres centres;
  std::vector<Point> points;
  std::vector<BodyLabels> labels;
  std::vector<BodyPose> poses;     // measured by this frame alone; one a body
  std::vector<BodyPose> filtered;  // the filter's; one a body
};

}  // namespace asterism
