// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/simulate.hpp"

#include <fmt/format.h>

#include <utility>

#include "asterism/simulation/centres.hpp"
#include "asterism/simulation/render.hpp"
#include "asterism/simulation/sensor.hpp"
#include "asterism/simulation/streams.hpp"
#include "asterism/simulation/truth.hpp"

namespace asterism {

void describe(SimulationOptions& options, OptionVisitor& visit) {
  visit.choice_of("level", options.level, {"images", "centres"}, "what to make: images, or centres alone");
  visit.number("sigma_px", options.sigma_px, {0, 100},
               "noise of each centre along each axis (level centres)");
  visit.number("dropout", options.dropout, {0, 1},
               "share of visible targets missed at random (level centres)");
  visit.number("clutter", options.clutter, {0, 1e5}, "mean number of false centres an image (level centres)");
}

Simulator::Simulator(Cell cell, const SimulationOptions& options)
    : stage_(stage_of(std::move(cell))), options_(options) {
  if (options_.level == SimulationLevel::Centres) return;
  const Cell& made = stage_.cell;
  for (const Mover& mover : made.movers) {
    for (const Target& target : mover.body.targets) {
      if (target.diameter_mm) continue;
      throw InputError(
          made.name,
          fmt::format("target `{}` of body `{}` has no diameter_mm; without it no image can be drawn",
                      target.id, mover.body.name));
    }
  }
  left_gain_ = fixed_pattern(made.sensor, made.rig.left, Side::Left, options_.seed);
  right_gain_ = fixed_pattern(made.sensor, made.rig.right, Side::Right, options_.seed);
}

bool Simulator::loses(int number, Side side) const {
  return stream_of(options_.seed, number, side, Purpose::LostFrames).uniform() <
         stage_.cell.sensor.lost_frames;
}

Image Simulator::picture(int number, Side side) const {
  const double time_s = number / stage_.cell.timing.rate_hz;
  const Raster<float> light = render_light(stage_, side, time_s, options_.seed, number);
  return expose(light, side == Side::Left ? left_gain_ : right_gain_, stage_.cell.sensor, side, options_.seed,
                number);
}

SimulatedFrame Simulator::frame(int number) const {
  SimulatedFrame made;
  made.frame = number;
  made.time_s = number / stage_.cell.timing.rate_hz;
  made.truth = truth_of(stage_, made.time_s);
  made.image.frame = made.centres.frame = number;
  made.image.time_s = made.centres.time_s = made.time_s;
  for (const Side side : {Side::Left, Side::Right}) {
    if (loses(number, side)) continue;
    if (options_.level == SimulationLevel::Images) {
      (side == Side::Left ? made.image.left : made.image.right) = picture(number, side);
    } else {
      (side == Side::Left ? made.centres.left : made.centres.right) =
          simulate_centres(stage_.cell, made.truth, side, number, options_);
    }
  }
  return made;
}

}  // namespace asterism
