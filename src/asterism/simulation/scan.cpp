// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/simulation/rays.hpp"
#include "asterism/simulation/streams.hpp"

namespace asterism {
namespace {

constexpr double kLift_mm =
    0.02;  // off the surface before the camera looks back: well above a ray's rounding

/// Lines of light by where they cross the stand-off, x in the scanner's frame. The field is a pyramid from
/// the scanner's origin, the light comes from beside it: to light all of the field at every depth it sweeps
/// somewhat more than its width at the stand-off.
struct Sheets {
  double first_x_mm = 0, step_mm = 0;
  int count = 0;
  double line_s = 0;  // from line to line; 0: all at one moment

  [[nodiscard]] double x_mm(int line) const { return first_x_mm + line * step_mm; }
};

Sheets sheets_of(const Scanner& scanner) {
  const double half = scanner.field_width_mm / 2, projector = -scanner.baseline_mm / 2;
  double low = -half, high = half;
  for (const double z : {scanner.near_mm, scanner.far_mm}) {
    const double share = z / scanner.stand_off_mm;
    low = std::min(low, projector + (-half * share - projector) / share);
    high = std::max(high, projector + (half * share - projector) / share);
  }
  Sheets sheets;
  sheets.step_mm = scanner.field_width_mm / scanner.lines;
  sheets.count = std::max(1, static_cast<int>(std::lround((high - low) / sheets.step_mm)));
  sheets.first_x_mm = (low + high - (sheets.count - 1) * sheets.step_mm) / 2;
  sheets.line_s = sheets.count > 1 ? scanner.sweep_s / (sheets.count - 1) : scanner.sweep_s;
  return sheets;
}

/// Where everything was when one line was lit.
struct Moment {
  double time_s = 0;
  RigidMotion workpiece_from_scanner;
  std::vector<RigidMotion> solid_from_scanner;     // carriers of the stage's solids
  std::vector<RigidMotion> obstacle_from_scanner;  // the frames of the obstacles' shapes
};

RigidMotion carrier_from_scanner(const std::vector<RigidMotion>& poses, int carrier,
                                 const RigidMotion& tracker_from_scanner) {
  if (carrier < 0) return tracker_from_scanner;
  return poses[static_cast<std::size_t>(carrier)].inverse() * tracker_from_scanner;
}

/// What a scanner can meet in a cell.
struct Scene {
  const Stage& stage;
  const Scanner& scanner;
  RigidMotion body_from_scanner;  // the true one
  int scanner_body;
  Vec3 projector, camera;  // in the scanner's frame

  Scene(const Stage& of, std::uint64_t seed)
      : stage(of),
        scanner(*of.cell.scanner),
        body_from_scanner(true_body_from_scanner(scanner, seed)),
        scanner_body(mover_index(of.cell, scanner.body)),
        projector(-scanner.baseline_mm / 2, 0, 0),
        camera(scanner.baseline_mm / 2, 0, 0) {}

  [[nodiscard]] Moment at(double time_s) const {
    const std::vector<RigidMotion> poses = poses_at(stage.cell, time_s);
    const RigidMotion tracker_from_scanner =
        poses[static_cast<std::size_t>(scanner_body)] * body_from_scanner;
    Moment moment;
    moment.time_s = time_s;
    for (const StageSolid& solid : stage.solids)
      moment.solid_from_scanner.push_back(carrier_from_scanner(poses, solid.carrier, tracker_from_scanner));
    for (const Obstacle& one : stage.cell.obstacles) {
      const int carrier = one.body.empty() ? -1 : mover_index(stage.cell, one.body);
      moment.obstacle_from_scanner.push_back(one.carrier_from_shape.inverse() *
                                             carrier_from_scanner(poses, carrier, tracker_from_scanner));
    }
    moment.workpiece_from_scanner =
        stage.cell.workpiece->carrier_from_solid.inverse() * moment.solid_from_scanner.front();
    return moment;
  }

