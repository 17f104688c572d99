// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_run.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/read_out.hpp"

namespace asterism {
namespace {

// A rest is two equal keys at either end, so near to each other that the cubic through them stands still:
// what is left of the speed before is its share of kStop_s in the way to it.
constexpr double kStop_s = 1e-3;
constexpr double kShortest_s = 0.1;    // of any move
constexpr double kFramesAround = 2.5;  // a pass, in which its motion is met already
constexpr double kPeak = 1.7;          // a cubic from rest to rest is 1.5 times as fast in its middle
constexpr int kTurnKeys = 12;          // between two poses of the platform

/// Keys of one body, in order of time.
class Keys {
 public:
  void rest(double from_s, double to_s, const RigidMotion& at) {
    add(from_s, at);
    add(from_s + kStop_s, at);
    add(to_s - kStop_s, at);
    add(to_s, at);
  }
  void add(double time_s, const RigidMotion& at) {
    if (!motion_.keys.empty() && time_s <= motion_.keys.back().time_s) return;
    motion_.keys.push_back({time_s, at});
  }
  [[nodiscard]] const RigidMotion& last() const { return motion_.keys.back().tracker_from_body; }
  [[nodiscard]] bool empty() const { return motion_.keys.empty(); }
  [[nodiscard]] Motion motion() const { return motion_; }

 private:
  KeyedMotion motion_;
};

/// What a run needs to know of its cell.
struct Part {
  int carrier;  // the mover that carries the workpiece; −1 = none
  RigidMotion carrier_from_workpiece;
  Vec3 middle;       // in the workpiece's frame
  double radius_mm;  // of a ball that holds it
};

Part part_of(const Cell& cell) {
  const Solid& solid = *cell.workpiece;
  const MeshFacts facts = facts_of(*solid.surface);
  return {solid.body.empty() ? -1 : mover_index(cell, solid.body), solid.carrier_from_solid,
          (facts.lowest + facts.highest) / 2, facts.diagonal_mm() / 2};
}

double move_s(const ScanTask& task, const RigidMotion& from, const RigidMotion& to) {
  return std::max((to.translation - from.translation).norm() / task.speed_mm_s,
                  deg_from_rad(rotation_angle(to.rotation, from.rotation)) / task.rate_deg_s);
}

/// A platform's move that keeps its rates, whatever the pace.
double turn_s(const Cell& cell, const RigidMotion& from, const RigidMotion& to, double pace) {
  const double angle_deg = deg_from_rad(rotation_angle(to.rotation, from.rotation));
  const double way_mm = (to.translation - from.translation).norm();
  if (angle_deg < 1e-9 && way_mm < 1e-9) return 0;
  const Stroke stroke = cell.platform ? cell.platform->stroke : Stroke{};
  return std::max({cell.scan_task.turn_s / pace, kPeak * angle_deg / stroke.rate_deg_s,
                   kPeak * way_mm / stroke.speed_mm_s, kShortest_s});
}

/// Where the scanner's way from one place to another bends around a ball, if it does.
std::vector<RigidMotion> around(const RigidMotion& from, const RigidMotion& to, const Vec3& middle,
                                double radius_mm) {
  const Vec3 way = to.translation - from.translation;
  const double share =
      std::clamp((middle - from.translation).dot(way) / std::max(way.squaredNorm(), 1e-9), 0.0, 1.0);
  const Vec3 off = from.translation + share * way - middle;
  if (share == 0 || share == 1 || off.norm() >= radius_mm) return {};
  Vec3 out = off.norm() > 1 ? off : Vec3(way.unitOrthogonal());
  out.normalize();
  return {{from.rotation.slerp(0.5, to.rotation), middle + radius_mm * out}};
}

Vec3 angles_of(const PlatformPose& pose) {
  return {rad_from_deg(pose.yaw_deg), rad_from_deg(pose.pitch_deg), rad_from_deg(pose.roll_deg)};
}

class Run {
 public:
  Run(const Cell& cell, const ScanPlan& plan, const ScanRunOptions& options)
      : cell_(cell),
        plan_(plan),
        options_(options),
        part_(part_of(cell)),
        view_s_(options.view_s > 0 ? options.view_s : std::max(cell.scan_task.view_s, kShortest_s)),
        margin_s_(std::max(cell.scan_task.settle_s / options.pace, kFramesAround / cell.timing.rate_hz)),
        body_from_scanner_(cell.scanner->body_from_scanner) {
    const bool turned = cell.platform && part_.carrier >= 0 && cell.workpiece->body == cell.platform->body;
    if (turned)
      base_ = tracker_from_base(cell);
    else if (part_.carrier >= 0)
      base_ = poses_at(cell, 0)[static_cast<std::size_t>(part_.carrier)];
    carrier_.add(0, base_);
  }

