// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/page_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"

namespace asterism {

using Json = nlohmann::json;

namespace {

Json of_lens(const Lens& lens) {
  Json coefficients = Json::array();
  for (int i = 0; i < lens.coefficients; ++i)
    coefficients.push_back(digits(lens.distortion[static_cast<std::size_t>(i)], 9));
  return {{"fx", digits(lens.fx, 9)},  {"fy", digits(lens.fy, 9)},   {"skew", digits(lens.skew, 9)},
          {"cx", digits(lens.cx, 9)},  {"cy", digits(lens.cy, 9)},   {"distortion", coefficients},
          {"width_px", lens.width_px}, {"height_px", lens.height_px}};
}

}  // namespace

Json decimals(double value, int places) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.{}f}", value, places).c_str(), nullptr);
}

Json digits(double value, int count) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.{}g}", value, count).c_str(), nullptr);
}

Json json_of(const Vec3& v, int places) {
  return {decimals(v.x(), places), decimals(v.y(), places), decimals(v.z(), places)};
}

void append_motion(Json& row, const RigidMotion& motion) {
  for (const double value : motion.translation) row.push_back(decimals(value, 5));
  const Quaternion& q = motion.rotation;
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) row.push_back(decimals(value, 9));
}

Json json_of_motion(const RigidMotion& motion) {
  Json row = Json::array();
  append_motion(row, motion);
  return row;
}

void append_upper(Json& row, const Mat3& covariance) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) row.push_back(digits(covariance(i, j), 5));
}

bool is_finite(const RigidMotion& motion) {
  return motion.translation.allFinite() && motion.rotation.coeffs().allFinite();
}

Json json_of_rig(const StereoRig& rig) {
  return {{"left", of_lens(rig.left)},
          {"right", of_lens(rig.right)},
          {"right_from_left", json_of_motion(rig.right_from_left)}};
}

Json json_of_volume(const std::optional<WorkingVolume>& volume, const StereoRig& rig) {
  if (!volume) return nullptr;
  return {{"pose", json_of_motion(tracker_from_middle(rig))},
          {"near_mm", volume->near_mm},
          {"far_mm", volume->far_mm},
          {"near_size_mm", {volume->near_width_mm, volume->near_height_mm}},
          {"far_size_mm", {volume->far_width_mm, volume->far_height_mm}},
          {"m3", digits(volume_m3(*volume), 3)}};
}

Json json_of_target(const Target& target) {
  Json json = {{"id", target.id}, {"position_mm", json_of(target.position)}};
  if (target.normal) json["normal"] = json_of(*target.normal, 6);
  if (target.diameter_mm) json["diameter_mm"] = digits(*target.diameter_mm, 6);
  return json;
}

const char* word_of(Verdict verdict) {
  constexpr std::array<const char*, 4> kVerdicts = {"plain", "good", "attention", "bad"};
  return kVerdicts.at(static_cast<std::size_t>(verdict));
}

Json json_of_summary(const std::vector<SummaryRow>& rows) {
  Json json = Json::array();
  for (const SummaryRow& row : rows) {
    json.push_back({{"label", row.label},
                    {"value", row.value},
                    {"unit", row.unit},
                    {"note", row.note},
                    {"verdict", word_of(row.verdict)}});
  }
  return json;
}

Json json_of_stored(const std::string& text) {
  if (text.empty()) return nullptr;
  Json options = Json::parse(text, nullptr, false);
  require(!options.is_discarded(), "a report's options are JSON");
  return options;
}

}  // namespace asterism