  /// By anything but the workpiece and what the scanner carries; both ends in the scanner's frame.
  [[nodiscard]] bool in_shadow(const Moment& moment, const Vec3& from, const Vec3& to) const {
    for (std::size_t i = 1; i < stage.solids.size(); ++i) {
      const StageSolid& solid = stage.solids[i];
      if (solid.carrier == scanner_body) continue;
      const RigidMotion& solid_from_scanner = moment.solid_from_scanner[i];
      const Vec3 a = solid_from_scanner * from, b = solid_from_scanner * to;
      if (out_of_reach(solid.slabs, a, Vec3::UnitZ(), 0, b)) continue;
      if (solid.tree.blocked(a, b)) return true;
    }
    for (std::size_t i = 0; i < stage.cell.obstacles.size(); ++i) {
      const Obstacle& one = stage.cell.obstacles[i];
      if (one.body == scanner.body) continue;
      const RigidMotion& shape_from_scanner = moment.obstacle_from_scanner[i];
      if (blocks(one.shape, shape_from_scanner * from, shape_from_scanner * to)) return true;
    }
    return false;
  }
};

/// Where a ray of light first falls on the workpiece, in the scanner's frame.
struct Spot {
  Vec3 at, normal;  // the normal towards the projector
};

std::optional<Spot> spot_of(const Scene& scene, const Moment& moment, const Vec3& end) {
  const RigidMotion& carrier_from_scanner = moment.solid_from_scanner.front();
  const Vec3 from = carrier_from_scanner * scene.projector;
  const Vec3 way = carrier_from_scanner * end - from;
  const auto hit = scene.stage.solids.front().tree.first_hit(from, from + way);
  if (!hit) return std::nullopt;
  // The ray is cast in single precision: its meeting with the triangle's plane is worked out anew.
  const Solid& workpiece = *scene.stage.cell.workpiece;
  const Vec3 corner = workpiece.carrier_from_solid * workpiece.surface->corner(hit->triangle, 0);
  const double slope = hit->normal.dot(way);
  if (std::abs(slope) < 1e-6 * way.norm()) return std::nullopt;  // along the surface
  const Vec3 at = from + way * (hit->normal.dot(corner - from) / slope);
  const Quaternion scanner_from_carrier = carrier_from_scanner.rotation.conjugate();
  return Spot{scanner_from_carrier * (at - carrier_from_scanner.translation),
              scanner_from_carrier * (slope < 0 ? hit->normal : Vec3(-hit->normal))};
}

bool in_field(const Scanner& scanner, const Vec3& at) {
  const double share = at.z() / scanner.stand_off_mm;
  return at.z() >= scanner.near_mm && at.z() <= scanner.far_mm &&
         std::abs(at.x()) <= share * scanner.field_width_mm / 2 &&
         std::abs(at.y()) <= share * scanner.field_height_mm / 2;
}

/// The share of points that are lost at an incidence.
double lost_at(const Scanner& scanner, double incidence_deg) {
  if (incidence_deg > scanner.max_incidence_deg) return 1;
  if (incidence_deg <= scanner.good_incidence_deg) return 0;
  const double share =
      (incidence_deg - scanner.good_incidence_deg) / (scanner.max_incidence_deg - scanner.good_incidence_deg);
  return share * share;
}

bool seen(const Scene& scene, const Moment& moment, const Spot& spot) {
  if (spot.normal.dot(scene.camera - spot.at) <= 0) return false;
  const Vec3 above = spot.at + kLift_mm * spot.normal;
  const RigidMotion& carrier_from_scanner = moment.solid_from_scanner.front();
  if (scene.stage.solids.front().tree.blocked(carrier_from_scanner * above,
                                              carrier_from_scanner * scene.camera))
    return false;
  return !scene.in_shadow(moment, above, scene.projector) && !scene.in_shadow(moment, above, scene.camera);
}

void measure(const Scene& scene, const Moment& moment, const Spot& spot, RandomStream& random,
             SimulatedScan& into) {
  const Scanner& scanner = scene.scanner;
  if (!in_field(scanner, spot.at)) {
    ++into.beyond_range;
    return;
  }
  const Vec3 sight = spot.at.normalized();
  const double cos_incidence = std::min(1.0, std::abs(spot.normal.dot(sight)));
  if (random.uniform() < lost_at(scanner, deg_from_rad(std::acos(cos_incidence)))) {
    ++into.grazing;
    return;
  }
  if (!seen(scene, moment, spot)) {
    ++into.shadowed;
    return;
  }
  const RangeNoise noise = range_noise(scanner, spot.at.z(), cos_incidence);
  Vec3 measured = spot.at;
  measured.x() += noise.lateral_mm * random.normal();
  measured.y() += noise.lateral_mm * random.normal();
  measured.z() += noise.depth_mm * random.normal();
  const bool outlier = random.uniform() < scanner.outlier_share;
  if (outlier) measured += random.uniform(-scanner.outlier_mm, scanner.outlier_mm) * sight;
  into.scan.in_scanner.emplace_back(measured.cast<float>());
  into.scan.times_s.push_back(moment.time_s);
  into.true_in_workpiece.emplace_back((moment.workpiece_from_scanner * spot.at).cast<float>());
  into.outlier.push_back(outlier ? 1 : 0);
}

void append(SimulatedScan& scan, const SimulatedScan& line) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(scan.scan.in_scanner, line.scan.in_scanner);
  add(scan.scan.times_s, line.scan.times_s);
  add(scan.true_in_workpiece, line.true_in_workpiece);
  add(scan.outlier, line.outlier);
  scan.grazing += line.grazing;
  scan.shadowed += line.shadowed;
  scan.beyond_range += line.beyond_range;
}

/// Lines that are lit from the pass's begin to its end.
std::size_t lines_in(const ScanPass& pass, const Sheets& sheets) {
  if (sheets.line_s == 0) return static_cast<std::size_t>(sheets.count);
  return static_cast<std::size_t>(std::floor((pass.to_s - pass.from_s) / sheets.line_s + 1e-6)) + 1;
}

}  // namespace