  void visit(const PlannedView& view) {
    require(view.platform_pose < plan_.poses.size(), "a view's platform pose is one of the plan's");
    const RigidMotion carrier = plan_.poses[view.platform_pose].tracker_from_platform;
    const RigidMotion scanner = carrier * part_.carrier_from_workpiece * view.workpiece_from_scanner;
    const double from_s = go(view, carrier, scanner);
    turn(from_s, view.platform_pose);
    const double to_s = from_s + view_s_ + 2 * margin_s_;
    scanner_.rest(from_s, to_s, scanner * body_from_scanner_.inverse());
    sway(from_s, to_s, carrier);
    passes_.push_back(
        {options_.first_scan + static_cast<int>(passes_.size()), from_s + margin_s_, to_s - margin_s_});
    now_s_ = to_s;
    at_ = scanner;
  }

  [[nodiscard]] Cell finished() const {
    Cell cell = cell_;
    if (part_.carrier >= 0) cell.movers[static_cast<std::size_t>(part_.carrier)].motion = carrier_.motion();
    cell.movers[static_cast<std::size_t>(mover_index(cell, cell.scanner->body))].motion = scanner_.motion();
    cell.passes = passes_;
    cell.timing.frames = static_cast<int>(std::ceil(now_s_ * cell.timing.rate_hz)) + 1;
    return cell;
  }

 private:
  [[nodiscard]] RigidMotion swayed(const RigidMotion& carrier, double sign) const {
    if (options_.sway_deg == 0 || !cell_.platform) return carrier;
    const RigidMotion rest_from_carrier = base_.inverse() * carrier;
    const Vec3 pivot = cell_.platform->pivot_mm;
    const Quaternion turn = rotation_from_yaw_pitch_roll(sign * rad_from_deg(options_.sway_deg), 0, 0);
    return base_ * rotation_about(pivot, turn) * rest_from_carrier;
  }

  /// Carries the platform to its pose and the scanner to its view; returns when both are there.
  double go(const PlannedView& view, const RigidMotion& carrier, const RigidMotion& scanner) {
    const RigidMotion begin = swayed(carrier, -1);
    const double turn = turn_s(cell_, carrier_.last(), begin, options_.pace);
    if (scanner_.empty()) {  // the run begins
      carrier_.add(kStop_s, base_);
      return std::max(turn, kShortest_s);
    }
    const Vec3 back = Vec3(0, 0, -cell_.scanner->stand_off_mm);
    std::vector<RigidMotion> stations = {{at_.rotation, at_ * back}};
    const RigidMotion approach{scanner.rotation, scanner * back};
    const Vec3 middle = carrier * part_.carrier_from_workpiece * part_.middle;
    for (const RigidMotion& bend :
         around(stations.front(), approach, middle, part_.radius_mm + cell_.scanner->stand_off_mm))
      stations.push_back(bend);
    stations.push_back(approach);
    const bool near = (scanner.translation - at_.translation).norm() < cell_.scanner->stand_off_mm &&
                      view.platform_pose == pose_;
    if (near) stations.clear();
    stations.push_back(scanner);
    std::vector<double> lengths;
    double all_s = 0;
    RigidMotion last = at_;
    for (const RigidMotion& station : stations) {
      lengths.push_back(std::max(move_s(cell_.scan_task, last, station) / options_.pace, kShortest_s));
      all_s += lengths.back();
      last = station;
    }
    const double stretch = std::max(1.0, turn / all_s);  // the platform may take longer
    double time_s = now_s_;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      time_s += stretch * lengths[i];
      scanner_.add(time_s, stations[i] * body_from_scanner_.inverse());
    }
    pose_ = view.platform_pose;
    return now_s_ + stretch * all_s;
  }

