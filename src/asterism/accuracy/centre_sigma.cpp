// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/centre_sigma.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asterism {

double CentreBound::variance_times_px(double incidence_rad) const {
  const double share = retro_falloff_rad > 0 ? incidence_rad / retro_falloff_rad : 0.0;
  const double height = amplitude * std::exp(-share * share * share * share);
  // A target that sends no light back says nothing; the limit keeps the arithmetic finite.
  constexpr double kNothing = 1e12;
  if (!(height > 1e-9)) return kNothing;
  const double noise = background_variance + shot * 0.5 * height;  // halfway up the edge
  return std::min(kNothing, 2 * blur_px * noise / (std::sqrt(std::numbers::pi) * height * height));
}

CentreBound centre_bound(const Sensor& sensor, const Light& light) {
  CentreBound bound;
  // A pixel averages over its own width, which widens the blur by that of a unit square.
  bound.blur_px = std::sqrt(sensor.blur_px * sensor.blur_px + 1.0 / 12);
  bound.amplitude = light.target_level;
  bound.retro_falloff_rad = rad_from_deg(light.retro_falloff_deg);
  bound.shot = 1 / sensor.full_well_e;
  const double read = sensor.read_noise_e / sensor.full_well_e;
  const double step = 1 / (std::exp2(sensor.bits) - 1);
  const double gain = sensor.gain_spread * (light.background_level + 0.5 * light.target_level);
  bound.background_variance =
      bound.shot * light.background_level + read * read + step * step / 12 + gain * gain;
  return bound;
}

}  // namespace asterism
