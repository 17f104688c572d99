// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/candidate_study.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPurpose = 0x7A26E7;
constexpr int kTries = 48;  // lines of sight tried for a place
constexpr int kKept = 3;    // that see it

void unite(SampleBits& all, std::span<const std::uint64_t> row) {
  for (std::size_t i = 0; i < row.size(); ++i) all[i] |= row[i];
}

bool measures_nothing(std::span<const std::uint64_t> row) {
  return std::all_of(row.begin(), row.end(), [](std::uint64_t word) { return word == 0; });
}

LimitMask asked_mask(const AskedLimits& asked) {
  LimitMask mask = 0;
  for (std::size_t i = 0; i < kScanLimits; ++i) mask |= asked.on[i] ? LimitMask{1} << i : 0;
  return mask;
}

/// What the geometry of part and fixtures says of each view: its row, and whether it keeps clear.
struct Shown {
  std::vector<std::uint8_t> clear;  // of part and fixtures
};

Shown show(const PlanGround& ground, CandidateStudy& study) {
  const Scanner& scanner = *ground.cell.scanner;
  const AskedLimits& asked = ground.options.asked;
  const std::size_t count = study.views.size();
  study.rows = measured_samples(study.views, ground.samples, scanner, ground.scene.part, asked);
  std::vector<std::uint8_t> off_part(count, 1), off_fixtures(count, 1);
  if (asked[ScanLimit::Clearance]) {
    parallel_for(count, [&](std::size_t i) {
      const Vec3& origin = study.views[i].workpiece_from_scanner.translation;
      off_part[i] = is_clear(scanner, origin, ground.scene.part_surface) ? 1 : 0;
      off_fixtures[i] = is_clear(scanner, origin, ground.scene.fixtures_surface) ? 1 : 0;
    });
  }
  study.reachable.assign(study.rows.words(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (off_part[i] != 0) unite(study.reachable, study.rows.row(i));
  }
  if (asked[ScanLimit::Sight]) {
    take_out_hidden(study.views, ground.samples, scanner, ground.scene.fixtures, study.rows);
  }
  for (std::size_t i = 0; i < count; ++i) off_part[i] = off_part[i] & off_fixtures[i];
  return {off_part};
}

/// Splits what a view measures by whether it is known well enough.
void sort_out(const PlanGround& ground, const CandidateStudy& study, const Sighting& sighting,
              AllowedView& allowed, std::vector<std::uint32_t>& uncertain) {
  const RigidMotion& view = study.views[allowed.view].workpiece_from_scanner;
  const bool asked = ground.options.asked[ScanLimit::Uncertainty] && sighting.covariance;
  for_each_bit(study.rows.row(allowed.view), [&](std::size_t i) {
    const bool sure =
        !asked || sigma_along_normal_mm(*ground.cell.scanner, view, *sighting.covariance,
                                        ground.samples[i]) <= ground.cell.scan_task.tolerance_mm;
    (sure ? allowed.measures : uncertain).push_back(static_cast<std::uint32_t>(i));
  });
}

/// All `pending` views in one pose; returns those that are not yet allowed in full.
std::vector<std::uint32_t> try_pose(const PlanGround& ground, std::size_t pose,
                                    std::span<const std::uint32_t> pending,
                                    std::span<const std::uint8_t> clear, CandidateStudy& study) {
  std::vector<RigidMotion> views;
  for (const std::uint32_t view : pending) views.push_back(study.views[view].workpiece_from_scanner);
  std::vector<Sighting> sightings = ground.sight.look(pose, views);
  std::vector<AllowedView> allowed(pending.size());
  std::vector<std::vector<std::uint32_t>> uncertain(pending.size());
  const LimitMask asked = asked_mask(ground.options.asked);
  parallel_for(pending.size(), [&](std::size_t i) {
    Sighting& sighting = sightings[i];
    if (clear[pending[i]] == 0) sighting.fails |= mask_of(ScanLimit::Clearance);
    sighting.fails &= asked;
    if (ground.reach && asked & mask_of(ScanLimit::Reach) && std::popcount(sighting.fails) <= 1 &&
        !ground.reach->reaches(ground.sight.tracker_from_body(pose, views[i]),
                               ground.sight.tracker_from_part(pose))) {
      sighting.fails |= mask_of(ScanLimit::Reach);
    }
    if (sighting.fails != 0) return;
    allowed[i] = {pending[i],
                  static_cast<std::uint32_t>(pose),
                  {},
                  static_cast<std::uint8_t>(sighting.scanner_targets),
                  static_cast<std::uint8_t>(sighting.platform_targets)};
    sort_out(ground, study, sighting, allowed[i], uncertain[i]);
  });
  std::vector<std::uint32_t> still;
  for (std::size_t i = 0; i < pending.size(); ++i) {
    for (const std::uint32_t sample : allowed[i].measures) set_bit(study.coverable, sample);
    for (const std::uint32_t sample : uncertain[i]) set_bit(study.uncertain, sample);
    if (sightings[i].fails != 0) {
      study.forbidden.push_back({pending[i], static_cast<std::uint32_t>(pose), sightings[i].fails});
    }
    const bool in_full = sightings[i].fails == 0 && uncertain[i].empty();
    if (!in_full) still.push_back(pending[i]);
    if (!allowed[i].measures.empty()) study.allowed.push_back(std::move(allowed[i]));
  }
  return still;
}

}  // namespace

