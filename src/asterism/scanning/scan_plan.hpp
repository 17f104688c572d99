// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

/// What can keep a place from being measured, in the order in which it is asked.
enum class ScanLimit {
  Range,            // nearer or farther than the scanner measures
  Field,            // beside its field
  Incidence,        // seen too obliquely
  Sight,            // hidden from projector or camera
  Clearance,        // the scanner would touch part, platform or fixture
  Floor,            // or the floor
  Reach,            // the robot does not get there, or a link would touch something
  ScannerTargets,   // fewer than four of the scanner's targets seen by both cameras
  PlatformTargets,  // fewer than four of the platform's
  Uncertainty,      // the point would be known less well than the tolerance
};
constexpr std::size_t kScanLimits = 10;
[[nodiscard]] std::string_view text_of(ScanLimit limit);

/// One view: where the scanner stands on the part, and how the platform is turned.
struct PlannedView {
  RigidMotion workpiece_from_scanner;
  std::size_t platform_pose = 0;        // an index into the plan's
  std::vector<std::uint32_t> measures;  // samples, ascending
  double adds_mm2 = 0;                  // area that no view before it measures
  double mean_incidence_deg = 0;        // of what it measures
  double beyond_good_incidence = 0;     // share of what it measures that is seen beyond the good incidence
  double worst_sigma_mm = 0;            // predicted, along the normal, of what it measures
  int scanner_targets = 0, platform_targets = 0;  // seen by both cameras
  double starts_s = 0;                            // in the tour
};

/// How the platform is turned, and where that puts it.
struct PlatformPose {
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;  // from its place of rest, about its pivot
  RigidMotion tracker_from_platform;
};

/// What one limit costs: how much more would be coverable without it, all others kept.
struct LimitCost {
  ScanLimit limit;
  double area_mm2 = 0;
};

/// The fewest views that were found, in the order in which they are to be visited.
struct ScanPlan {
  std::vector<SurfaceSample> samples;
  std::vector<PlatformPose> poses;  // those that are used, in order; the first one is where the tour begins
  std::vector<PlannedView> views;
  std::size_t bound = 0;  // no plan of these candidates has fewer views (costs less, where turns cost)
  bool optimal = false;
  std::size_t greedy_views = 0;  // what plain greedy gives, for comparison
  std::size_t candidates = 0;    // viewpoints that were tried, times platform poses
  std::string in_words;          // "18 views, optimal", "57 views, bound 55"

  // Area, mm² (not weighted), against which coverage is told:
  double surface_mm2 = 0;         // the whole surface
  double reachable_mm2 = 0;       // measured by any candidate, cell or not
  double coverable_mm2 = 0;       // measured by a candidate that this cell allows
  double covered_before_mm2 = 0;  // already, by an earlier cloud
  double covered_mm2 = 0;         // by this plan and before
  std::vector<LimitCost> limits;
  std::vector<std::uint32_t> covered_before;  // samples
  double tour_s = 0;                          // the whole tour: moves, turns and views
  double nearest_neighbour_s = 0;             // the same views by nearest neighbour
  std::vector<std::string> remarks;           // "the underside is never covered: turn the part over"
};

}  // namespace asterism
