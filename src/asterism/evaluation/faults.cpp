// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/faults.hpp"

#include "asterism/evaluation/verified_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/camera/two_view.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/core/random.hpp"

namespace asterism {
namespace {

constexpr double kGolden = 0.6180339887498949;

enum class Purpose : std::uint32_t { Map = 0x71, Knock };

Vec3 normal_vector(RandomStream& random) {
  const double x = random.normal();
  const double y = random.normal();
  return {x, y, random.normal()};
}

/// Lower triangular L with L Lᵀ = C; zero where C is not positive definite.
Mat3 root_of(const Mat3& c) {
  Mat3 l = Mat3::Zero();
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col <= row; ++col) {
      double sum = c(row, col);
      for (int k = 0; k < col; ++k) sum -= l(row, k) * l(col, k);
      if (row == col) {
        l(row, col) = std::sqrt(std::max(0.0, sum));
      } else {
        l(row, col) = l(col, col) > 0 ? sum / l(col, col) : 0.0;
      }
    }
  }
  return l;
}

/// The runs of a cell, each with its own number.
class Runs {
 public:
  Runs(const Cell& cell, const RobustnessOptions& options)
      : cell_(cell), options_(options), body_(verified_body(cell)), learnt_(bodies_as_learnt(cell)) {}

  /// A run with nothing wrong yet; the caller adds the fault.
  FaultRun& add(std::string fault, std::string variant = "") {
    const auto number = static_cast<std::uint64_t>(runs_.size());
    FaultRun run;
    run.fault = std::move(fault);
    run.variant = std::move(variant);
    run.cell = cell_;
    run.cell.faults.clear();
    run.simulation.level = SimulationLevel::Centres;
    run.simulation.seed = options_.seed + number;
    run.simulation.sigma_px = cell_.noise.sigma_px;
    run.frames = options_.frames;
    // Runs of one fault start all over the motion, evenly however many they are.
    if (runs_.empty() || runs_.back().fault != run.fault) of_fault_ = 0;
    const double share = kGolden * of_fault_++;
    const int room = std::max(0, cell_.timing.frames - options_.frames);
    run.first_frame = static_cast<int>((share - std::floor(share)) * room);
    move_off_map(run.cell, number);
    runs_.push_back(std::move(run));
    return runs_.back();
  }

  FaultRun& add_on_images(std::string fault, std::string variant = "") {
    FaultRun& run = add(std::move(fault), std::move(variant));
    run.simulation.level = SimulationLevel::Images;
    run.frames = options_.image_frames;
    return run;
  }

  [[nodiscard]] const Body& body() const { return cell_.movers[body_].body; }
  [[nodiscard]] std::size_t body_index() const { return body_; }
  [[nodiscard]] std::vector<FaultRun> take() { return std::move(runs_); }

 private:
  void move_off_map(Cell& cell, std::uint64_t number) const {
    RandomStream random(options_.seed, number, static_cast<std::uint32_t>(Purpose::Map));
    for (std::size_t b = 0; b < cell.movers.size(); ++b) {
      auto& targets = cell.movers[b].body.targets;
      for (std::size_t t = 0; t < targets.size(); ++t) {
        targets[t].position += root_of(learnt_[b].targets[t].covariance.value()) * normal_vector(random);
      }
    }
  }

  const Cell& cell_;
  const RobustnessOptions& options_;
  std::size_t body_;
  std::vector<Body> learnt_;
  std::vector<FaultRun> runs_;
  int of_fault_ = 0;
};

void lose(FaultRun& run, const Body& body, std::size_t target) {
  run.cell.faults.push_back({FaultKind::FallsOff, body.name, body.targets[target].id, -1, Vec3::Zero()});
}

void add_losses(Runs& runs) {
  const Body& body = runs.body();
  const std::size_t count = body.targets.size();
  for (std::size_t i = 0; i < count; ++i) lose(runs.add("one target lost", body.targets[i].id), body, i);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      FaultRun& run = runs.add("two targets lost", body.targets[i].id + " + " + body.targets[j].id);
      lose(run, body, i);
      lose(run, body, j);
    }
  }
}

void add_knocks(Runs& runs, double mm, const RobustnessOptions& options) {
  const Body& body = runs.body();
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    FaultRun& run = runs.add(fmt::format("a target knocked by {} mm", mm), body.targets[i].id);
    RandomStream random(options.seed, i, static_cast<std::uint32_t>(Purpose::Knock));
    run.shift_mm = mm * normal_vector(random).normalized();
    run.cell.faults.push_back({FaultKind::Knocked, body.name, body.targets[i].id, -1, run.shift_mm});
    run.knocked = static_cast<int>(i);
  }
}

double middle_of(const FaultRun& run) {
  return (run.first_frame + 0.5 * run.frames) / run.cell.timing.rate_hz;
}

Vec3 targets_middle(const Body& body) {
  Vec3 sum = Vec3::Zero();
  for (const Target& target : body.targets) sum += target.position;
  return sum / static_cast<double>(body.targets.size());
}