PlanGround plan_ground(const Cell& cell, const PlanOptions& options, std::uint64_t seed) {
  ScanScene scene = scan_scene_of(cell);
  CellSight sight(cell, platform_poses(cell, options.platform_steps), options.targets);
  std::optional<RobotReach> reach;
  if (cell.robot) reach.emplace(cell);
  return {cell,
          options,
          sample_surface(*cell.workpiece->surface, static_cast<std::size_t>(options.samples),
                         cell.scan_task.regions, seed),
          std::move(scene),
          std::move(sight),
          std::move(reach)};
}

CandidateStudy study_of(const PlanGround& ground, std::vector<Viewpoint> views, bool all_poses) {
  CandidateStudy study;
  study.views = std::move(views);
  const Shown shown = show(ground, study);
  study.coverable.assign(study.rows.words(), 0);
  study.uncertain.assign(study.rows.words(), 0);
  std::vector<std::uint32_t> pending;
  for (std::size_t i = 0; i < study.views.size(); ++i) {
    if (!measures_nothing(study.rows.row(i))) pending.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t pose = 0; pose < ground.sight.poses().size() && !pending.empty(); ++pose) {
    std::vector<std::uint32_t> still = try_pose(ground, pose, pending, shown.clear, study);
    if (!all_poses) pending = std::move(still);
  }
  return study;
}

void append(CandidateStudy& study, CandidateStudy more) {
  const auto first = static_cast<std::uint32_t>(study.views.size());
  study.views.insert(study.views.end(), more.views.begin(), more.views.end());
  study.rows.append(more.rows);
  unite(study.reachable, more.reachable);
  unite(study.coverable, more.coverable);
  unite(study.uncertain, more.uncertain);
  for (AllowedView& view : more.allowed) {
    view.view += first;
    study.allowed.push_back(std::move(view));
  }
  for (ForbiddenView& view : more.forbidden) {
    view.view += first;
    study.forbidden.push_back(view);
  }
}

std::vector<Viewpoint> first_views(const PlanGround& ground, std::uint64_t seed) {
  const PlanOptions& options = ground.options;
  const double stand_off = ground.cell.scanner->stand_off_mm;
  const auto count = static_cast<std::size_t>(options.candidates);
  const MeshFacts facts = facts_of(*ground.cell.workpiece->surface);
  switch (options.method) {
    case PlanMethod::Surface:
      return views_of_surface(ground.samples, count, stand_off, rad_from_deg(options.max_tilt_deg), seed);
    case PlanMethod::Sphere:
      return views_of_sphere(ground.scene.part, facts, count, stand_off);
    case PlanMethod::Cylinder:
      return views_of_cylinder(ground.scene.part, facts, count, stand_off);
    case PlanMethod::Rings:
      return views_of_rings(
          rings_around(ground.samples, stand_off, options.ring_pitch_mm, options.ring_step_deg));
  }
  return {};
}

std::vector<Viewpoint> targeted_views(const PlanGround& ground, std::span<const std::uint32_t> uncovered,
                                      std::uint64_t seed) {
  const Scanner& scanner = *ground.cell.scanner;
  const double least_cosine = std::cos(rad_from_deg(scanner.max_incidence_deg));
  const double spare = 0.02 * (scanner.far_mm - scanner.near_mm);
  std::vector<std::vector<Viewpoint>> found(uncovered.size());
  parallel_for(uncovered.size(), [&](std::size_t which) {
    const SurfaceSample& sample = ground.samples[uncovered[which]];
    const Vec3 u = sample.normal.unitOrthogonal(), v = sample.normal.cross(u);
    RandomStream random(seed, uncovered[which], kPurpose);
    for (int i = 0; i < kTries && found[which].size() < kKept; ++i) {
      const double cosine = random.uniform(least_cosine, 1.0);
      const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      const double azimuth = random.uniform(0, 2 * std::numbers::pi);
      const Vec3 towards = cosine * sample.normal + sine * (std::cos(azimuth) * u + std::sin(azimuth) * v);
      const double distance = random.uniform(scanner.near_mm + spare, scanner.far_mm - spare);
      const RigidMotion view =
          looking_at(sample.at, towards.normalized(), distance, random.uniform(0, 2 * std::numbers::pi));
      if (ground.options.asked[ScanLimit::Sight] &&
          !(in_sight(scanner, view, sample, ground.scene.part) &&
            in_sight(scanner, view, sample, ground.scene.fixtures))) {
        continue;
      }
      if (ground.options.asked[ScanLimit::Clearance] &&
          !(is_clear(scanner, view.translation, ground.scene.part_surface) &&
            is_clear(scanner, view.translation, ground.scene.fixtures_surface))) {
        continue;
      }
      found[which].push_back({view, ViewSource::Targeted});
    }
  });
  std::vector<Viewpoint> views;
  for (const auto& some : found) views.insert(views.end(), some.begin(), some.end());
  return views;
}

}  // namespace asterism
