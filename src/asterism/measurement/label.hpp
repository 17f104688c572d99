// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

enum class LabelStatus { Ok, Ambiguous };

struct LabelledPoint {
  int point;   // index into the frame's points
  int target;  // index into the body's targets
};

/// Which points are a body's targets. A body that was not found has none.
struct BodyLabels {
  int body;  // index into the bodies
  LabelStatus status = LabelStatus::Ok;
  std::vector<LabelledPoint> points;
  RigidMotion tracker_from_body;  // of the rigid fit: a start for the pose
  double rms_mm = 0;              // of that fit
  double margin_mm = 0;           // how much worse (RMS, mm) the best wrong labelling fits
};

}  // namespace asterism
