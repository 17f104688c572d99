// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/observe_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

std::string name_of(const Recording& recording) {
  return recording.folder.empty() ? "recording" : recording.folder.string();
}

std::vector<TrackedFrame> tracked_frames(const Recording& recording, const TrackerOptions& options,
                                         std::vector<std::string>& warnings, const Progress& progress) {
  if (!recording.rig) throw InputError(name_of(recording), "has no rig.yaml");
  if (!recording.bodies) throw InputError(name_of(recording), "has no bodies.toml");
  Tracker tracker(*recording.rig, *recording.bodies, options);
  std::vector<TrackedFrame> frames;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    progress("tracking", i + 1, recording.frames.size());
    if (recording.centres) {
      frames.push_back(tracker.process((*recording.centres)[i]));
      continue;
    }
    try {
      frames.push_back(tracker.process(read_frame(recording, i)));
    } catch (const WrongImageSize&) {
      throw;
    } catch (const InputError& error) {
      warnings.push_back(error.what());
    }
  }
  return frames;
}

/// The body to judge: named, the cell's, or the only one.
std::size_t body_index(const Recording& recording, const std::optional<Cell>& cell,
                       const std::string& asked) {
  const std::vector<Body>& bodies = *recording.bodies;
  std::string name = asked;
  if (name.empty() && cell && cell->layout) name = cell->layout->body;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name || (name.empty() && bodies.size() == 1)) return i;
    names.push_back(bodies[i].name);
  }
  if (name.empty()) {
    throw InputError(name_of(recording),
                     fmt::format("it has several bodies; name one with --body: {}", fmt::join(names, ", ")));
  }
  throw InputError(name_of(recording),
                   fmt::format("it has no body `{}`; bodies are: {}", name, fmt::join(names, ", ")));
}

std::vector<std::size_t> evenly(std::size_t count, int most) {
  const auto wanted = std::min(count, static_cast<std::size_t>(most));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(wanted > 1 ? i * (count - 1) / (wanted - 1) : 0);
  return chosen;
}

/// The other bodies as they moved, held where they were last seen; what was never seen stays as planned.
Motion observed_motion(const std::vector<SightedFrame>& sighted, std::span<const double> times_s,
                       const Motion& planned) {
  KeyedMotion seen, told;
  for (const SightedFrame& frame : sighted) seen.keys.push_back({frame.time_s, frame.tracker_from_body});
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    told.keys.push_back({static_cast<double>(i),
                         seen.keys.empty() ? pose_at(planned, times_s[i]) : pose_at(seen, times_s[i])});
  }
  return told;
}

/// Where nothing is known of the surface: targets without a normal are taken to face the cameras as they did
/// on average.
void face_the_cameras(const ObservedBody& observed, const StereoRig& rig, Body& body) {
  const Vec3 middle = 0.5 * rig.right_from_left.inverse().translation;
  for (Target& target : body.targets) {
    if (target.normal) continue;
    Vec3 sum = Vec3::Zero();
    for (const SightedFrame& frame : observed.frames)
      sum += (frame.tracker_from_body.inverse() * middle - target.position).normalized();
    target.normal = sum.normalized();
  }
}

/// A layout task that allows nothing new: the surface is a place holder that no change goes to.
LayoutTask bare_task(const Body& body) {
  LayoutTask task;
  task.body = body.name;
  task.surface.patches.push_back({"nothing known", Plate{}});
  task.most = kMaxTargets;
  task.spacing_mm = 1;
  return task;
}

/// A displaced target in the place where it was seen to stand.
Target where_found(Target target, const Displacement& off) {
  target.position += off.mm;
  target.covariance = Mat3(off.sigma_mm.cwiseProduct(off.sigma_mm).asDiagonal());
  return target;
}

std::string in_words(const Displacement& off) {
  return fmt::format(
      "stands {:.2f} mm ({:+.2f}, {:+.2f}, {:+.2f}; ±{:.2f}) beside where the body's file has it{}",
      off.mm.norm(), off.mm.x(), off.mm.y(), off.mm.z(), off.sigma_mm.norm(),
      off.since_s ? fmt::format(", since {:.2f} s: knocked", *off.since_s)
                  : ", from the start: knocked before, or learnt wrongly");
}

