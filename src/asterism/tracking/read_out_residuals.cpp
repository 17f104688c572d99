// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/read_out_residuals.hpp"

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {

std::vector<ReadOutResidual> residuals_of(const PoseCurve& curve, std::span<const PlatformReading> readings,
                                          const ReadOutLink& link, double largest_gap_s) {
  std::vector<ReadOutResidual> residuals;
  Mat6 turn = Mat6::Zero();  // the base's axes along the tracker's
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
      link.tracker_from_base.rotation.toRotationMatrix();
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const auto between = pose_between(curve, readings[k].time_s - link.latency_s, largest_gap_s);
    if (!between) continue;
    Mat6 covariance = turn * readings[k].covariance * turn.transpose();
    for (std::size_t i = 0; i < 4; ++i) {
      covariance += between->share[i] * between->share[i] * curve.noise[between->first + i];
    }
    const auto weight = inverse_positive(covariance);
    require(weight.has_value(), "a reading's covariance is positive definite");
    const Vec6 residual =
        difference(link.tracker_from_base * readings[k].base_from_body, between->tracker_from_body);
    residuals.push_back({k, *between, residual, *weight, residual.dot(*weight * residual)});
  }
  return residuals;
}

Mat67 jacobian_of(const ReadOutResidual& residual, const PlatformReading& reading, const ReadOutLink& link) {
  Mat67 j = Mat67::Zero();
  j.leftCols<6>().setIdentity();
  j.block<3, 3>(3, 0) = -skew(link.tracker_from_base.rotation * reading.base_from_body.translation);
  j.col(6) = residual.between.velocity;
  return j;
}

}  // namespace asterism
