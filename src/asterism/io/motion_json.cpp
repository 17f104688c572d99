// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/motion_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "asterism/core/result.hpp"

namespace asterism {

nlohmann::ordered_json json_of(const RigidMotion& motion) {
  const auto& [rotation, translation] = motion;
  return {{"at_mm", {translation.x(), translation.y(), translation.z()}},
          {"quaternion_wxyz", {rotation.w(), rotation.x(), rotation.y(), rotation.z()}}};
}

nlohmann::ordered_json json_of(const Mat6& covariance) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vec6 row = covariance.row(i);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

KnownMotion motion_under(const nlohmann::json& json, const std::string& key,
                         const std::filesystem::path& file, const std::string& hint) {
  KnownMotion known;
  try {
    const auto& pose = json.at(key);
    const auto at = pose.at("at_mm").get<std::array<double, 3>>();
    const auto q = pose.at("quaternion_wxyz").get<std::array<double, 4>>();
    known.motion = {Quaternion(q[0], q[1], q[2], q[3]), {at[0], at[1], at[2]}};
    if (json.contains("covariance")) {
      for (Eigen::Index i = 0; i < 6; ++i) {
        for (Eigen::Index j = 0; j < 6; ++j) {
          known.covariance(i, j) =
              json.at("covariance").at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
        }
      }
    }
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), hint);
  }
  constexpr double kUnit = 1e-3;
  const double length = known.motion.rotation.norm();
  if (!(std::abs(length - 1) < kUnit)) {
    throw InputError(file.string(), fmt::format("`quaternion_wxyz` has length {:.6g}; it must be 1", length));
  }
  known.motion.rotation.normalize();
  return known;
}

}  // namespace asterism
