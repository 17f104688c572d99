// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/scan_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/report/base64.hpp"
#include "asterism/report/cell_json.hpp"
#include "asterism/report/display_cloud.hpp"
#include "asterism/report/page_json.hpp"

namespace asterism {

using Json = nlohmann::json;

namespace {

/// The fields of a cloud that a page shows; `whole` ones are counts and numbers.
struct ShownField {
  const char* name;
  bool whole;
};
constexpr std::array<ShownField, 6> kShownFields = {{{"sigma_mm", false},
                                                     {"points", true},
                                                     {"scans", true},
                                                     {"scan", true},
                                                     {"incidence_deg", false},
                                                     {"range_mm", false}}};

/// A bit a sample, the lowest of each byte first.
class Bits {
 public:
  explicit Bits(std::size_t count) : count_(count), bytes_((count + 7) / 8) {}
  void set(std::size_t i) {
    require(i < count_, "a sample that is told of is in the list");
    bytes_[i / 8] = static_cast<std::uint8_t>(bytes_[i / 8] | 1U << (i % 8));
  }
  [[nodiscard]] std::string text() const { return base64(bytes_); }

 private:
  std::size_t count_;
  std::vector<std::uint8_t> bytes_;
};

std::string bits_of(const std::vector<std::uint32_t>& which, std::size_t count) {
  Bits bits(count);
  for (const std::uint32_t i : which) bits.set(i);
  return bits.text();
}

template <typename Vector>
std::uint8_t byte_of(const Vector& direction, int axis) {
  const double part = std::clamp(static_cast<double>(direction[axis]), -1.0, 1.0);
  return static_cast<std::uint8_t>(std::isfinite(part) ? static_cast<int>(std::lround(127 * part)) : 0);
}

Json of_samples(const std::vector<SurfaceSample>& samples) {
  std::vector<float> places, areas;
  std::vector<std::uint8_t> normals;
  for (const SurfaceSample& sample : samples) {
    for (int axis = 0; axis < 3; ++axis) {
      places.push_back(static_cast<float>(sample.at[axis]));
      normals.push_back(byte_of(sample.normal, axis));
    }
    areas.push_back(static_cast<float>(sample.area_mm2));
  }
  return {{"places", base64(places)}, {"normals", base64(normals)}, {"areas_mm2", base64(areas)}};
}

bool are_same(const std::vector<SurfaceSample>& a, const std::vector<SurfaceSample>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.at == other.at && one.normal == other.normal && one.area_mm2 == other.area_mm2;
  });
}

Json of_view(const PlannedView& view, const ScanPlan& plan) {
  require(view.platform_pose < plan.poses.size(), "a view's platform pose is one of the plan's");
  require(is_finite(view.workpiece_from_scanner), "a view's pose is finite");
  return {{"pose", json_of_motion(view.workpiece_from_scanner)},
          {"platform", view.platform_pose},
          {"measures", bits_of(view.measures, plan.samples.size())},
          {"adds_mm2", digits(view.adds_mm2, 6)},
          {"mean_incidence_deg", digits(view.mean_incidence_deg, 4)},
          {"beyond_good_incidence", digits(view.beyond_good_incidence, 4)},
          {"worst_sigma_mm", digits(view.worst_sigma_mm, 4)},
          {"scanner_targets", view.scanner_targets},
          {"platform_targets", view.platform_targets},
          {"starts_s", digits(view.starts_s, 7)}};
}

Json of_summary(const DeviationSummary& summary) {
  return {{"region", summary.region},
          {"points", summary.points},
          {"beyond", summary.beyond},
          {"mean_mm", digits(summary.mean_mm, 5)},
          {"rms_mm", digits(summary.rms_mm, 5)},
          {"sigma_mm", digits(summary.sigma_mm, 5)},
          {"p05_mm", digits(summary.p05_mm, 5)},
          {"median_mm", digits(summary.median_mm, 5)},
          {"p95_mm", digits(summary.p95_mm, 5)},
          {"lowest_mm", digits(summary.lowest_mm, 5)},
          {"highest_mm", digits(summary.highest_mm, 5)},
          {"in_tolerance", digits(summary.in_tolerance, 6)},
          {"below", digits(summary.below, 6)},
          {"above", digits(summary.above, 6)},
          {"predicted_rms_mm", digits(summary.predicted_rms_mm, 5)}};
}

}  // namespace

int SampleLists::place_of(const std::vector<SurfaceSample>& samples) {
  if (samples.empty()) return -1;
  const auto known =
      std::find_if(lists_.begin(), lists_.end(), [&](const auto* list) { return are_same(*list, samples); });
  const auto place = static_cast<int>(known - lists_.begin());
  if (known == lists_.end()) lists_.push_back(&samples);
  return place;
}

Json SampleLists::json() const {
  Json lists = Json::array();
  for (const auto* list : lists_) lists.push_back(of_samples(*list));
  return lists;
}

