// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/alignment_file.hpp"

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/motion_json.hpp"

namespace asterism {

nlohmann::ordered_json json_of(const Alignment& alignment) {
  return {{"schema", "asterism-alignment/1"},
          {"method", alignment.method},
          {"platform_from_workpiece", json_of(alignment.platform_from_workpiece)},
          {"points", alignment.points},
          {"rms_mm", alignment.rms_mm},
          {"chi2", alignment.chi2},
          {"degrees_of_freedom", alignment.degrees},
          {"not_determined", alignment.not_determined},
          {"covariance", json_of(alignment.covariance)}};
}

void write_alignment(const std::filesystem::path& file, const Alignment& alignment) {
  write_file(file, json_of(alignment).dump(2) + "\n");
}

Alignment read_alignment(const std::filesystem::path& file) {
  const std::string hint =
      "is no alignment: `platform_from_workpiece` with `at_mm` and `quaternion_wxyz` is needed, as "
      "`asterism align` writes it";
  const auto json = nlohmann::json::parse(read_file(file), nullptr, false);
  const KnownMotion known = motion_under(json, "platform_from_workpiece", file, hint);
  Alignment alignment;
  alignment.platform_from_workpiece = known.motion;
  alignment.covariance = known.covariance;
  try {
    alignment.method = json.value("method", "");
    alignment.points = json.value("points", std::size_t{0});
    alignment.rms_mm = json.value("rms_mm", 0.0);
    alignment.chi2 = json.value("chi2", 0.0);
    alignment.degrees = json.value("degrees_of_freedom", 0.0);
    alignment.not_determined = json.value("not_determined", std::vector<std::string>{});
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), hint);
  }
  return alignment;
}

}  // namespace asterism
