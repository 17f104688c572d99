// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/learn_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

struct Seen {
  std::optional<ObservedFrame> frame;  // empty when a camera has nothing
  std::string fault;
};

std::optional<StereoCentres> centres_of(const Recording& recording, std::size_t index,
                                        const DetectionOptions& options) {
  if (recording.centres) return (*recording.centres)[index];
  const StereoImage image = read_frame(recording, index);
  if (!image.left || !image.right) return std::nullopt;
  return StereoCentres{image.frame, image.time_s, detect_targets(*image.left, options),
                       detect_targets(*image.right, options)};
}

Seen observe(const Recording& recording, std::size_t index, const BodyJobOptions& options) {
  try {
    auto centres = centres_of(recording, index, options.detection);
    if (!centres) return {};
    auto points = triangulate(centres->left, centres->right, *recording.rig, options.triangulation);
    return {ObservedFrame{std::move(*centres), std::move(points)}, ""};
  } catch (const InputError& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

void describe(BodyJobOptions& options, OptionVisitor& visit) {
  describe(options.learning, visit);
  SectionVisitor detection("detection", visit);
  describe(options.detection, detection);
  SectionVisitor triangulation("triangulation", visit);
  describe(options.triangulation, triangulation);
}

ObservedRecording observe_recording(const Recording& recording, const BodyJobOptions& options,
                                    const Progress& progress) {
  if (!recording.rig) {
    throw InputError(recording.folder.string(),
                     "no rig: neither rig.yaml in the recording nor --rig; `asterism "
                     "calibrate` makes one");
  }
  ObservedRecording observed;
  constexpr std::size_t kBatch = 8;  // images in memory at once
  for (std::size_t first = 0; first < recording.frames.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, recording.frames.size() - first);
    std::vector<Seen> batch(count);
    parallel_for(count, [&](std::size_t i) { batch[i] = observe(recording, first + i, options); });
    for (Seen& seen : batch) {
      if (!seen.fault.empty()) observed.faults.push_back(std::move(seen.fault));
      if (seen.frame) observed.frames.push_back(std::move(*seen.frame));
    }
    progress("detecting targets", first + count, recording.frames.size());
  }
  if (observed.frames.empty() && !observed.faults.empty()) throw InputError(observed.faults.front());
  return observed;
}

LearntBody learn_body_of(const Recording& recording, const std::string& name, const BodyJobOptions& options,
                         const Body* nominal, const Progress& progress) {
  const ObservedRecording observed = observe_recording(recording, options, progress);
  progress("learning the body", 0, 1);
  std::vector<Body> others = recording.bodies.value_or(std::vector<Body>{});
  std::erase_if(others, [&](const Body& body) { return body.name == name; });
  auto learnt = learn_body(*recording.rig, observed.frames, name, options.learning, nominal, others);
  if (!learnt) throw MeasurementError(learnt.error().what);
  progress("learning the body", 1, 1);
  learnt->frames_given = static_cast<int>(recording.frames.size());
  if (!observed.faults.empty()) {
    learnt->warnings.push_back(
        fmt::format("{} (one of {} frames left out)", observed.faults.front(), observed.faults.size()));
  }
  return std::move(*learnt);
}

}  // namespace asterism