  /// The platform's way to a pose that ends at a moment, by its own axes: the shortest turn between two poses
  /// at the end of their stroke would lead beyond it. It sags towards rest on the way, so that smoothing does
  /// not lead there either.
  void turn(double to_s, std::size_t pose) {
    const Vec3 from = angles_, to = angles_of(plan_.poses[pose]);
    angles_ = to;
    if (options_.sway_deg != 0 || !cell_.platform || part_.carrier < 0 || (to - from).norm() < 1e-9) return;
    const double begin_s = now_s_ + kStop_s;
    for (int i = 1; i < kTurnKeys; ++i) {
      const double u = static_cast<double>(i) / kTurnKeys, share = u * u * (3 - 2 * u);
      const Vec3 angles = (1 - 0.4 * share * (1 - share)) * (from + share * (to - from));
      const Quaternion turned = rotation_from_yaw_pitch_roll(angles[0], angles[1], angles[2]);
      carrier_.add(begin_s + u * (to_s - begin_s), base_ * rotation_about(cell_.platform->pivot_mm, turned));
    }
  }

  void sway(double from_s, double to_s, const RigidMotion& carrier) {
    if (options_.sway_deg == 0) return carrier_.rest(from_s, to_s, carrier);
    const RigidMotion begin = swayed(carrier, -1), end = swayed(carrier, 1);
    carrier_.add(from_s - kStop_s, begin);
    carrier_.add(from_s, begin);
    carrier_.add(to_s, end);
    carrier_.add(to_s + kStop_s, end);
  }

  const Cell& cell_;
  const ScanPlan& plan_;
  const ScanRunOptions& options_;
  Part part_;
  double view_s_, margin_s_;
  RigidMotion body_from_scanner_, base_;
  Keys carrier_, scanner_;
  Vec3 angles_ = Vec3::Zero();  // of the platform: yaw, pitch, roll
  std::vector<ScanPass> passes_;
  double now_s_ = 0;
  RigidMotion at_;  // the scanner, after the last view
  std::size_t pose_ = 0;
};

}  // namespace

void describe(ScanRunOptions& options, OptionVisitor& visit) {
  visit.number("view_s", options.view_s, {0, 1e5}, "time of one view; 0: as the cell's scan task says");
  visit.number("pace", options.pace, {0.1, 1000},
               "moves, turns and rests are so many times shorter than the scan task says");
  visit.number("sway_deg", options.sway_deg, {0, 45},
               "by how much the platform yaws to either side while it is scanned");
  visit.integer("first_scan", options.first_scan, {0, 1000000}, "number of the first scan");
}

Cell scan_run(Cell cell, const ScanPlan& plan, const ScanRunOptions& options) {
  if (!cell.scanner) throw InputError(cell.name, "has no [scanner]; no plan can be carried out");
  if (!cell.workpiece) throw InputError(cell.name, "has no [workpiece]; no plan can be carried out");
  if (plan.views.empty()) throw InputError("the plan", "has no views; there is nothing to carry out");
  cell.passes.clear();
  check_cell(cell, cell.name);
  Run run(cell, plan, options);
  for (const PlannedView& view : plan.views) run.visit(view);
  return run.finished();
}

}  // namespace asterism