/// The other body is carried sideways across the first one's targets, a fifth of the way nearer the cameras.
void cross(FaultRun& run, std::size_t body, std::size_t other) {
  const double rate = run.cell.timing.rate_hz;
  const RigidMotion first = pose_at(run.cell.movers[body].motion, middle_of(run));
  const Vec3 eye = 0.5 * run.cell.rig.camera_from_tracker(Side::Right).inverse().translation;
  const Vec3 there = first * targets_middle(run.cell.movers[body].body);
  Mover& mover = run.cell.movers[other];
  const Vec3 across = run.cell.rig.camera_from_tracker(Side::Right).inverse().translation.normalized();
  const Quaternion attitude = pose_at(mover.motion, middle_of(run)).rotation;
  KeyedMotion motion;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 at = eye + 0.8 * (there - eye) + side * 400 * across;
    const double time_s = (run.first_frame + (side > 0 ? run.frames : 0)) / rate;
    motion.keys.push_back({time_s, {attitude, at - attitude * targets_middle(mover.body)}});
  }
  mover.motion = motion;
}

void add_image_faults(Runs& runs) {
  for (const double level : {0.2, 0.4}) {
    runs.add_on_images("backlight", fmt::format("background at {} of full scale", level))
        .cell.light.background_level = level;
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(2, runs.body().targets.size()); ++i) {
    FaultRun& run = runs.add_on_images("a lamp in view", "beside " + runs.body().targets[i].id);
    const Mover& mover = run.cell.movers[runs.body_index()];
    const Vec3 target = pose_at(mover.motion, middle_of(run)) * mover.body.targets[i].position;
    // Farther from the cameras than the target, so that it does not hide it.
    run.cell.lamps.push_back({"lamp", target + Vec3(45, 0, 60), 15, 3, 0.15, 40});
  }
  for (const double glints : {20.0, 60.0}) {
    runs.add_on_images("glints", fmt::format("{} an image", glints)).cell.light.glints = glints;
  }
  runs.add_on_images("the part shines").cell.light.specular = 1;
}

}  // namespace

void describe(RobustnessOptions& options, OptionVisitor& visit) {
  visit.integer("frames", options.frames, {1, 100000}, "of each run at the level of centres");
  visit.integer("repeats", options.repeats, {1, 10000}, "runs of a fault that has no variants of its own");
  visit.integer("image_frames", options.image_frames, {0, 100000}, "of each run on images; 0 = no images");
  visit.number("loss", options.loss, {0, 1}, "share of targets missed at random");
  visit.number("lost_frames", options.lost_frames, {0, 1}, "share of frames each camera loses");
  visit.number("wrong_mm", options.wrong_mm, {0, 1e6}, "a pose farther off at a named point is wrong");
  visit.number("wrong_deg", options.wrong_deg, {0, 180}, "a pose farther off in rotation is wrong");
}

std::size_t verified_body(const Cell& cell) { return verification_of(cell).mover; }

std::vector<Vec3> points_in_question(const Cell& cell) {
  const Body& body = cell.movers[verified_body(cell)].body;
  std::vector<Vec3> points;
  for (const WorkPoint& point : cell.verification.points) points.push_back(point.in_body_mm);
  if (points.empty() && cell.layout && cell.layout->body == body.name) {
    for (const WorkPoint& point : cell.layout->points) points.push_back(point.in_body_mm);
  }
  if (points.empty()) points.push_back(targets_middle(body));
  return points;
}

std::vector<Body> bodies_as_learnt(const Cell& cell) {
  std::vector<Body> bodies = bodies_of(cell);
  const double variance = cell.noise.map_sigma_mm * cell.noise.map_sigma_mm;
  for (Body& body : bodies) {
    for (Target& target : body.targets) {
      if (!target.covariance) target.covariance = variance * Mat3::Identity();
    }
  }
  return bodies;
}

std::vector<FaultRun> fault_runs(const Cell& cell, const RobustnessOptions& options) {
  Runs runs(cell, options);
  const auto repeated = [&](const std::string& fault, const auto& change) {
    for (int i = 0; i < options.repeats; ++i) change(runs.add(fault));
  };
  repeated("none", [](FaultRun&) {});
  add_losses(runs);
  repeated(fmt::format("{:.0f} % of targets missed", 100 * options.loss),
           [&](FaultRun& run) { run.simulation.dropout = options.loss; });
  for (const double mm : {0.2, 1.0, 5.0}) add_knocks(runs, mm, options);
  for (const double ghosts : {20.0, 60.0}) {
    repeated(fmt::format("{:.0f} false centres an image", ghosts),
             [&](FaultRun& run) { run.simulation.clutter = ghosts; });
  }
  repeated(fmt::format("{:.0f} % of frames lost by each camera", 100 * options.lost_frames),
           [&](FaultRun& run) { run.cell.sensor.lost_frames = options.lost_frames; });
  const std::size_t body = verified_body(cell);
  if (cell.movers.size() > 1) {
    repeated("another body crosses before it", [&](FaultRun& run) { cross(run, body, body == 0 ? 1 : 0); });
  }
  if (options.image_frames > 0) add_image_faults(runs);
  return runs.take();
}

}  // namespace asterism
