// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/alignment_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"

namespace asterism {

nlohmann::ordered_json json_of(const Alignment& alignment) {
  const auto& [rotation, translation] = alignment.platform_from_workpiece;
  nlohmann::ordered_json json = {
      {"schema", "asterism-alignment/1"},
      {"method", alignment.method},
      {"platform_from_workpiece",
       {{"at_mm", {translation.x(), translation.y(), translation.z()}},
        {"quaternion_wxyz", {rotation.w(), rotation.x(), rotation.y(), rotation.z()}}}},
      {"points", alignment.points},
      {"rms_mm", alignment.rms_mm},
      {"chi2", alignment.chi2},
      {"degrees_of_freedom", alignment.degrees},
      {"not_determined", alignment.not_determined}};
  auto& rows = json["covariance"] = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vec6 row = alignment.covariance.row(i);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return json;
}

void write_alignment(const std::filesystem::path& file, const Alignment& alignment) {
  write_file(file, json_of(alignment).dump(2) + "\n");
}

Alignment read_alignment(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  Alignment alignment;
  try {
    const auto json = nlohmann::json::parse(text);
    const auto& pose = json.at("platform_from_workpiece");
    const auto at = pose.at("at_mm").get<std::array<double, 3>>();
    const auto q = pose.at("quaternion_wxyz").get<std::array<double, 4>>();
    alignment.platform_from_workpiece = {Quaternion(q[0], q[1], q[2], q[3]), {at[0], at[1], at[2]}};
    if (json.contains("covariance")) {
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
          alignment.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
              json.at("covariance").at(i).at(j).get<double>();
        }
      }
    }
    alignment.method = json.value("method", "");
    alignment.points = json.value("points", std::size_t{0});
    alignment.rms_mm = json.value("rms_mm", 0.0);
    alignment.chi2 = json.value("chi2", 0.0);
    alignment.degrees = json.value("degrees_of_freedom", 0.0);
    alignment.not_determined = json.value("not_determined", std::vector<std::string>{});
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        file.string(),
        "is no alignment: `platform_from_workpiece` with `at_mm` and `quaternion_wxyz` is needed, as "
        "`asterism align` writes it");
  }
  Quaternion& rotation = alignment.platform_from_workpiece.rotation;
  constexpr double kUnit = 1e-3;
  if (!(std::abs(rotation.norm() - 1) < kUnit)) {
    throw InputError(file.string(),
                     fmt::format("`quaternion_wxyz` has length {:.6g}; it must be 1", rotation.norm()));
  }
  rotation.normalize();
  return alignment;
}

}  // namespace asterism
