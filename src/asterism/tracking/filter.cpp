// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/filter.hpp"

#include "asterism/statistics/distributions.hpp"

namespace asterism {

namespace {

PoseEstimate estimate_of(const MotionState& state, const Mat6& systematic) {
  PoseEstimate estimate;
  estimate.tracker_from_body = state.tracker_from_body;
  estimate.covariance = state.covariance.topLeftCorner<6, 6>() + systematic;
  estimate.systematic = systematic;
  return estimate;
}

}  // namespace

std::optional<PoseEstimate> PoseFilter::predict(double time_s) const {
  if (!memory_ || time_s - memory_->state.time_s > options_.coast_max_s) return std::nullopt;
  MotionState state = predicted(memory_->state, time_s, options_).state;
  state.covariance *= doubt_;
  return estimate_of(state, memory_->systematic);
}

BodyPose PoseFilter::update(double time_s, const BodyPose& measured) {
  BodyPose filtered = measured;
  if (memory_ && time_s - memory_->state.time_s > options_.coast_max_s) memory_.reset();
  const bool seen = measured.status == PoseStatus::Ok || measured.status == PoseStatus::Partial;
  if (seen) {
    const PoseEstimate& raw = measured.estimate.value();
    const Mat6 noise = raw.covariance - raw.systematic;
    std::optional<Update> update;
    if (memory_)
      update = updated(memory_->state, memory_->fresh, time_s, raw.tracker_from_body, noise, options_);
    const bool fits = update && update->nis < chi_square_quantile(1 - options_.gate_probability, 6);
    misfits_ = fits || !memory_ ? 0 : misfits_ + 1;
    doubt_ = fits || !update ? 1
                             : contradiction(update->before.state.tracker_from_body,
                                             update->before.state.covariance.topLeftCorner<6, 6>(),
                                             raw.tracker_from_body);
    if (!memory_ || misfits_ > 1) {
      memory_ = Memory{first_state(time_s, raw.tracker_from_body, noise, options_), raw.systematic, true};
      misfits_ = 0;
      doubt_ = 1;
      return filtered;
    }
    if (fits) {
      *memory_ = {update->state, raw.systematic, false};
      filtered.estimate = estimate_of(memory_->state, memory_->systematic);
      return filtered;
    }
  }
  filtered.estimate = predict(time_s);
  filtered.status = filtered.estimate ? PoseStatus::Predicted : seen ? PoseStatus::Lost : measured.status;
  filtered.targets = 0;
  filtered.rejected.clear();
  filtered.rms_px = 0;
  return filtered;
}

}  // namespace asterism
