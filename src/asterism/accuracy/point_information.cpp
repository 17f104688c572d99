// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/point_information.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {

CentreVariance::CentreVariance(const AccuracyOptions& options)
    : constant_(options.sigma_px * options.sigma_px) {
  require(options.sigma_px > 0, "a centre's sigma is positive");
  if (!options.bound) return;
  // Between neighbours the curve is straight to a few parts in a million up to 85° of incidence.
  constexpr std::size_t kSteps = 1024;
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const double cosine = static_cast<double>(i) / kSteps;
    of_cosine_.push_back(options.bound->variance_times_px(std::acos(cosine)));
  }
}

double CentreVariance::times_px(double cosine) const {
  const double place = std::clamp(cosine, 0.0, 1.0) * static_cast<double>(of_cosine_.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), of_cosine_.size() - 2);
  const double share = place - static_cast<double>(low);
  return of_cosine_[low] + share * (of_cosine_[low + 1] - of_cosine_[low]);
}

TargetForLanes target_for_lanes(const Target& target, const AccuracyOptions& options) {
  TargetForLanes out;
  out.position = target.position;
  out.normal = target.normal.value_or(Vec3::Zero());
  out.radius = 0.5 * target.diameter_mm.value_or(0.0);
  if (target.covariance) {
    out.map = *target.covariance;
  } else if (options.map_sigma_mm > 0) {
    out.map = options.map_sigma_mm * options.map_sigma_mm * Mat3::Identity();
  }
  return out;
}

}  // namespace asterism
