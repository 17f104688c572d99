// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/streak_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "asterism/core/parallel.hpp"
#include "asterism/detection/detect.hpp"
#include "asterism/evaluation/blurred_centre.hpp"

namespace asterism {
namespace {

constexpr double kSpeed_deg_s = 60;
constexpr double kDiameters[] = {0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5};

/// A disc that one image shows, and the centre found there.
struct Seen {
  Vec2 streak_px;
  double radius_px;
  std::optional<Vec2> error_px;
  Mat2 covariance = Mat2::Zero();
};

/// How the image of a target goes during the exposure: from the two ends of the way.
Vec2 streak_of(const Cell& cell, const TargetTruth& target, double time_s) {
  const Mover& mover = cell.movers[static_cast<std::size_t>(target.body)];
  const Vec3& place = mover.body.targets[static_cast<std::size_t>(target.target)].position;
  const auto at = [&](double t) {
    return project(cell.rig.lens(target.side),
                   cell.rig.camera_from_tracker(target.side) * pose_at(mover.motion, t) * place);
  };
  const double half_s = 0.5 * cell.sensor.exposure_s;
  const auto begin = at(time_s - half_s);
  const auto end = at(time_s + half_s);
  return begin && end ? Vec2(end->px - begin->px) : Vec2(Vec2::Zero());
}

std::vector<Seen> seen_in(const SimulatedFrame& frame, const Cell& cell, std::size_t body,
                          const DetectionOptions& detection) {
  std::vector<Seen> seen;
  for (const Side side : {Side::Left, Side::Right}) {
    const auto& image = side == Side::Left ? frame.image.left : frame.image.right;
    if (!image) continue;
    const std::vector<Centre> centres = detect_targets(*image, detection);
    for (const TargetTruth& target : frame.truth.targets) {
      if (target.side != side || target.body != static_cast<int>(body) || !is_seen(target)) continue;
      Seen disc{streak_of(cell, target, frame.time_s), target.image.semi_minor, {}};
      const double reach = 0.5 * target.image.semi_minor;
      for (const Centre& centre : centres) {
        const Vec2 off = centre.px() - target.image.centre;
        if (off.norm() > reach || (disc.error_px && off.norm() > disc.error_px->norm())) continue;
        disc.error_px = off;
        disc.covariance = centre.covariance;
      }
      seen.push_back(disc);
    }
  }
  return seen;
}

StreakCheck check_of(const std::vector<Seen>& seen) {
  StreakCheck check;
  check.shown = seen.size();
  double along = 0, across = 0, stated = 0, nees = 0, streak = 0;
  for (const Seen& disc : seen) {
    streak += disc.streak_px.norm();
    if (!disc.error_px) continue;
    ++check.found;
    const Vec2 u = disc.streak_px.norm() > 0 ? disc.streak_px.normalized() : Vec2(Vec2::UnitX());
    along += std::pow(u.dot(*disc.error_px), 2);
    across += disc.error_px->squaredNorm() - std::pow(u.dot(*disc.error_px), 2);
    stated += 0.5 * disc.covariance.trace();
    nees += 0.5 * disc.error_px->dot(disc.covariance.inverse() * *disc.error_px);
  }
  if (check.shown > 0) check.streak_px = streak / static_cast<double>(check.shown);
  if (check.found == 0) return check;
  const double count = static_cast<double>(check.found);
  check.along_px = std::sqrt(along / count);
  check.across_px = std::sqrt(across / count);
  check.stated_px = std::sqrt(stated / count);
  check.nees_share = nees / count;
  return check;
}

std::vector<Seen> images_at(Cell cell, double exposure_s, const SpeedTradeOptions& options,
                            const DetectionOptions& detection) {
  const std::size_t body = verified_body(cell);
  cell.sensor.exposure_s = exposure_s;
  cell.sensor.lost_frames = 0;
  cell.timing.rate_hz = 1000;  // all near the fastest moment, which is that of frame 0
  SimulationOptions simulation;
  simulation.level = SimulationLevel::Images;
  simulation.seed = options.seed;
  const Simulator simulator(cell, simulation);
  std::vector<Seen> seen;
  for (int frame = 0; frame < options.image_frames; ++frame) {
    const std::vector<Seen> more = seen_in(simulator.frame(frame), cell, body, detection);
    seen.insert(seen.end(), more.begin(), more.end());
  }
  return seen;
}

}  // namespace

std::vector<StreakCheck> streak_checks(const Cell& cell, const SpeedTradeOptions& options,
                                       const DetectionOptions& detection) {
  const Cell swinging = swinging_cell(cell, kSpeed_deg_s, options.swing_deg);
  // A millisecond tells how fast the targets go, and how large they are.
  constexpr double kProbe_s = 1e-3;
  const std::vector<Seen> probe = images_at(swinging, kProbe_s, options, detection);
  double streak = 0, radius = 0;
  for (const Seen& disc : probe) {
    streak += disc.streak_px.norm();
    radius += disc.radius_px;
  }
  if (!(streak > 0)) return {};
  const double count = static_cast<double>(probe.size());
  std::vector<StreakCheck> checks(std::size(kDiameters));
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const double exposure_s = std::max(1e-6, kDiameters[i] * 2 * radius / streak * kProbe_s);
    checks[i] = check_of(images_at(swinging, exposure_s, options, detection));
    checks[i].exposure_s = exposure_s;
  }
  const BlurredCentreBound bound(centre_bound(cell.sensor, cell.light), radius / count,
                                 2 * checks.back().streak_px);
  const double at_rest = std::hypot(checks.front().along_px, checks.front().across_px) / std::sqrt(2.0);
  for (StreakCheck& check : checks) {
    const auto growth = bound.growth(check.streak_px);
    check.model_along_px = at_rest * growth.along;
    check.model_across_px = at_rest * growth.across;
  }
  return checks;
}

}  // namespace asterism