std::vector<std::string> told_in_all(const ObservedBody& observed, const Body& body, double sigma_px) {
  std::vector<std::string> words = {fmt::format(
      "{} was measured in {} of {} frames; residuals {:.3f} px (1σ), taken as the noise of centres",
      body.name, observed.measured, observed.frames_in_all, sigma_px)};
  const std::size_t unknown = observed.frames_in_all - observed.frames.size();
  if (unknown > 0) {
    words.push_back(
        fmt::format("of {} frames no pose is known, not even between others: they are left out", unknown));
  }
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    const ObservedTarget& target = observed.targets[i];
    if (target.displaced) {
      words.push_back(fmt::format("✗ {} {}: the pose has to do without it", body.targets[i].id,
                                  in_words(*target.displaced)));
    }
    if (target.noisy) {
      words.push_back(fmt::format(
          "✗ {} has residuals of {:.3f} px, far more than the others: dirty, half hidden or loose",
          body.targets[i].id, *target.sigma_px));
    }
  }
  return words;
}

/// The cell with what is known of the surface; where nothing is, what can still be judged.
void prepare_task(const std::optional<Cell>& cell, const ObservedBody& observed, Body& body,
                  SuggestionSubject& subject, SuggestOptions& options) {
  Cell& told = subject.cell;
  if (told.layout && told.layout->body == body.name) return;
  face_the_cameras(observed, told.rig, body);
  told.layout = bare_task(body);
  options.kinds = "remove";
  subject.warnings.push_back(fmt::format(
      "{} nothing is known of where targets may stand, so only taking away and learning anew are judged{}",
      cell ? fmt::format("the cell has no layout task for `{}`:", body.name) : "without a cell",
      cell ? "" : "; --cell names one"));
}

Mover& mover_named(Cell& cell, const Body& body) {
  for (Mover& mover : cell.movers) {
    if (mover.body.name == body.name) return mover;
  }
  cell.movers.push_back({body, at_rest(RigidMotion{})});
  return cell.movers.back();
}

/// The poses that are looked at, one a second of the told cell's clock; their own times go beside.
KeyedMotion observed_motion_of(const ObservedBody& observed, int poses, SuggestionSubject& subject) {
  KeyedMotion motion;
  subject.observed.unsound = observed.unsound;
  for (const std::size_t i : evenly(observed.frames.size(), poses)) {
    const SightedFrame& frame = observed.frames[i];
    motion.keys.push_back({static_cast<double>(motion.keys.size()), frame.tracker_from_body});
    subject.pose_times_s.push_back(frame.time_s);
    subject.observed.unhidden.seen.push_back(observed.unhidden.seen[i]);
  }
  return motion;
}

}  // namespace

SuggestionSubject observe_layout(const Recording& recording, const std::optional<Cell>& cell,
                                 const ObserveJob& job, SuggestOptions& options, const Progress& progress) {
  SuggestionSubject subject;
  const std::vector<TrackedFrame> frames = tracked_frames(recording, job.tracker, subject.warnings, progress);
  const std::vector<Body>& bodies = *recording.bodies;
  const StereoRig& rig = *recording.rig;
  const std::size_t index = body_index(recording, cell, job.body);
  Body body = bodies[index];
  const ObservedBody observed = observe_body(frames, body, static_cast<int>(index), rig, job.observe);
  if (observed.measured < 2) {
    throw MeasurementError(fmt::format("`{}` was measured in {} of {} frames: its targets cannot be judged",
                                       body.name, observed.measured, observed.frames_in_all));
  }
  Cell& told = subject.cell;
  if (cell) told = *cell;
  if (!cell) told.name = name_of(recording);
  told.rig = rig;
  prepare_task(cell, observed, body, subject, options);
  const KeyedMotion motion = observed_motion_of(observed, job.poses, subject);
  const auto poses = static_cast<int>(motion.keys.size());
  told.timing = {poses, 1.0};
  told.layout->poses = poses;
  mover_named(told, body) = {body, motion};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b == index) continue;
    Mover& other = mover_named(told, bodies[b]);
    const auto seen = sighted_frames(frames, bodies[b], static_cast<int>(b), rig, job.observe);
    other = {bodies[b], observed_motion(seen, subject.pose_times_s, other.motion)};
  }
  if (observed.sigma_px > 0) options.accuracy.sigma_px = observed.sigma_px;
  subject.observations = told_in_all(observed, body, options.accuracy.sigma_px);
  subject.targets = observed.targets;
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    if (observed.targets[i].displaced)
      subject.observed.found[i] = where_found(body.targets[i], *observed.targets[i].displaced);
  }
  return subject;
}

}  // namespace asterism
