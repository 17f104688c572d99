// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/speed_trade.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/evaluation/blurred_centre.hpp"
#include "asterism/evaluation/streak_check.hpp"

namespace asterism {
namespace {

constexpr int kSettle = 5;  // frames until the filter knows the twist: not counted
constexpr std::uint32_t kPurpose = 0x75;

/// A target's image at the middle of an exposure and the speed at which it goes.
struct MovingImage {
  int target = 0;
  Side side = Side::Left;
  Ellipse image;
  double brightness = 1;
  Vec2 speed_px_s = Vec2::Zero();
};

struct MovingFrame {
  double time_s = 0;
  Shown shown;
  std::vector<MovingImage> images;
};

/// One run of frames of a swing, as yet without noise or exposure.
struct SwingRun {
  double speed_deg_s = 0, rate_hz = 0;
  std::vector<MovingFrame> frames;
};

Vec2 speed_of(const Cell& cell, const TargetTruth& target, double time_s) {
  constexpr double kStep_s = 1e-4;
  const Mover& mover = cell.movers[static_cast<std::size_t>(target.body)];
  const Vec3& place = mover.body.targets[static_cast<std::size_t>(target.target)].position;
  const auto at = [&](double t) {
    return project(cell.rig.lens(target.side),
                   cell.rig.camera_from_tracker(target.side) * pose_at(mover.motion, t) * place);
  };
  const auto before = at(time_s - kStep_s);
  const auto after = at(time_s + kStep_s);
  return before && after ? Vec2((after->px - before->px) / (2 * kStep_s)) : Vec2(Vec2::Zero());
}

MovingFrame moving_frame(const Simulator& simulator, std::size_t body, int number) {
  const SimulatedFrame frame = simulator.frame(number);
  MovingFrame moving{frame.time_s, shown_in(frame, body), {}};
  for (const TargetTruth& target : frame.truth.targets) {
    if (target.body != static_cast<int>(body) || !is_seen(target)) continue;
    moving.images.push_back({target.target, target.side, target.image, target.brightness,
                             speed_of(simulator.cell(), target, frame.time_s)});
  }
  return moving;
}

/// Through the fastest moment, or through a turning point; both halfway through the run.
SwingRun swing_run(const Cell& cell, double speed_deg_s, double rate_hz, bool turning,
                   const SpeedTradeOptions& options) {
  const std::size_t body = verified_body(cell);
  Cell swinging = swinging_cell(cell, speed_deg_s, options.swing_deg);
  swinging.timing.rate_hz = rate_hz;
  auto& sweep = std::get<Sweep>(swinging.movers[body].motion);
  const int frames = options.frames + kSettle;
  const double middle_s = (kSettle + 0.5 * options.frames) / rate_hz;
  sweep.roll.phase_rad = -2 * std::numbers::pi * sweep.roll.frequency_hz * middle_s;
  if (turning) sweep.roll.phase_rad += 0.5 * std::numbers::pi;
  SimulationOptions simulation;
  simulation.level = SimulationLevel::Centres;
  const Simulator simulator(swinging, simulation);
  SwingRun run{speed_deg_s, rate_hz, {}};
  for (int i = 0; i < frames; ++i) run.frames.push_back(moving_frame(simulator, body, i));
  return run;
}

double mean_radius(const SwingRun& run) {
  double sum = 0;
  double count = 0;
  for (const MovingFrame& frame : run.frames) {
    for (const MovingImage& image : frame.images) {
      sum += image.image.semi_minor;
      ++count;
    }
  }
  return count > 0 ? std::max(1.0, sum / count) : 5.0;
}

struct Noise {
  double sigma_px, exposure_s, longest_streak;
  const BlurredCentreBound& bound;
  std::uint64_t seed, run;
};

Mat2 root_of(const Mat2& c) {
  Mat2 l = Mat2::Zero();
  l(0, 0) = std::sqrt(c(0, 0));
  l(1, 0) = l(0, 0) > 0 ? c(1, 0) / l(0, 0) : 0;
  l(1, 1) = std::sqrt(std::max(0.0, c(1, 1) - l(1, 0) * l(1, 0)));
  return l;
}

/// Adds up what the centres of a row were like.
struct Streaks {
  double streak_px = 0, variance = 0, count = 0;
};

StereoCentres centres_of(const MovingFrame& frame, int number, const Noise& noise, Streaks& streaks) {
  StereoCentres centres{number, frame.time_s, {}, {}};
  // The same draws for every exposure: only what the streak makes of them differs.
  RandomStream random(noise.seed, noise.run << 20 | static_cast<std::uint64_t>(number), kPurpose);
  for (const MovingImage& image : frame.images) {
    const double x = random.normal();
    const Vec2 draw(x, random.normal());
    const Vec2 streak = noise.exposure_s * image.speed_px_s;
    if (streak.norm() > noise.longest_streak * 2 * image.image.semi_minor) continue;
    Centre centre;
    centre.ellipse = image.image;
    centre.covariance = noise.bound.grown(noise.sigma_px * noise.sigma_px * Mat2::Identity(), streak);
    centre.ellipse.centre += root_of(centre.covariance) * draw;
    centre.amplitude = 200 * image.brightness;
    (image.side == Side::Left ? centres.left : centres.right).push_back(centre);
    streaks.streak_px += streak.norm();
    streaks.variance += 0.5 * centre.covariance.trace();
    ++streaks.count;
  }
  return centres;
}

SpeedTradeRow track(std::span<const SwingRun> runs, std::span<const std::uint64_t> numbers, const Cell& cell,
                    double exposure_s, const SpeedTradeOptions& options, const TrackerOptions& tracking) {
  const std::size_t body = verified_body(cell);
  const std::vector<Vec3> points = points_in_question(cell);
  SpeedTradeRow row;
  row.speed_deg_s = runs.front().speed_deg_s;
  row.rate_hz = runs.front().rate_hz;
  row.exposure_s = exposure_s;
  const double radius = mean_radius(runs.front());
  const BlurredCentreBound bound(centre_bound(cell.sensor, cell.light), radius,
                                 4 * radius * options.longest_streak);
  Streaks streaks;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Noise noise{cell.noise.sigma_px, exposure_s, options.longest_streak, bound,
                      options.seed,        numbers[r]};
    Tracker tracker(cell.rig, {cell.movers[body].body}, tracking);
    for (std::size_t i = 0; i < runs[r].frames.size(); ++i) {
      const MovingFrame& frame = runs[r].frames[i];
      const TrackedFrame tracked = tracker.process(centres_of(frame, static_cast<int>(i), noise, streaks));
      if (i < kSettle) continue;
      count_frame(tracked.poses[0], frame.shown, points, {}, row.measured);
      count_frame(tracked.filtered[0], frame.shown, points, {}, row.filtered);
    }
  }
  if (streaks.count > 0) {
    row.streak_px = streaks.streak_px / streaks.count;
    row.sigma_px = std::sqrt(streaks.variance / streaks.count);
  }
  return row;
}

}  // namespace

