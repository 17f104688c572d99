// SPDX-License-Identifier: Apache-2.0
// The whole measuring chain on one core: two 3-megapixel images in memory, 2 × 25 targets of three bodies, to
// poses.
#include <fmt/format.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/tracking/tracker.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

/// Targets spread over a plate of `size_mm`, no two pair distances alike.
Body plate(const std::string& name, int targets, double size_mm, double diameter_mm, std::uint64_t seed) {
  RandomStream random(seed, 0);
  Body body{name, {}};
  while (static_cast<int>(body.targets.size()) < targets) {
    const Vec3 at(random.uniform(-0.5, 0.5) * size_mm, random.uniform(-0.5, 0.5) * size_mm,
                  random.uniform(0, 0.15) * size_mm);
    bool apart = true;
    for (const Target& other : body.targets) apart = apart && (other.position - at).norm() > 5 * diameter_mm;
    if (apart)
      body.targets.push_back(
          {fmt::format("{}{}", name, body.targets.size() + 1), at, Vec3::UnitZ(), diameter_mm, {}});
  }
  return body;
}

/// Slowly swinging, facing the cameras.
Mover mover(const StereoRig& rig, Body body, double range_mm, const Vec3& aside_mm) {
  Sweep sweep;
  sweep.tracker_from_rest = tracker_from_frame({{0, 0, 0}, range_mm, rad_from_deg(75), 0}, rig);
  sweep.tracker_from_rest.translation += aside_mm;
  sweep.yaw = {rad_from_deg(5), 0.3, 0};
  sweep.pitch = {rad_from_deg(5), 0.2, 1};
  return {std::move(body), sweep};
}

Cell cell() {
  Cell c;
  c.name = "benchmark";
  c.rig = rig_of({2048, 1536, 3200, 1000, 2300});
  c.movers = {mover(c.rig, plate("a", 9, 480, 12, 3), 2400, {-180, -120, 0}),
              mover(c.rig, plate("b", 8, 300, 10, 5), 2200, {260, -120, 0}),
              mover(c.rig, plate("c", 8, 300, 10, 8), 2200, {80, 260, 0})};
  c.timing = {8, 50};
  return c;
}

struct Frames {
  std::vector<StereoImage> images;
  std::vector<FrameTruth> truth;
};

Frames simulated(const Cell& c) {
  const Simulator simulator(c, {});
  Frames frames;
  for (int i = 0; i < c.timing.frames; ++i) {
    SimulatedFrame frame = simulator.frame(i);
    frames.images.push_back(std::move(frame.image));
    frames.truth.push_back(std::move(frame.truth));
  }
  return frames;
}

/// All frames through a fresh tracker; what came of them.
std::vector<TrackedFrame> run(const Cell& c, const Frames& frames, int full_search_interval) {
  TrackerOptions options;
  options.full_search_interval = full_search_interval;
  Tracker tracker(c.rig, bodies_of(c), options);
  std::vector<TrackedFrame> tracked;
  for (const StereoImage& image : frames.images) tracked.push_back(tracker.process(image));
  return tracked;
}

void print_outcome(const Cell& c, const Frames& frames) {
  bench::Table table("What came of it",
                     {"body", "frames OK", "rotation RMS deg", "position RMS mm", "NEES/6"});
  const auto tracked = run(c, frames, 10);
  for (std::size_t body = 0; body < c.movers.size(); ++body) {
    double turn = 0, shift = 0, nees = 0;
    int ok = 0;
    for (std::size_t i = 0; i < tracked.size(); ++i) {
      const BodyPose& pose = tracked[i].poses[body];
      if (pose.status != PoseStatus::Ok) continue;
      const Vec6 error =
          difference(pose.estimate->tracker_from_body, frames.truth[i].tracker_from_body[body]);
      turn += error.head<3>().squaredNorm();
      shift += error.tail<3>().squaredNorm();
      nees += error.dot(*solve_positive(pose.estimate->covariance, error)) / 6;
      ++ok;
    }
    table.row({c.movers[body].body.name, fmt::format("{}/{}", ok, tracked.size()),
               fmt::format("{:.5f}", deg_from_rad(std::sqrt(turn / ok))),
               fmt::format("{:.4f}", std::sqrt(shift / ok)), fmt::format("{:.2f}", nees / ok)});
  }
  table.print_json();
}

}  // namespace

int main() {
  set_thread_count(1);
  const Cell c = cell();
  const Frames frames = simulated(c);
  print_outcome(c, frames);

  const StereoImage& image = frames.images.front();
  const TrackerOptions options;
  const BodyCatalogue catalogue(bodies_of(c));
  const TrackedFrame first = run(c, {{image}, {}}, 1).front();
  const auto labels_of = [&](std::size_t body) -> const BodyLabels& { return first.labels.at(body); };

  const double n = static_cast<double>(frames.images.size());
  const auto seconds = bench::median_seconds_in_turn({
      [&] {
        std::uint64_t sum = 0;
        for (const auto* picture : {&*image.left, &*image.right}) {
          for (const auto grey : std::get<Raster8>(*picture).pixels) sum += grey;
        }
        volatile std::uint64_t keep = sum;
        (void)keep;
      },
      [&] {
        (void)detect_targets(*image.left, options.detection);
        (void)detect_targets(*image.right, options.detection);
      },
      [&] { (void)triangulate(first.centres.left, first.centres.right, c.rig, options.triangulation); },
      [&] { (void)identify(first.points, catalogue, options.identification); },
      [&] {
        for (std::size_t body = 0; body < first.labels.size(); ++body) {
          const Body& shape = catalogue.bodies()[body];
          const auto views =
              labelled_views(labels_of(body), first.points, first.centres, shape, c.rig, options.views);
          (void)estimate_pose(shape, views, c.rig, labels_of(body).tracker_from_body, options.pose);
        }
      },
      [&] { (void)run(c, frames, 1); },
      [&] { (void)run(c, frames, 1000); },
  });
  bench::Table table(fmt::format("Milliseconds a stereo frame of 2 x 3.1 MP, {} + {} centres, one core",
                                 first.centres.left.size(), first.centres.right.size()),
                     {"stage", "ms"});
  const std::vector<std::string> names = {"read all pixels", "detect",      "triangulate", "identify",
                                          "poses",           "whole frame", "with windows"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.row({names[i], fmt::format("{:.3f}", 1e3 * seconds[i] / (i >= 5 ? n : 1.0))});
  }
  table.print_json();
  return 0;
}