Json json_of_scanner(const Scanner& scanner) {
  return {{"stand_off_mm", digits(scanner.stand_off_mm, 6)},
          {"near_mm", digits(scanner.near_mm, 6)},
          {"far_mm", digits(scanner.far_mm, 6)},
          {"field_width_mm", digits(scanner.field_width_mm, 6)},
          {"field_height_mm", digits(scanner.field_height_mm, 6)},
          {"baseline_mm", digits(scanner.baseline_mm, 6)},
          {"max_incidence_deg", digits(scanner.max_incidence_deg, 6)},
          {"good_incidence_deg", digits(scanner.good_incidence_deg, 6)}};
}

Json json_of_plan(const ScanPlan& plan, SampleLists& lists) {
  Json poses = Json::array(), views = Json::array(), limits = Json::array();
  for (const PlatformPose& pose : plan.poses)
    poses.push_back({{"yaw_deg", digits(pose.yaw_deg, 6)},
                     {"pitch_deg", digits(pose.pitch_deg, 6)},
                     {"roll_deg", digits(pose.roll_deg, 6)}});
  for (const PlannedView& view : plan.views) views.push_back(of_view(view, plan));
  for (const LimitCost& cost : plan.limits)
    limits.push_back({{"limit", std::string(text_of(cost.limit))}, {"area_mm2", digits(cost.area_mm2, 6)}});
  return {{"samples", lists.place_of(plan.samples)},
          {"poses", poses},
          {"views", views},
          {"bound", plan.bound},
          {"optimal", plan.optimal},
          {"greedy_views", plan.greedy_views},
          {"candidates", plan.candidates},
          {"in_words", plan.in_words},
          {"surface_mm2", digits(plan.surface_mm2, 7)},
          {"reachable_mm2", digits(plan.reachable_mm2, 7)},
          {"coverable_mm2", digits(plan.coverable_mm2, 7)},
          {"covered_before_mm2", digits(plan.covered_before_mm2, 7)},
          {"covered_mm2", digits(plan.covered_mm2, 7)},
          {"limits", limits},
          {"covered_before", bits_of(plan.covered_before, plan.samples.size())},
          {"tour_s", digits(plan.tour_s, 7)},
          {"nearest_neighbour_s", digits(plan.nearest_neighbour_s, 7)},
          {"remarks", plan.remarks}};
}

Json json_of_completeness(const Completeness& completeness, const std::vector<SurfaceSample>& samples,
                          SampleLists& lists) {
  require(completeness.measured.size() == samples.size(), "completeness tells of each sample");
  Bits measured(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (completeness.measured[i] != 0) measured.set(i);
  Json holes = Json::array();
  for (const Hole& hole : completeness.holes) {
    holes.push_back({{"area_mm2", digits(hole.area_mm2, 6)},
                     {"centre", json_of(hole.centre, 3)},
                     {"normal", json_of(hole.normal, 4)},
                     {"across_mm", digits(hole.across_mm, 5)},
                     {"samples", base64(hole.samples)}});
    for (const std::uint32_t i : hole.samples) require(i < samples.size(), "a hole is made of samples");
  }
  return {{"samples", lists.place_of(samples)},
          {"measured", measured.text()},
          {"surface_mm2", digits(completeness.surface_mm2, 7)},
          {"measured_mm2", digits(completeness.measured_mm2, 7)},
          {"holes", holes}};
}

Json json_of_deviation(const Deviation& deviation) {
  Json regions = Json::array();
  for (const DeviationSummary& region : deviation.regions) regions.push_back(of_summary(region));
  return {{"whole", of_summary(deviation.whole)},
          {"regions", regions},
          {"bin_mm", digits(deviation.bin_mm, 6)},
          {"histogram", deviation.histogram}};
}

Json json_of_cloud(const Cloud& cloud, const std::vector<double>& deviation_mm, std::size_t most) {
  const DisplayCloud drawn = thinned(cloud, most);
  const PackedPlaces places = packed_places(cloud, drawn.points);
  std::vector<std::uint8_t> normals;
  if (!cloud.normals.empty()) {
    for (const std::uint32_t i : drawn.points)
      for (int axis = 0; axis < 3; ++axis) normals.push_back(byte_of(cloud.normals[i], axis));
  }
  Json fields = Json::array();
  const auto add = [&](const char* name, bool whole, const std::vector<double>& values) {
    require(values.size() == cloud.size(), "a cloud's field has a value a point");
    fields.push_back({{"name", name},
                      {"whole", whole},
                      {"values", base64(whole ? packed_counts(values, drawn.points)
                                              : packed_reals(values, drawn.points))}});
  };
  if (!deviation_mm.empty()) add("deviation_mm", false, deviation_mm);
  for (const auto& [name, whole] : kShownFields)
    if (const std::vector<double>* values = cloud.field(name)) add(name, whole, *values);
  return {{"points", cloud.size()},
          {"drawn", drawn.points.size()},
          {"voxel_mm", digits(drawn.voxel_mm, 4)},
          {"low_mm", json_of(places.low, 5)},
          {"step_mm", digits(places.step_mm, 9)},
          {"places", base64(places.steps)},
          {"normals", base64(normals)},
          {"fields", fields}};
}

}  // namespace asterism
