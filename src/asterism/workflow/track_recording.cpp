// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/track_recording.hpp"

#include <fmt/format.h>

#include <chrono>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/point_table.hpp"
#include "asterism/io/pose_table.hpp"
#include "asterism/tracking/smoother.hpp"

namespace asterism {
namespace {

/// Adds the time of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Why a body's pose can never be told, or empty.
std::string untrackable(const Body& body) {
  if (body.targets.size() < 3) {
    return fmt::format("body `{}` has {} target{}; a pose needs three or more, not on one line", body.name,
                       body.targets.size(), body.targets.size() == 1 ? "" : "s");
  }
  Vec3 middle = Vec3::Zero();
  for (const Target& target : body.targets)
    middle += target.position / static_cast<double>(body.targets.size());
  Mat3 scatter = Mat3::Zero();
  for (const Target& target : body.targets) {
    scatter += (target.position - middle) * (target.position - middle).transpose();
  }
  // A thousandth of the body's length: then the turn about the line is a thousand times worse known.
  const Vec3 spread = symmetric_eigen(scatter).values;
  if (spread(1) > 1e-6 * spread(2)) return "";
  return fmt::format(
      "body `{}`: its targets lie on one line, about which its turn cannot be told; add one beside it",
      body.name);
}

void check_bodies_trackable(const std::vector<Body>& bodies, std::vector<std::string>& warnings) {
  for (const Body& body : bodies) {
    if (std::string why = untrackable(body); !why.empty()) warnings.push_back(std::move(why));
  }
  if (warnings.size() == bodies.size()) throw InputError(warnings.front());
}

/// The first image of each camera tells whether the rig is the one that took them.
void check_image_size(const Recording& recording) {
  for (const Side side : {Side::Left, Side::Right}) {
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
      const FrameEntry& entry = recording.frames[i];
      if ((side == Side::Left ? entry.left : entry.right).empty()) continue;
      try {
        static_cast<void>(read_frame_image(recording, i, side));
      } catch (const WrongImageSize&) {
        throw;
      } catch (const InputError&) {
        continue;  // unreadable: counted when its turn comes
      }
      break;
    }
  }
}

struct ReadFrame {
  StereoImage image;
  std::vector<UnreadableImage> unreadable;
};

ReadFrame read_what_can_be_read(const Recording& recording, std::size_t index) {
  const FrameEntry& entry = recording.frames[index];
  ReadFrame read{{entry.frame, entry.time_s, {}, {}}, {}};
  for (const Side side : {Side::Left, Side::Right}) {
    try {
      (side == Side::Left ? read.image.left : read.image.right) = read_frame_image(recording, index, side);
    } catch (const InputError& error) {
      read.unreadable.push_back({entry.frame, side, error.what()});
    }
  }
  return read;
}

/// Reads a frame's images on another thread while the one before is worked on: decoding takes longer
/// than tracking.
class ReadAhead {
 public:
  explicit ReadAhead(const Recording& recording) : recording_(recording) { start(); }

  [[nodiscard]] ReadFrame next() {
    ReadFrame read = coming_.get();
    start();
    return read;
  }

 private:
  void start() {
    if (index_ >= recording_.frames.size()) return;
    coming_ = std::async(std::launch::async,
                         [this, index = index_] { return read_what_can_be_read(recording_, index); });
    ++index_;
  }

  const Recording& recording_;
  std::size_t index_ = 0;
  std::future<ReadFrame> coming_;
};

/// The tables that grow with each frame.
class Tables {
 public:
  Tables(const TrackJob& job, const std::vector<Body>& bodies)
      : bodies_(bodies),
        centres_(job.out / "centres.csv"),
        points_(job.out / "points.csv"),
        poses_(job.out / "poses.csv"),
        filtered_(job.out / "poses_filtered.csv") {
    if (job.covariance) json_.emplace(job.out / "poses.json", OutputFile::Unfinished::Keep);
  }

  void write(const TrackedFrame& frame, const FrameEntry& entry) {
    centres_.write(frame.centres, entry.left, entry.right);
    points_.write(entry.frame, frame.points);
    for (const BodyPose& pose : frame.poses) {
      const PoseRecord record = record_of(entry.frame, entry.time_s, pose, bodies_);
      poses_.write(record);
      if (json_) json_->write(json_line(record) + "\n");
    }
    for (const BodyPose& pose : frame.filtered) {
      filtered_.write(record_of(entry.frame, entry.time_s, pose, bodies_));
    }
    if (++frames_ % kFlushEvery == 0) flush();
  }

  void finish() {
    poses_.finish();
    filtered_.finish();
    if (json_) json_->finish();
    points_.finish();
    centres_.finish();
  }

 private:
  static constexpr int kFlushEvery = 32;  // frames that a crash may cost

