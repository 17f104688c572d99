// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/hand_eye_file.hpp"

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"

namespace asterism {

nlohmann::ordered_json json_of(const HandEye& found, std::size_t views) {
  return {{"schema", "asterism-hand-eye/1"},
          {"body_from_scanner", json_of(found.body_from_scanner)},
          {"views", views},
          {"rms_mm", found.rms_mm},
          {"rms_deg", found.rms_deg},
          {"chi2", found.chi2},
          {"degrees_of_freedom", found.degrees},
          {"reference_from_artefact", json_of(found.reference_from_artefact)},
          {"covariance", json_of(found.covariance)}};
}

KnownMotion read_hand_eye(const std::filesystem::path& file) {
  const auto json = nlohmann::json::parse(read_file(file), nullptr, false);
  return motion_under(json, "body_from_scanner", file,
                      "tells no scanner's place: `body_from_scanner` with `at_mm` and `quaternion_wxyz` is "
                      "needed, as `asterism hand-eye` writes it");
}

}  // namespace asterism