void describe(SpeedTradeOptions& options, OptionVisitor& visit) {
  visit.number("swing_deg", options.swing_deg, {0.01, 180}, "to either side, at most the platform's stroke");
  visit.integer("frames", options.frames, {2, 100000}, "of each of two runs of a speed, exposure and rate");
  visit.integer("image_frames", options.image_frames, {0, 10000},
                "for each streak that is checked on images; 0 = none");
  visit.number("longest_streak", options.longest_streak, {0.01, 100},
               "share of a disc's diameter beyond which a streak is not found");
}

Cell swinging_cell(const Cell& cell, double speed_deg_s, double swing_deg) {
  Cell swinging = cell;
  Mover& mover = swinging.movers[verified_body(cell)];
  Sweep sweep;
  if (const auto* own = std::get_if<Sweep>(&mover.motion)) {
    sweep.tracker_from_rest = own->tracker_from_rest;
    sweep.pivot_mm = own->pivot_mm;
  } else {
    sweep.tracker_from_rest = pose_at(mover.motion, 0);
    if (cell.platform) sweep.pivot_mm = cell.platform->pivot_mm;
  }
  const double reach = cell.platform ? std::min(swing_deg, cell.platform->stroke.roll_deg) : swing_deg;
  sweep.roll.amplitude = rad_from_deg(reach);
  sweep.roll.frequency_hz = speed_deg_s / reach / (2 * std::numbers::pi);
  if (speed_deg_s == 0) sweep.roll.amplitude = 0;
  mover.motion = sweep;
  return swinging;
}

SpeedTrade speed_trade_of(const Cell& cell, const SpeedTradeOptions& options, const TrackerOptions& tracker,
                          const Progress& progress) {
  check_cell(cell, cell.name);
  const std::size_t rates = options.rates_hz.size();
  const std::size_t exposures = options.exposures_s.size();
  const std::size_t pairs = options.speeds_deg_s.size() * rates;
  SpeedTrade trade{std::vector<SpeedTradeRow>(pairs * exposures), {}, options};
  progress("trying speeds", 0, options.speeds_deg_s.size() + 1);
  parallel_for(pairs, [&](std::size_t pair) {
    const std::size_t speed = pair / rates;
    const std::size_t rate = pair % rates;
    std::vector<SwingRun> runs;
    for (const bool turning : {false, true}) {
      runs.push_back(swing_run(cell, options.speeds_deg_s[speed], options.rates_hz[rate], turning, options));
    }
    const std::vector<std::uint64_t> numbers = {2 * pair, 2 * pair + 1};
    for (std::size_t e = 0; e < exposures; ++e) {
      trade.rows[(speed * exposures + e) * rates + rate] =
          track(runs, numbers, cell, options.exposures_s[e], options, tracker);
    }
  });
  if (options.image_frames > 0) trade.checks = streak_checks(cell, options, tracker.detection);
  progress("trying speeds", 1, 1);
  return trade;
}

}  // namespace asterism
