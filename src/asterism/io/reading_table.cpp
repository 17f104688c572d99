// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/reading_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/cell/platform.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/pose_columns.hpp"

namespace asterism {
namespace {

Mat6 usual_covariance() {
  const ReadOut usual;
  const double low = usual.jump_low_mm, high = usual.jump_high_mm;
  const double jumps = usual.jump_share * (low * low + low * high + high * high) / 9;  // along each axis
  Mat6 covariance = Mat6::Zero();
  covariance.diagonal().head<3>().setConstant(std::pow(rad_from_deg(usual.rotation_sigma_deg), 2));
  covariance.diagonal().tail<3>().setConstant(std::pow(usual.translation_sigma_mm, 2) + jumps);
  return covariance;
}

}  // namespace

std::vector<PlatformReading> read_readings(const std::filesystem::path& file) {
  const CsvTable table(file, {"time_s", "x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"});
  std::vector<PlatformReading> readings(table.rows());
  for (std::size_t row = 0; row < readings.size(); ++row) {
    PlatformReading& reading = readings[row];
    reading.time_s = table.number(row, "time_s");
    if (row > 0 && !(reading.time_s > readings[row - 1].time_s)) {
      table.refuse(row, "time_s",
                   fmt::format("{} s does not come after the row before ({} s); readings must be in order of "
                               "time",
                               reading.time_s, readings[row - 1].time_s));
    }
    reading.base_from_body = motion_of(table, row);
    reading.covariance = covariance_of(table, row).value_or(usual_covariance());
    if (!(reading.covariance.diagonal().minCoeff() > 0)) {
      table.refuse(row, "sigma_x_mm", "a sigma is not above 0; nothing is known without error");
    }
  }
  return readings;
}

void write_readings(const std::filesystem::path& file, std::span<const PlatformReading> readings) {
  std::string text =
      "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,sigma_x_mm,sigma_y_mm,sigma_z_mm,sigma_rx_deg,sigma_ry_deg,"
      "sigma_rz_deg\n";
  for (const PlatformReading& reading : readings) {
    text += fmt::format("{},{},{}\n", reading.time_s, pose_cells(reading.base_from_body),
                        sigma_cells(reading.covariance));
  }
  write_file(file, text);
}

}  // namespace asterism
