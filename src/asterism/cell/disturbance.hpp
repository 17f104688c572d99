// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/geometry/types.hpp"

namespace asterism {

/// What goes wrong with one target at a moment and stays so.
enum class FaultKind {
  FallsOff,  // the target is gone
  Knocked    // its foot slides: the target stands `shift_mm` beside where the body's file has it
};

struct TargetFault {
  FaultKind kind = FaultKind::FallsOff;
  std::string body, target;  // by name and id
  double time_s = 0;
  Vec3 shift_mm = Vec3::Zero();  // in the body's frame; of a knocked target
};

/// A lamp or a window that the cameras see: a bright disc of its own, with a halo of stray light around.
struct Lamp {
  std::string name;
  Vec3 in_tracker_mm = Vec3::Zero();
  double radius_mm = 20;
  double level = 2;         // brightness as a share of full scale: above 1 it saturates
  double halo_level = 0.1;  // of the stray light beside it, falling off with
  double halo_px = 60;      // this distance (1/e)
};
/// All but name and place.
void describe(Lamp& lamp, OptionVisitor& visit);

/// How wrong everything is that a prediction of accuracy must reckon with (1σ each); what `verify` draws anew
/// for each disturbance run, and what each share of the error budget comes from.
struct NoiseModel {
  double sigma_px = 0.02;          // of a target's centre, each axis
  double map_sigma_mm = 0.01;      // of the targets' coordinates as learnt
  double target_loss = 0;          // share of targets missed in a frame, each by itself (both cameras)
  double focal_sigma_px = 0;       // calibration: of each focal length,
  double principal_sigma_px = 0;   // each principal point,
  double turn_sigma_deg = 0;       // the right camera's attitude about each axis,
  double baseline_sigma_mm = 0;    // and its place along each axis
  double latency_s = 0;            // the pose is used so long after the exposure, at the speed it then has,
  double latency_sigma_s = 0;      // known this well
  double temperature_k = 0;        // the body's warming since its targets were learnt,
  double temperature_sigma_k = 0;  // known this well,
  double expansion_ppm_k = 11.5;   // at the expansion of steel
};
void describe(NoiseModel& noise, OptionVisitor& visit);

}  // namespace asterism
