// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/pose_columns.hpp"

#include <fmt/format.h>

#include <cmath>

namespace asterism {

RigidMotion motion_of(const CsvTable& table, std::size_t row) {
  const auto at = [&](const char* column) { return table.number(row, column); };
  const Quaternion rotation(at("qw"), at("qx"), at("qy"), at("qz"));
  if (!(std::abs(rotation.norm() - 1) < 1e-3)) {
    table.refuse(row, "qw", fmt::format("qw to qz have length {:.6g}; a rotation's is 1", rotation.norm()));
  }
  return {rotation.normalized(), {at("x_mm"), at("y_mm"), at("z_mm")}};
}

std::optional<Mat6> covariance_of(const CsvTable& table, std::size_t row) {
  constexpr const char* kColumns[] = {"sigma_rx_deg", "sigma_ry_deg", "sigma_rz_deg",
                                      "sigma_x_mm",   "sigma_y_mm",   "sigma_z_mm"};
  Vec6 sigma;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto value = table.optional_number(row, kColumns[i]);
    if (!value) return std::nullopt;
    sigma(i) = i < 3 ? rad_from_deg(*value) : *value;
  }
  return Mat6(sigma.cwiseAbs2().asDiagonal());
}

std::string pose_cells(const RigidMotion& motion) {
  const Vec3& t = motion.translation;
  const Quaternion& q = motion.rotation;
  const double sign = q.w() < 0 ? -1 : 1;
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f}", t.x(), t.y(), t.z(),
                     sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z());
}

std::string sigma_cells(const Mat6& covariance) {
  const Vec6 sigma = covariance.diagonal().cwiseSqrt();
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.7f},{:.7f},{:.7f}", sigma(3), sigma(4), sigma(5),
                     deg_from_rad(sigma(0)), deg_from_rad(sigma(1)), deg_from_rad(sigma(2)));
}

}  // namespace asterism
