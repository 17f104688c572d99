// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/error_map.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"

namespace asterism {

SquareErrorForm square_error_form(const RigidMotion& tracker_from_body, const Mat6& covariance) {
  const Mat3 r = tracker_from_body.rotation.toRotationMatrix();
  const Mat3 a = r.transpose() * covariance.topLeftCorner<3, 3>() * r;
  const Mat3 b = r.transpose() * covariance.topRightCorner<3, 3>() * r;
  SquareErrorForm form;
  form.constant = covariance.bottomRightCorner<3, 3>().trace();
  form.linear = 2 * Vec3(b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1));
  form.square = a.trace() * Mat3::Identity() - a;
  return form;
}

std::optional<ErrorMap> error_map(std::span<const Vec3> vertices, const PredictedAccuracy& predicted,
                                  std::span<const RigidMotion> tracker_from_body) {
  std::vector<SquareErrorForm> forms;
  for (std::size_t i = 0; i < predicted.poses.size(); ++i) {
    if (predicted.poses[i])
      forms.push_back(square_error_form(tracker_from_body[i], predicted.poses[i]->covariance));
  }
  if (forms.empty() || vertices.empty()) return std::nullopt;
  ErrorMap map;
  map.error_mm.resize(vertices.size());
  parallel_for(vertices.size(), [&](std::size_t i) {
    double worst = 0;
    for (const SquareErrorForm& form : forms) worst = std::max(worst, form.at(vertices[i]));
    map.error_mm[i] = std::sqrt(worst);
  });
  const auto worst = std::max_element(map.error_mm.begin(), map.error_mm.end());
  map.worst = static_cast<std::size_t>(worst - map.error_mm.begin());
  return map;
}

}  // namespace asterism
