// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/fused_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "asterism/statistics/distributions.hpp"

namespace asterism {

void describe(FusedOptions& options, OptionVisitor& visit) {
  visit.number("latency_s", options.latency_s, {-10, 10},
               "a reading tells of where the platform was so long before its stamp");
  visit.number("latency_sigma_s", options.latency_sigma_s, {0, 10}, "how well the latency is known");
  visit.number("correlation_s", options.correlation_s, {0, 1e4},
               "time for which the readings' correlated noise keeps its value");
  visit.number("gate_probability", options.gate_probability, {1e-12, 0.1}, "of refusing a reading that fits");
  visit.integer("slip_after", options.slip_after, {1, 1000000},
                "readings refused in a row that make the read-out's frame unknown");
  visit.number("memory_s", options.memory_s, {0, 60}, "how late a measurement may come");
}

namespace {

bool is_measured(const BodyPose& pose) {
  return pose.status == PoseStatus::Ok || pose.status == PoseStatus::Partial;
}

/// A body first seen at rest may be turning: two poses tell its twist before anything is linearised.
FusedState set_turning(FusedState state, double time_s, const RigidMotion& measured) {
  if (time_s > state.time_s) {
    state.twist = twist_between(state.tracker_from_body, measured, time_s - state.time_s);
  }
  return state;
}

}  // namespace

FusedFilter::FusedFilter(const FusedOptions& options, const FilterOptions& motion,
                         const std::optional<TimeOffset>& known)
    : options_(options),
      motion_(motion),
      pose_gate_(chi_square_quantile(1 - motion.gate_probability, 6)),
      reading_gate_(chi_square_quantile(1 - options.gate_probability, 6)) {
  if (known) {
    options_.latency_s = known->latency_s;
    options_.latency_sigma_s = known->sigma_s;
    before_.state = with_base(before_.state, known->tracker_from_base, known->covariance);
  }
  before_.state = with_latency_doubt(before_.state, options_.latency_sigma_s);
}

bool FusedFilter::alive(const Memory& memory, double time_s) const {
  return memory.seen && time_s - memory.state.time_s <= motion_.coast_max_s;
}

std::optional<PoseEstimate> FusedFilter::predicted_by(const Memory& memory, double time_s) const {
  if (!alive(memory, time_s)) return std::nullopt;
  const FusedState state = carried_to(memory.state, time_s, motion_, options_.correlation_s);
  return PoseEstimate{state.tracker_from_body,
                      memory.doubt * state.covariance.topLeftCorner<6, 6>() + memory.systematic,
                      memory.systematic};
}

std::optional<PoseEstimate> FusedFilter::predict(double time_s) const {
  const auto next = std::upper_bound(recent_.begin(), recent_.end(), time_s,
                                     [](double t, const Event& event) { return t < event.time_s; });
  const Memory& memory = next == recent_.begin() ? before_ : std::prev(next)->after;
  if (time_s < memory.state.time_s) return std::nullopt;
  return predicted_by(memory, time_s);
}

std::optional<PoseEstimate> FusedFilter::tracker_from_base() const {
  const FusedState& state = recent_.empty() ? before_.state : recent_.back().after.state;
  if (!state.tracker_from_base) return std::nullopt;
  return PoseEstimate{*state.tracker_from_base, covariance_of_base(state), Mat6::Zero()};
}

BodyPose FusedFilter::take_pose(Memory& memory, double time_s, const BodyPose& measured) const {
  BodyPose filtered = measured;
  const bool known = alive(memory, time_s);
  if (is_measured(measured)) {
    const PoseEstimate& raw = measured.estimate.value();
    const Mat6 noise = raw.covariance - raw.systematic;
    std::optional<Correction> correction;
    double contradicted = 1;
    if (known) {
      const auto before = [&](const FusedState& state) {
        return carried_to(state, time_s, motion_, options_.correlation_s);
      };
      const FusedState expected = before(memory.state);
      correction = corrected_by_pose(expected, raw.tracker_from_body, noise);
      contradicted = contradiction(expected.tracker_from_body, expected.covariance.topLeftCorner<6, 6>(),
                                   raw.tracker_from_body);
      if (memory.fresh) {
        const FusedState turning = set_turning(memory.state, time_s, raw.tracker_from_body);
        correction->state = corrected_by_pose(before(turning), raw.tracker_from_body, noise).state;
      }
    }
    const bool fits = correction && correction->nis < pose_gate_;
    memory.misfits = fits || !known ? 0 : memory.misfits + 1;
    memory.doubt = fits ? 1 : contradicted;
    if (!known || memory.misfits > 1) {
      memory.state = started(memory.state, time_s, raw.tracker_from_body, noise, motion_);
      memory.systematic = raw.systematic;
      memory.seen = memory.fresh = true;
      memory.misfits = 0;
      memory.doubt = 1;
      return filtered;
    }
    if (fits) {
      memory.state = correction->state;
      memory.systematic = raw.systematic;
      memory.fresh = false;
      filtered.estimate = predicted_by(memory, time_s);
      return filtered;
    }
  }
  filtered.estimate = predicted_by(memory, time_s);
  filtered.status = filtered.estimate       ? PoseStatus::Predicted
                    : is_measured(measured) ? PoseStatus::Lost
                                            : measured.status;
  filtered.targets = 0;
  filtered.rejected.clear();
  filtered.rms_px = 0;
  return filtered;
}

ReadingUse FusedFilter::take_reading(Memory& memory, double time_s, const PlatformReading& reading) const {
  if (!alive(memory, time_s) || memory.fresh) return ReadingUse::Waits;
  const FusedState before = carried_to(memory.state, time_s, motion_, options_.correlation_s);
  if (!before.tracker_from_base) {
    memory.state = with_base_from(before, reading);
    return ReadingUse::Learnt;
  }
  const Correction correction = corrected_by_reading(before, reading);
  if (correction.nis < reading_gate_) {
    memory.state = correction.state;
    memory.refused = 0;
    return ReadingUse::Used;
  }
  if (++memory.refused < options_.slip_after) return ReadingUse::Refused;
  memory.state = without_base(memory.state);
  memory.refused = 0;
  return ReadingUse::Slipped;
}

FusedFilter::Outcome FusedFilter::take(Event event) {
  // At equal times the reading comes first, in whatever order they arrive: the frame's pose then has it.
  const auto earlier = [](const Event& a, const Event& b) {
    return a.time_s != b.time_s ? a.time_s < b.time_s : a.told.index() > b.told.index();
  };
  const auto place = recent_.insert(std::upper_bound(recent_.begin(), recent_.end(), event, earlier), event);
  Memory memory = place == recent_.begin() ? before_ : std::prev(place)->after;
  std::optional<Outcome> outcome;
  for (auto at = place; at != recent_.end(); ++at) {
    Outcome of_this{{}, ReadingUse::TooLate};
    if (const auto* pose = std::get_if<BodyPose>(&at->told)) {
      of_this.filtered = take_pose(memory, at->time_s, *pose);
    } else {
      of_this.use = take_reading(memory, at->time_s, std::get<PlatformReading>(at->told));
    }
    at->after = memory;
    if (!outcome) outcome = of_this;
  }
  while (recent_.front().time_s < recent_.back().time_s - options_.memory_s) {
    before_ = recent_.front().after;
    forgotten_until_s_ = recent_.front().time_s;
    recent_.pop_front();
  }
  return *outcome;
}

BodyPose FusedFilter::update_tracker(double time_s, const BodyPose& measured) {
  if (forgotten_until_s_ && time_s <= *forgotten_until_s_) {
    throw InputError(fmt::format(
        "a pose of {} s comes after measurements of {} s were closed; let memory_s = {} be longer, "
        "or give poses and readings more nearly in order of time",
        time_s, *forgotten_until_s_, options_.memory_s));
  }
  return take({time_s, measured, {}}).filtered;
}

ReadingUse FusedFilter::update_read_out(const PlatformReading& reading) {
  const double time_s = reading.time_s - options_.latency_s;
  if (forgotten_until_s_ && time_s <= *forgotten_until_s_) return ReadingUse::TooLate;
  return take({time_s, reading, {}}).use;
}

std::vector<BodyPose> fused(std::span<const TimedPose> tracked, std::span<const PlatformReading> readings,
                            const FusedOptions& options, const FilterOptions& motion,
                            const std::optional<TimeOffset>& known) {
  const double latency_s = known ? known->latency_s : options.latency_s;
  FusedFilter filter(options, motion, known);
  std::vector<BodyPose> poses;
  auto next = readings.begin();
  for (const auto& [time_s, pose] : tracked) {
    for (; next != readings.end() && next->time_s - latency_s <= time_s; ++next) {
      static_cast<void>(filter.update_read_out(*next));
    }
    poses.push_back(filter.update_tracker(time_s, pose));
  }
  return poses;
}

}  // namespace asterism
