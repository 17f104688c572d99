// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/fusion_runs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/simulation/centres.hpp"
#include "asterism/simulation/read_out.hpp"
#include "asterism/simulation/truth.hpp"

namespace asterism {

FilterOptions filter_suited_to(const Motion& motion, double seconds, double coast_s,
                               const FilterOptions& options) {
  constexpr int kSteps = 1000;
  constexpr double kLeastWander = 0.1;  // °/s and mm/s in a second: nothing stands quite still
  const double step_s = seconds / kSteps;
  const auto twist = [&](double time_s) {
    return twist_between(pose_at(motion, time_s), pose_at(motion, time_s + step_s), step_s);
  };
  double turning = 0, moving = 0;  // mean square acceleration about and along one axis
  for (int i = 0; i + 2 <= kSteps; ++i) {
    const Vec6 acceleration = (twist((i + 1) * step_s) - twist(i * step_s)) / step_s;
    turning += acceleration.head<3>().squaredNorm() / (3 * (kSteps - 1));
    moving += acceleration.tail<3>().squaredNorm() / (3 * (kSteps - 1));
  }
  FilterOptions suited = options;
  suited.rate_wander_deg_s = std::max(kLeastWander, deg_from_rad(std::sqrt(0.75 * turning * coast_s)));
  suited.speed_wander_mm_s = std::max(kLeastWander, std::sqrt(0.75 * moving * coast_s));
  return suited;
}

FusionBench::FusionBench(const Cell& cell, const FusionOptions& options)
    : cell_(cell),
      options_(options),
      mover_((static_cast<void>(tracker_from_base(cell)),  // throws when there is no platform
              static_cast<std::size_t>(mover_index(cell, cell.platform->body)))),
      filter_(options.tracker.filter),
      tracker_(cell.rig, bodies_of(cell), options.tracker),
      frames_(static_cast<std::size_t>(cell.timing.frames)) {
  const Stage stage = stage_of(cell);
  for (int i = 0; i < cell.timing.frames; ++i) times_s_.push_back(i / cell.timing.rate_hz);
  parallel_for(frames_.size(), [&](std::size_t i) { frames_[i] = truth_of(stage, times_s_[i]); });
  if (options.suit_filter) {
    filter_ = filter_suited_to(cell.movers[mover_].motion, times_s_.back(), options.occlusion_s, filter_);
  }
  for (const FrameTruth& frame : frames_) truth_.push_back(frame.tracker_from_body[mover_]);
}

std::vector<StereoCentres> FusionBench::centres(std::uint64_t seed) const {
  SimulationOptions simulation;
  simulation.level = SimulationLevel::Centres;
  simulation.seed = seed;
  simulation.sigma_px = cell_.noise.sigma_px;
  std::vector<StereoCentres> seen;
  for (std::size_t i = 0; i < times_s_.size(); ++i) {
    const int number = static_cast<int>(i);
    seen.push_back({number, times_s_[i], simulate_centres(cell_, frames_[i], Side::Left, number, simulation),
                    simulate_centres(cell_, frames_[i], Side::Right, number, simulation)});
  }
  return seen;
}

std::vector<TimedPose> FusionBench::tracked(const std::vector<StereoCentres>& seen,
                                            const BlindFrames& blind) const {
  Tracker tracker = tracker_;
  std::vector<TimedPose> poses;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool dark = i >= blind.from && i < blind.to;
    StereoCentres centres = dark ? StereoCentres{seen[i].frame, seen[i].time_s, {}, {}} : seen[i];
    poses.push_back({times_s_[i], tracker.process(std::move(centres)).poses[mover_]});
  }
  return poses;
}

FusionRuns FusionBench::run(int number, std::span<const BlindFrames> occlusions) const {
  const std::uint64_t seed = options_.seed + static_cast<std::uint64_t>(number);
  const std::vector<PlatformReading> readings = simulate_read_out(cell_, seed);
  const std::vector<StereoCentres> seen = centres(seed);
  TimeOffsetOptions search;
  search.correlation_s = cell_.platform->read_out.correlation_s;
  FusedOptions fusing = options_.fused;
  fusing.correlation_s = search.correlation_s;

  FusionRuns runs;
  for (const BlindFrames& blind : occlusions) {
    const std::vector<TimedPose> poses = tracked(seen, blind);
    if (runs.by_occlusion.empty()) {
      runs.offset = estimate_time_offset(poses, readings, search);
      if (runs.offset) {
        fusing.latency_s = runs.offset->latency_s;
        fusing.latency_sigma_s = runs.offset->sigma_s;
      }
    }
    runs.by_occlusion.push_back({fused(poses, {}, fusing, filter_), fused(poses, readings, fusing, filter_)});
  }
  return runs;
}

}  // namespace asterism