  void flush() {
    centres_.flush();
    points_.flush();
    poses_.flush();
    filtered_.flush();
    if (json_) json_->flush();
  }

  const std::vector<Body>& bodies_;
  CentreTable centres_;
  PointTable points_;
  PoseTable poses_, filtered_;
  std::optional<OutputFile> json_;
  int frames_ = 0;
};

void track_frames(const Recording& recording, Tracker& tracker, Tables& tables, TrackedRun& run,
                  const Progress& progress) {
  std::optional<ReadAhead> images;
  if (!recording.centres) images.emplace(recording);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    ReadFrame read;
    if (images) {
      const Stopwatch watch(run.seconds.waiting_for_images);
      read = images->next();
    }
    run.unreadable.insert(run.unreadable.end(), read.unreadable.begin(), read.unreadable.end());
    {
      const Stopwatch watch(run.seconds.tracking);
      run.frames.push_back(images ? tracker.process(read.image) : tracker.process((*recording.centres)[i]));
    }
    {
      const Stopwatch watch(run.seconds.writing);
      tables.write(run.frames.back(), recording.frames[i]);
    }
    progress("tracking", i + 1, recording.frames.size());
  }
}

void refuse_if_nothing_was_read(const Recording& recording, const TrackedRun& run) {
  std::size_t listed = 0;
  for (const FrameEntry& entry : recording.frames)
    listed += (entry.left.empty() ? 0U : 1U) + (entry.right.empty() ? 0U : 1U);
  if (listed == 0 || run.unreadable.size() < listed) return;
  throw InputError(fmt::format("{} (none of {} images could be read)", run.unreadable.front().why, listed));
}

void count_failures(const Tracker& tracker, TrackedRun& run) {
  constexpr const char* kNames[] = {"too_few_views", "not_determined", "no_convergence", "behind_camera",
                                    "faces_away",    "inconsistent",   "ambiguous"};
  static_assert(std::size(kNames) == kPoseFailures);
  for (std::size_t reason = 0; reason < kPoseFailures; ++reason) {
    const int count = tracker.failures(static_cast<PoseFailure>(reason));
    if (count > 0) run.pose_failures[kNames[reason]] = count;
  }
}

void write_smoothed(const Recording& recording, const TrackJob& job, const TrackedRun& run) {
  PoseTable table(job.out / "poses_smoothed.csv");
  std::vector<PoseRecord> measured;
  for (std::size_t i = 0; i < run.smoothed.size(); ++i) {
    const FrameEntry& entry = recording.frames[i];
    for (const BodyPose& pose : run.smoothed[i])
      table.write(record_of(entry.frame, entry.time_s, pose, run.bodies));
    for (const BodyPose& pose : run.frames[i].poses) {
      if (job.tum) measured.push_back(record_of(entry.frame, entry.time_s, pose, run.bodies));
    }
  }
  table.finish();
  if (!job.tum) return;
  for (const Body& body : run.bodies) write_tum(job.out / (body.name + ".tum"), measured, body.name);
}

void check_shapes(const StereoRig& rig, const TrackerOptions& options, TrackedRun& run) {
  for (std::size_t body = 0; body < run.bodies.size(); ++body) {
    run.shapes.push_back(check_shape(body, run.frames, run.bodies, rig, {}, options.views));
    for (const KnockedTarget& knocked : run.shapes.back().knocked)
      run.warnings.push_back(words_of(knocked, run.bodies[body]));
  }
}

}  // namespace

TrackedRun track_recording(const Recording& recording, const TrackJob& job, const Progress& progress) {
  const std::string where = recording.folder.empty() ? "recording" : recording.folder.string();
  if (!recording.rig) throw InputError(where, "has no rig.yaml; name one with --rig");
  if (!recording.bodies) throw InputError(where, "has no bodies.toml; name one with --bodies");
  TrackedRun run;
  run.bodies = *recording.bodies;
  check_bodies_trackable(run.bodies, run.warnings);
  if (!recording.centres) check_image_size(recording);
  {
    const Stopwatch watch(run.seconds.total);
    Tracker tracker(*recording.rig, run.bodies, job.options);
    Tables tables(job, run.bodies);
    track_frames(recording, tracker, tables, run, progress);
    tables.finish();
    count_failures(tracker, run);
    refuse_if_nothing_was_read(recording, run);
    check_shapes(*recording.rig, job.options, run);
    {
      const Stopwatch smoothing(run.seconds.smoothing);
      run.smoothed = smooth(run.frames, job.options.filter);
    }
    const Stopwatch writing(run.seconds.writing);
    write_smoothed(recording, job, run);
  }
  for (const UnreadableImage& image : run.unreadable) run.warnings.push_back(image.why);
  write_file(job.out / "summary.json", summary_of(run, job.options).dump(2) + "\n");
  return run;
}

}  // namespace asterism
