// SPDX-License-Identifier: Apache-2.0
// What one simulated stereo frame costs: a whole cell on all cores beside writing its images, and by stage on
// one thread for 3- and 12-megapixel cameras. And what one sweep of the scanner does.
#include <fmt/format.h>

#include <filesystem>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/simulation/render.hpp"
#include "asterism/simulation/scan.hpp"
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

/// The built-in cell, its part shining, with lamps in view and a lens that is sharp at one depth alone.
Cell engine_casing() {
  Cell cell = cell_of("engine_casing");
  if (cell.workpiece) cell.workpiece->level = 0.2;
  cell.lamps = {{"lamp", {650, -330, 3000}, 40, 2, 0.15, 60}, {"window", {700, 350, 2600}, 25, 1.5, 0.1, 40}};
  cell.light.specular = 0.9;
  cell.sensor.focus_mm = 2000;
  cell.sensor.lost_frames = 0;
  return cell;
}

/// Seconds a stereo frame when `frames` are made side by side on all cores, as a recording is.
double seconds_a_frame(const Simulator& simulator, std::size_t frames) {
  return bench::median_seconds(
             [&] {
               parallel_for(frames, [&](std::size_t i) { (void)simulator.frame(static_cast<int>(i)); });
             },
             5) /
         static_cast<double>(frames);
}

double seconds_to_write(const StereoImage& image, const std::string& ending) {
  const auto folder = std::filesystem::temp_directory_path();
  return bench::median_seconds(
      [&] {
        write_image(folder / ("asterism_bench_left" + ending), *image.left);
        write_image(folder / ("asterism_bench_right" + ending), *image.right);
      },
      5);
}

void measure_recording() {
  bench::Table table("the engine casing with its mesh, 2048 × 1536, all cores",
                     {"what", "ms a stereo frame", "stereo frames a second"});
  const auto row = [&](const char* what, double seconds) {
    table.row({what, fmt::format("{:.1f}", 1e3 * seconds), fmt::format("{:.1f}", 1 / seconds)});
  };
  const Cell cell = engine_casing();
  const Simulator images(cell, {});
  row("images in memory, with truth", seconds_a_frame(images, 16));
  Cell turning = cell;
  turning.sensor.exposure_s = 0.01;
  std::get<Sweep>(turning.movers[0].motion).yaw = {0.25, 2, 0};  // 180°/s in the middle of its swing
  row("the same, turning 180°/s, exposed for 10 ms", seconds_a_frame(Simulator(turning, {}), 8));
  SimulationOptions centres;
  centres.level = SimulationLevel::Centres;
  row("centres alone, with truth", seconds_a_frame(Simulator(cell, centres), 1000));
  const StereoImage image = images.frame(0).image;
  row("writing PNG, one core", seconds_to_write(image, ".png"));
  row("writing PGM, one core", seconds_to_write(image, ".pgm"));
  table.print_json();
}

/// The scanner square on before the casing's outer wall, with fixture and obstacles about.
void measure_scanner() {
  Cell cell = cell_of("engine_casing");
  const auto body = static_cast<std::size_t>(mover_index(cell, cell.scanner->body));
  Mat3 axes;  // looking along the workpiece's −x, its y downwards
  axes.col(0) = Vec3::UnitY();
  axes.col(1) = -Vec3::UnitZ();
  axes.col(2) = -Vec3::UnitX();
  const RigidMotion workpiece_from_scanner{quaternion_from_matrix(axes), {787, 0, 280}};
  const RigidMotion tracker_from_workpiece =
      poses_at(cell, 0)[static_cast<std::size_t>(mover_index(cell, cell.workpiece->body))] *
      cell.workpiece->carrier_from_solid;
  cell.movers[body].motion =
      at_rest(tracker_from_workpiece * workpiece_from_scanner * cell.scanner->body_from_scanner.inverse());
  cell.scanner->lines = 560;  // a finer sweep, so that what is measured is the rays
  cell.scanner->points_a_line = 496;
  const Stage stage = stage_of(cell);
  bench::Table table("scanner before the engine casing, one sweep of 0.6 mm steps",
                     {"threads", "points and rays that met the part", "million such rays a second"});
  for (const int threads : {1, 0}) {
    set_thread_count(threads);
    std::size_t rays = 0;
    const double seconds = bench::median_seconds(
        [&] {
          const SimulatedScan made = simulate_scan(stage, {1, 0, cell.scanner->sweep_s}, 1);
          rays = made.scan.in_scanner.size() + made.grazing + made.shadowed + made.beyond_range;
        },
        5);
    table.row({threads == 1 ? "1" : "all", fmt::format("{}", rays),
               fmt::format("{:.2f}", 1e-6 * static_cast<double>(rays) / seconds)});
  }
  table.print_json();
}

}  // namespace

int main() {
  measure_recording();
  measure_scanner();
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
