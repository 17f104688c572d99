// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/calibration/body_learning.hpp"
#include "asterism/core/progress.hpp"
#include "asterism/detection/detect.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/tracking/triangulation.hpp"

namespace asterism {

struct BodyJobOptions {
  DetectionOptions detection;
  TriangulationOptions triangulation;
  BodyLearningOptions learning;
};
/// The learning options under their own names, the others' as `detection.…` and `triangulation.…`.
void describe(BodyJobOptions& options, OptionVisitor& visit);

struct ObservedRecording {
  std::vector<ObservedFrame> frames;  // those seen by both cameras
  std::vector<std::string> faults;    // images that could not be read
};

/// Centres and points of all frames of a recording. Frames that a camera lost, or whose image cannot be
/// read, are left out. Throws InputError for a recording without a rig or without a readable frame.
[[nodiscard]] ObservedRecording observe_recording(const Recording& recording, const BodyJobOptions& options,
                                                  const Progress& progress);

/// The body that moves in a recording. The recording's own bodies of other names are known and passed over.
/// Throws MeasurementError, with the reason, when there is none.
[[nodiscard]] LearntBody learn_body_of(const Recording& recording, const std::string& name,
                                       const BodyJobOptions& options, const Body* nominal,
                                       const Progress& progress);

}  // namespace asterism