RigidMotion true_body_from_scanner(const Scanner& scanner, std::uint64_t seed) {
  RandomStream random(seed, 0, static_cast<std::uint32_t>(Purpose::ScannerPlace));
  Vec6 error;
  for (double& each : error) each = random.normal();
  error.head<3>() *= rad_from_deg(scanner.place_sigma_deg);
  error.tail<3>() *= scanner.place_sigma_mm;
  return perturbed(scanner.body_from_scanner, error);
}

SimulatedScan simulate_scan(const Stage& stage, const ScanPass& pass, std::uint64_t seed) {
  if (!stage.cell.scanner)
    throw InputError(stage.cell.name, "has no [scanner]; there is nothing to scan with");
  if (!stage.cell.workpiece)
    throw InputError(stage.cell.name, "has no [workpiece]; there is nothing to scan");
  const Scene scene(stage, seed);
  const Scanner& scanner = scene.scanner;
  const Sheets sheets = sheets_of(scanner);
  const double reach = scanner.far_mm / scanner.stand_off_mm;
  const double step_y = scanner.field_height_mm / scanner.points_a_line;

  std::vector<SimulatedScan> lines(lines_in(pass, sheets));
  parallel_for(lines.size(), [&](std::size_t line) {
    const Moment moment = scene.at(pass.from_s + static_cast<double>(line) * sheets.line_s);
    const double x = sheets.x_mm(static_cast<int>(line % static_cast<std::size_t>(sheets.count)));
    RandomStream random(seed, static_cast<std::uint64_t>(pass.scan) << 32 | line,
                        static_cast<std::uint32_t>(Purpose::ScanLine));
    for (int i = 0; i < scanner.points_a_line; ++i) {
      const Vec3 at_stand_off(x, (i + 0.5) * step_y - scanner.field_height_mm / 2, scanner.stand_off_mm);
      const Vec3 end = scene.projector + reach * (at_stand_off - scene.projector);
      const auto spot = spot_of(scene, moment, end);
      if (spot) measure(scene, moment, *spot, random, lines[line]);
    }
  });
  SimulatedScan scan;
  scan.scan.number = pass.scan;
  scan.scan.body = scanner.body;
  scan.scan.time_s = pass.from_s;
  for (const SimulatedScan& line : lines) append(scan, line);
  return scan;
}

}  // namespace asterism
