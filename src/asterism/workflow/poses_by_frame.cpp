// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/poses_by_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
Mat6 covariance_of(const StatedSigma& stated) {
  Mat6 covariance = Mat6::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(std::pow(rad_from_deg(stated.deg), 2));
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(stated.mm * stated.mm);
  return covariance;
}

std::map<int, KnownMotion> poses_by_frame(std::span<const PoseRecord> records, const std::string& body,
                                          const StatedSigma& stated, const std::filesystem::path& file) {
  std::map<int, KnownMotion> known;
  std::string of = body;
  for (const PoseRecord& record : records) {
    if (of.empty()) of = record.body;
    if (body.empty() && record.body != of)
      throw InputError(file.string(), "tells of several bodies; the poses of one alone are needed");
    if (record.body != of || !record.tracker_from_body || record.status == PoseStatus::Predicted) continue;
    known[record.frame] = {*record.tracker_from_body, record.covariance.value_or(covariance_of(stated))};
  }
  if (known.empty()) throw InputError(file.string(), fmt::format("tells no pose of body `{}`", of));
  return known;
}

}  // namespace asterism
