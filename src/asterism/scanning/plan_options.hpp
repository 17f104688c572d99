// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/optimization/set_cover.hpp"
#include "asterism/scanning/measurability.hpp"

namespace asterism {

/// What a plan has least of. Views: their number; among plans alike in that, few turns of the platform. Time:
/// views and turns as [scan] has them in seconds, ways left out.
enum class PlanObjective { Views, Time };

/// Where the first candidates come from. Rings alone are kept as they are: they are not sampled anew where
/// places stay uncovered.
enum class PlanMethod { Surface, Sphere, Cylinder, Rings };

struct PlanOptions {
  PlanObjective objective = PlanObjective::Views;
  PlanMethod method = PlanMethod::Surface;
  int samples = 8000;          // of the surface
  int candidates = 4000;       // at first
  int rounds = 3;              // of sampling anew for places that stay uncovered,
  int candidates_more = 2000;  // so many candidates a round at most
  double max_tilt_deg = 35;    // of the line of sight from the normal
  double ring_pitch_mm = 200, ring_step_deg = 9;
  int platform_steps = 3;  // attitudes an axis of the platform, within its stroke; 1 = it rests
  int targets = 4;         // of scanner and of platform to be seen by both cameras
  AskedLimits asked;
  SetCoverOptions cover;
};
void describe(PlanOptions& options, OptionVisitor& visit);

}  // namespace asterism
