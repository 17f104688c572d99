// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "asterism/tracking/fused_state.hpp"
#include "asterism/tracking/time_offset.hpp"

namespace asterism {

struct FusedOptions {
  double latency_s = 0;            // a reading tells of where the platform was so long before its stamp,
  double latency_sigma_s = 0;      // known this well
  double correlation_s = 0;        // for which the readings' correlated noise keeps its value
  double gate_probability = 1e-3;  // of refusing a reading that fits
  int slip_after = 5;     // readings refused in a row: the read-out slipped, its frame is learnt anew
  double memory_s = 0.5;  // how late a measurement may come
};
void describe(FusedOptions& options, OptionVisitor& visit);

/// What became of a reading.
enum class ReadingUse {
  Waits,    // the pose is not known yet, or its twist
  Learnt,   // it told where the base is
  Used,     // it corrected the pose
  Refused,  // it does not fit: a jump
  Slipped,  // the last of too many that did not fit: the base is forgotten
  TooLate
};

/// One body's pose over time from the tracker and from what its platform says of itself, as PoseFilter is
/// from the tracker alone (gate, coasting and what is systematic as there).
///
/// Readings enter as absolute poses in a base frame whose place is part of the state, with their correlated
/// noise beside it (fused_state.hpp). That is right at both ends and between: where noise is white every
/// reading tells the pose anew and many are better than one; where it lasts, what it is now is learnt while
/// the tracker speaks, and through an occlusion only the readings' increments count. Increments alone
/// would throw away the first, absolute readings alone would trust the second.
///
/// A pose that the tracker did not measure is PREDICTED, however well the readings carry it. Measurements may
/// come in any order within `memory_s`: they are put in the order of the time they tell of, and all that
/// follows is worked again, so the state is that of the run in order, bit for bit.
class FusedFilter {
 public:
  /// `known`: latency and base from an earlier run. Of the same run give the latency alone (options): the
  /// base would be learnt twice from the same poses.
  FusedFilter(const FusedOptions& options, const FilterOptions& motion,
              const std::optional<TimeOffset>& known = {});

  /// Where the body should be at `time_s`, by all that is told of until then; empty when it is lost.
  [[nodiscard]] std::optional<PoseEstimate> predict(double time_s) const;

  /// Takes in what a frame measured (or that it measured nothing); the pose by all that is told of until
  /// then. Throws InputError when it comes more than `memory_s` late.
  BodyPose update_tracker(double time_s, const BodyPose& measured);
  ReadingUse update_read_out(const PlatformReading& reading);

  /// Where the base is by now; empty when no reading has told it.
  [[nodiscard]] std::optional<PoseEstimate> tracker_from_base() const;

 private:
  struct Memory {
    FusedState state;
    bool seen = false;   // the state holds a pose
    bool fresh = false;  // one pose alone: the twist is not known yet
    Mat6 systematic = Mat6::Zero();
    int misfits = 0, refused = 0;  // in a row, of poses and of readings
    double doubt = 1;              // by which predictions are widened while a pose contradicts the motion
  };
  struct Event {
    double time_s;  // it tells of
    std::variant<BodyPose, PlatformReading> told;
    Memory after;
  };
  struct Outcome {
    BodyPose filtered;
    ReadingUse use;
  };
  [[nodiscard]] std::optional<PoseEstimate> predicted_by(const Memory& memory, double time_s) const;
  [[nodiscard]] bool alive(const Memory& memory, double time_s) const;
  [[nodiscard]] BodyPose take_pose(Memory& memory, double time_s, const BodyPose& measured) const;
  [[nodiscard]] ReadingUse take_reading(Memory& memory, double time_s, const PlatformReading& reading) const;
  [[nodiscard]] Outcome take(Event event);

  FusedOptions options_;
  FilterOptions motion_;
  double pose_gate_, reading_gate_;
  Memory before_;             // all recent ones
  std::deque<Event> recent_;  // in order of time
  std::optional<double> forgotten_until_s_;
};

/// A recorded run: one pose a tracked one, by all that is told of until its time.
[[nodiscard]] std::vector<BodyPose> fused(std::span<const TimedPose> tracked,
                                          std::span<const PlatformReading> readings,
                                          const FusedOptions& options, const FilterOptions& motion,
                                          const std::optional<TimeOffset>& known = {});

}  // namespace asterism
