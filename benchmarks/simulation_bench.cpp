// SPDX-License-Identifier: Apache-2.0
// What one simulated stereo frame costs, by stage, for 3- and 12-megapixel cameras.
#include <fmt/format.h>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/simulation/render.hpp"
#include "asterism/simulation/sensor.hpp"
#include "asterism/simulation/simulate.hpp"
#include "bench.hpp"

namespace {

using namespace asterism;

/// `targets` discs of 12 mm on a plate 0.7 m wide, 2.3 m away, and three solids in front of it.
Cell crowded_cell(int width_px, int height_px, double focal_px, int targets) {
  Cell cell;
  cell.name = "crowded";
  cell.rig = rig_of({width_px, height_px, focal_px, 1000, 2300});
  Body body{"plate", {}};
  RandomStream random(1, 0);
  for (int i = 0; i < targets; ++i) {
    const Vec3 place{random.uniform(-350, 350), random.uniform(-250, 250), random.uniform(-20, 20)};
    body.targets.push_back({fmt::format("T{}", i), place, Vec3::UnitZ(), 12.0, {}});
  }
  Sweep sweep;
  sweep.tracker_from_rest = tracker_from_frame({{0, 0, 0}, 2300, rad_from_deg(70), 0}, cell.rig);
  sweep.yaw = {rad_from_deg(15), 0.2, 0};
  cell.movers.push_back({body, sweep});
  const RigidMotion near_by = tracker_from_frame({{0, 0, 0}, 1800, rad_from_deg(70), 0}, cell.rig);
  cell.obstacles.push_back({"rod", Capsule{{-200, -300, 0}, {-150, 300, 0}, 6}, "", near_by, 0.06});
  cell.obstacles.push_back({"box", Box{{120, 80, 40}}, "", near_by, 0.05});
  cell.obstacles.push_back({"cone", Frustum{50, 20, 120}, "plate", {}, 0.04});
  return cell;
}

void measure(bench::Table& table, const char* camera, const Cell& cell) {
  const Simulator simulator(cell, {});
  const Stage stage = stage_of(cell);
  const Raster<float> gain = fixed_pattern(cell.sensor, cell.rig.left, Side::Left, 1);
  const Raster<float> light = render_light(stage, Side::Left, 0.4, 1, 8);
  int frame = 0;
  const double draw = bench::median_seconds([&] { (void)render_light(stage, Side::Left, 0.4, 1, 8); }, 7);
  const double noise =
      bench::median_seconds([&] { (void)expose(light, gain, cell.sensor, Side::Left, 1, ++frame); }, 7);
  const double whole = bench::median_seconds([&] { (void)simulator.frame(++frame); }, 7);
  table.row({camera, fmt::format("{}", cell.movers[0].body.targets.size()), fmt::format("{:.1f}", 1e3 * draw),
             fmt::format("{:.1f}", 1e3 * noise), fmt::format("{:.1f}", 1e3 * whole)});
}

}  // namespace

int main() {
  asterism::bench::Table table("one simulated stereo frame, one thread",
                               {"camera", "targets", "light, one camera (ms)", "sensor, one camera (ms)",
                                "whole stereo frame with truth (ms)"});
  asterism::set_thread_count(1);
  measure(table, "2048 × 1536", crowded_cell(2048, 1536, 3200, 6));
  measure(table, "2048 × 1536", crowded_cell(2048, 1536, 3200, 50));
  measure(table, "4096 × 3000", crowded_cell(4096, 3000, 4638, 50));
  table.print_json();
  return 0;
}
