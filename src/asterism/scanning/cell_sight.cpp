// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/cell_sight.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kChunk = 64;  // views a task
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The cell with the solids that move with a body, or with all others.
Cell with_solids(Cell cell, const std::string& body, bool of_body) {
  const auto other = [&](const auto& solid) { return (solid.body == body) != of_body; };
  std::erase_if(cell.obstacles, other);
  std::erase_if(cell.fixtures, other);
  if (cell.workpiece && other(*cell.workpiece)) cell.workpiece.reset();
  return cell;
}

const Cell& with_scanner(const Cell& cell) {
  if (!cell.workpiece) throw InputError("the cell has no [workpiece]; there is nothing to scan");
  if (!cell.scanner) throw InputError("the cell has no [scanner]; a plan needs one");
  return cell;
}

std::size_t mover_of(const Cell& cell, const std::string& body) {
  const int mover = mover_index(cell, body);
  return mover < 0 ? kNone : static_cast<std::size_t>(mover);
}

AccuracyOptions accuracy_of(const NoiseModel& noise) {
  AccuracyOptions options;
  options.sigma_px = noise.sigma_px;
  options.map_sigma_mm = noise.map_sigma_mm;
  return options;
}

Mat6 place_covariance(const Scanner& scanner) {
  Mat6 covariance = Mat6::Zero();
  const double turn = rad_from_deg(scanner.place_sigma_deg);
  covariance.diagonal().head<3>().setConstant(turn * turn);
  covariance.diagonal().tail<3>().setConstant(scanner.place_sigma_mm * scanner.place_sigma_mm);
  return covariance;
}

int seen_by_both(const std::array<TargetMask, 2>& seen) { return std::popcount(seen[0] & seen[1]); }

}  // namespace

CellSight::CellSight(const Cell& cell, std::vector<PlatformPose> poses, int targets)
    : cell_(with_scanner(cell)),
      poses_(std::move(poses)),
      targets_(targets),
      scanner_(mover_of(cell, cell.scanner->body)),
      platform_(mover_of(cell, cell.workpiece->body)),
      accuracy_(accuracy_of(cell.noise)),
      others_(with_solids(cell, cell.scanner->body, false)),
      housing_(with_solids(cell, cell.scanner->body, true)),
      surroundings_(surroundings_of(cell)) {
  require(scanner_ != kNone, "the scanner's body is there");
  for (const PlatformPose& pose : poses_) {
    part_.push_back(asterism::tracker_from_workpiece(cell_, pose));
    platform_sights_.push_back(sight_of(pose));
  }
}

CellSight::PlatformSight CellSight::sight_of(const PlatformPose& pose) const {
  PlatformSight sight{poses_at(cell_, 0), {}, {}};
  if (platform_ == kNone) return sight;
  RigidMotion& placed = sight.movers[platform_];
  placed = asterism::tracker_from_workpiece(cell_, pose) * cell_.workpiece->carrier_from_solid.inverse();
  const std::vector<Target>& targets = cell_.movers[platform_].body.targets;
  const auto seen = visible_targets(targets, std::span(&placed, 1), cell_.rig, cell_.volume, {});
  sight.seen = others_.unhidden_of(seen, targets, platform_, std::span(&sight.movers, 1)).seen[0];
  sight.covariance = covariance_of(platform_, sight.seen, placed);
  return sight;
}

std::optional<Mat6> CellSight::covariance_of(std::size_t body, const std::array<TargetMask, 2>& seen,
                                             const RigidMotion& tracker_from_body) const {
  const auto accuracy =
      predict_pose_accuracy(cell_.movers[body].body.targets, seen, tracker_from_body, cell_.rig, accuracy_);
  return accuracy ? std::optional(accuracy->covariance) : std::nullopt;
}

RigidMotion CellSight::tracker_from_body(std::size_t pose, const RigidMotion& workpiece_from_scanner) const {
  return part_[pose] * workpiece_from_scanner * cell_.scanner->body_from_scanner.inverse();
}

void CellSight::place(Sighting& sighting, std::size_t pose, const RigidMotion& workpiece_from_scanner) const {
  const Vec3 origin = part_[pose] * workpiece_from_scanner.translation;
  if (!is_clear(*cell_.scanner, origin, surroundings_)) sighting.fails |= mask_of(ScanLimit::Clearance);
  if (!cell_.scan_task.floor_mm) return;
  const RigidMotion& rest = platform_ != kNone ? poses_.front().tracker_from_platform : RigidMotion{};
  const double lowest = (rest.inverse() * origin).z() - cell_.scanner->clearance_mm;
  if (lowest < *cell_.scan_task.floor_mm) sighting.fails |= mask_of(ScanLimit::Floor);
}

