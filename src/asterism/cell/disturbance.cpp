// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/disturbance.hpp"

namespace asterism {

void describe(Lamp& lamp, OptionVisitor& visit) {
  visit.number("radius_mm", lamp.radius_mm, {0.01, 1e5}, "radius of the disc");
  visit.number("level", lamp.level, {0, 1000}, "brightness, share of full scale; above 1 it saturates");
  visit.number("halo_level", lamp.halo_level, {0, 100}, "stray light at its rim, share of full scale");
  visit.number("halo_px", lamp.halo_px, {0.1, 1e4}, "distance over which the stray light falls to 1/e");
}

void describe(NoiseModel& noise, OptionVisitor& visit) {
  constexpr Limits kSigma = {0, 1e3};
  visit.number("sigma_px", noise.sigma_px, kSigma, "of a target's centre along each axis, 1 sigma");
  visit.number("map_sigma_mm", noise.map_sigma_mm, kSigma,
               "of the targets' coordinates as learnt, each axis");
  visit.number("target_loss", noise.target_loss, {0, 1},
               "share of targets missed in a frame, each by itself");
  visit.number("focal_sigma_px", noise.focal_sigma_px, kSigma, "of each focal length as calibrated");
  visit.number("principal_sigma_px", noise.principal_sigma_px, kSigma,
               "of each principal point as calibrated");
  visit.number("turn_sigma_deg", noise.turn_sigma_deg, {0, 10},
               "of the right camera's attitude about each axis as calibrated");
  visit.number("baseline_sigma_mm", noise.baseline_sigma_mm, kSigma,
               "of the right camera's place along each axis as calibrated");
  visit.number("latency_s", noise.latency_s, {0, 10}, "from exposure to the pose's use");
  visit.number("latency_sigma_s", noise.latency_sigma_s, {0, 10}, "of that time");
  visit.number("temperature_k", noise.temperature_k, {-200, 200},
               "warming of the body since its targets were learnt");
  visit.number("temperature_sigma_k", noise.temperature_sigma_k, {0, 200}, "of that warming");
  visit.number("expansion_ppm_k", noise.expansion_ppm_k, {-100, 1000}, "expansion of the body, ppm a kelvin");
}

}  // namespace asterism
