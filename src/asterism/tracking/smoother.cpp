// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/smoother.hpp"

#include <fmt/format.h>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

/// One measured frame of an unbroken stretch.
struct Step {
  std::size_t frame;
  Prediction before;  // the measurement, from the step before
  MotionState after;
};

/// Runs back over a stretch; each step's `after` becomes the smoothed state.
void smooth_back(std::vector<Step>& steps) {
  for (std::size_t i = steps.size(); i-- > 1;) {
    const Prediction& next = steps[i].before;
    MotionState& here = steps[i - 1].after;
    const auto inverse = inverse_positive(MatX(next.state.covariance));
    // A covariance without digits left says that nothing is to be learnt from what came later.
    if (!inverse) continue;
    const Mat12 gain = here.covariance * next.transition.transpose() * *inverse;
    const MotionState smoothed = moved(here, gain * difference(steps[i].after, next.state));
    const Mat12 covariance =
        here.covariance + gain * (steps[i].after.covariance - next.state.covariance) * gain.transpose();
    here = smoothed;
    here.covariance = 0.5 * (covariance + covariance.transpose());
  }
}

void smooth_body(std::span<const TrackedFrame> frames, std::size_t body, const FilterOptions& options,
                 std::vector<std::vector<BodyPose>>& out) {
  const double gate = chi_square_quantile(1 - options.gate_probability, 6);
  std::vector<Step> steps;
  const auto finish = [&] {
    smooth_back(steps);
    for (const Step& step : steps) {
      PoseEstimate& estimate = *out[step.frame][body].estimate;
      estimate.tracker_from_body = step.after.tracker_from_body;
      estimate.covariance = step.after.covariance.topLeftCorner<6, 6>() + estimate.systematic;
    }
    steps.clear();
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const BodyPose& raw = frames[i].poses[body];
    out[i].push_back(raw);
    if (raw.status != PoseStatus::Ok && raw.status != PoseStatus::Partial) continue;
    const double time_s = frames[i].centres.time_s;
    const RigidMotion& measured = raw.estimate.value().tracker_from_body;
    const Mat6 noise = raw.estimate->covariance - raw.estimate->systematic;
    if (!steps.empty() && time_s - steps.back().after.time_s <= options.coast_max_s) {
      const Update update = updated(steps.back().after, steps.size() == 1, time_s, measured, noise, options);
      if (update.nis < gate) {
        steps.push_back({i, update.before, update.state});
        continue;
      }
    }
    finish();
    steps.push_back({i, {}, first_state(time_s, measured, noise, options)});
  }
  finish();
}

}  // namespace

std::vector<std::vector<BodyPose>> smooth(std::span<const TrackedFrame> frames,
                                          const FilterOptions& options) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const StereoCentres& here = frames[i].centres;
    const StereoCentres& last = frames[i - 1].centres;
    if (here.time_s < last.time_s) {
      throw InputError(fmt::format(
          "frame {}: its time {} s is before that of frame {} ({} s); frames must come in order of time",
          here.frame, here.time_s, last.frame, last.time_s));
    }
    require(frames[i].poses.size() == frames[0].poses.size(), "each frame has a pose for each body");
  }
  std::vector<std::vector<BodyPose>> out(frames.size());
  if (frames.empty()) return out;
  for (std::size_t body = 0; body < frames[0].poses.size(); ++body) smooth_body(frames, body, options, out);
  return out;
}

}  // namespace asterism