void CellSight::look_at_some(std::size_t pose, std::span<const RigidMotion> views,
                             std::span<Sighting> out) const {
  const PlatformSight& platform = platform_sights_[pose];
  std::vector<RigidMotion> bodies;
  std::vector<std::vector<RigidMotion>> movers(views.size(), platform.movers);
  for (std::size_t i = 0; i < views.size(); ++i) {
    place(out[i], pose, views[i]);
    bodies.push_back(tracker_from_body(pose, views[i]));
    movers[i][scanner_] = bodies.back();
  }
  const std::vector<Target>& targets = cell_.movers[scanner_].body.targets;
  MotionVisibility seen = visible_targets(targets, bodies, cell_.rig, cell_.volume, {});
  seen = housing_.unhidden_of(seen, targets, scanner_, movers);
  seen = others_.unhidden_of(seen, targets, scanner_, movers);
  MotionVisibility of_platform{std::vector(views.size(), platform.seen)};
  if (platform_ != kNone) {
    of_platform = housing_.unhidden_of(of_platform, cell_.movers[platform_].body.targets, platform_, movers);
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    Sighting& one = out[i];
    one.scanner_targets = seen_by_both(seen.seen[i]);
    one.platform_targets = seen_by_both(of_platform.seen[i]);
    if (one.scanner_targets < targets_) one.fails |= mask_of(ScanLimit::ScannerTargets);
    if (platform_ != kNone && one.platform_targets < targets_) {
      one.fails |= mask_of(ScanLimit::PlatformTargets);
    }
    if (one.fails != 0) continue;
    const auto of_scanner = covariance_of(scanner_, seen.seen[i], bodies[i]);
    std::optional<Mat6> of_part = Mat6::Zero();
    if (platform_ != kNone) {
      of_part = of_platform.seen[i] == platform.seen
                    ? platform.covariance
                    : covariance_of(platform_, of_platform.seen[i], platform.movers[platform_]);
    }
    if (!of_scanner || !of_part) {
      one.fails |= mask_of(ScanLimit::Uncertainty);
      continue;
    }
    const RigidMotion tracker_from_scanner = bodies[i] * cell_.scanner->body_from_scanner;
    const Mat6 scanner = covariance_of_product(bodies[i], *of_scanner, cell_.scanner->body_from_scanner,
                                               place_covariance(*cell_.scanner));
    // The platform's error moves the part with it: as that of tracker_from_workpiece.
    const RigidMotion carrier = platform_ != kNone ? platform.movers[platform_] : RigidMotion{};
    const Mat6 part =
        covariance_of_product(carrier, *of_part, cell_.workpiece->carrier_from_solid, Mat6::Zero());
    one.covariance = covariance_of_product(part_[pose].inverse(), covariance_of_inverse(part_[pose], part),
                                           tracker_from_scanner, scanner);
  }
}

std::vector<Sighting> CellSight::look(std::size_t pose, std::span<const RigidMotion> views) const {
  std::vector<Sighting> sightings(views.size());
  parallel_for((views.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, count = std::min(kChunk, views.size() - first);
    look_at_some(pose, views.subspan(first, count), std::span(sightings).subspan(first, count));
  });
  return sightings;
}

double sigma_along_normal_mm(const Scanner& scanner, const RigidMotion& workpiece_from_scanner,
                             const Mat6& covariance, const SurfaceSample& sample) {
  const Vec3 arm = sample.at - workpiece_from_scanner.translation;
  const Vec3 normal = workpiece_from_scanner.rotation.conjugate() * sample.normal;
  const double depth = (workpiece_from_scanner.rotation.conjugate() * arm).z();
  const RangeNoise noise = range_noise(scanner, depth, -sample.normal.dot(arm.normalized()));
  Vec6 along;
  along << arm.cross(sample.normal), sample.normal;
  const double lateral2 = noise.lateral_mm * noise.lateral_mm, depth2 = noise.depth_mm * noise.depth_mm;
  return std::sqrt(along.dot(covariance * along) +
                   lateral2 * (normal.x() * normal.x() + normal.y() * normal.y()) +
                   depth2 * normal.z() * normal.z());
}

}  // namespace asterism
