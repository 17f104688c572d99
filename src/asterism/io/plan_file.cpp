// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/plan_file.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "asterism-plan/1";

Json json_of(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json json_of(const RigidMotion& motion) {
  const Quaternion& q = motion.rotation;
  return {{"position_mm", json_of(motion.translation)},
          {"quaternion_wxyz", Json::array({q.w(), q.x(), q.y(), q.z()})}};
}

Json json_of(const PlannedView& view) {
  return {{"workpiece_from_scanner", json_of(view.workpiece_from_scanner)},
          {"platform_pose", view.platform_pose},
          {"starts_s", view.starts_s},
          {"adds_mm2", view.adds_mm2},
          {"mean_incidence_deg", view.mean_incidence_deg},
          {"beyond_good_incidence", view.beyond_good_incidence},
          {"worst_sigma_mm", view.worst_sigma_mm},
          {"scanner_targets", view.scanner_targets},
          {"platform_targets", view.platform_targets},
          {"measures", view.measures}};
}

Json json_of(const PlatformPose& pose) {
  return {{"yaw_deg", pose.yaw_deg},
          {"pitch_deg", pose.pitch_deg},
          {"roll_deg", pose.roll_deg},
          {"tracker_from_platform", json_of(pose.tracker_from_platform)}};
}

/// Columns rather than rows: thousands of samples.
Json json_of(const std::vector<SurfaceSample>& samples) {
  Json at = Json::array(), normal = Json::array(), triangle = Json::array(), area = Json::array(),
       weight = Json::array();
  for (const SurfaceSample& sample : samples) {
    at.push_back(json_of(sample.at));
    normal.push_back(json_of(sample.normal));
    triangle.push_back(sample.triangle);
    area.push_back(sample.area_mm2);
    weight.push_back(sample.weight);
  }
  return {{"at_mm", at}, {"normal", normal}, {"triangle", triangle}, {"area_mm2", area}, {"weight", weight}};
}

Vec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

RigidMotion motion_of(const Json& json) {
  const Json& q = json.at("quaternion_wxyz");
  return {{q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>()},
          vector_of(json.at("position_mm"))};
}

PlannedView view_of(const Json& json) {
  PlannedView view;
  view.workpiece_from_scanner = motion_of(json.at("workpiece_from_scanner"));
  json.at("platform_pose").get_to(view.platform_pose);
  json.at("starts_s").get_to(view.starts_s);
  json.at("adds_mm2").get_to(view.adds_mm2);
  json.at("mean_incidence_deg").get_to(view.mean_incidence_deg);
  json.at("beyond_good_incidence").get_to(view.beyond_good_incidence);
  json.at("worst_sigma_mm").get_to(view.worst_sigma_mm);
  json.at("scanner_targets").get_to(view.scanner_targets);
  json.at("platform_targets").get_to(view.platform_targets);
  json.at("measures").get_to(view.measures);
  return view;
}

PlatformPose pose_of(const Json& json) {
  return {json.at("yaw_deg"), json.at("pitch_deg"), json.at("roll_deg"),
          motion_of(json.at("tracker_from_platform"))};
}

std::vector<SurfaceSample> samples_of(const Json& json) {
  std::vector<SurfaceSample> samples(json.at("at_mm").size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = {vector_of(json.at("at_mm")[i]), vector_of(json.at("normal").at(i)),
                  json.at("triangle").at(i), json.at("area_mm2").at(i), json.at("weight").at(i)};
  }
  return samples;
}

ScanLimit limit_of(const std::string& words) {
  for (std::size_t i = 0; i < kScanLimits; ++i) {
    if (words == text_of(static_cast<ScanLimit>(i))) return static_cast<ScanLimit>(i);
  }
  throw InputError(fmt::format("`{}` is no limit of a plan", words));
}

/// The samples and poses that are named are there.
void check_indices(const ScanPlan& plan, const std::filesystem::path& file) {
  const auto check = [&](bool holds, std::string_view what, std::size_t number) {
    if (!holds)
      throw InputError(file.string(), fmt::format("it names {} {}, which is not there", what, number));
  };
  for (const std::uint32_t i : plan.covered_before) check(i < plan.samples.size(), "sample", i);
  for (const PlannedView& view : plan.views) {
    check(view.platform_pose < plan.poses.size(), "pose", view.platform_pose);
    for (const std::uint32_t i : view.measures) check(i < plan.samples.size(), "sample", i);
  }
}

ScanPlan plan_of(const Json& json) {
  ScanPlan plan;
  json.at("in_words").get_to(plan.in_words);
  json.at("bound").get_to(plan.bound);
  json.at("optimal").get_to(plan.optimal);
  json.at("greedy_views").get_to(plan.greedy_views);
  json.at("candidates").get_to(plan.candidates);
  const Json& area = json.at("area_mm2");
  area.at("surface").get_to(plan.surface_mm2);
  area.at("reachable").get_to(plan.reachable_mm2);
  area.at("coverable").get_to(plan.coverable_mm2);
  area.at("covered_before").get_to(plan.covered_before_mm2);
  area.at("covered").get_to(plan.covered_mm2);
  for (const Json& cost : json.at("limits")) {
    plan.limits.push_back({limit_of(cost.at("limit")), cost.at("area_mm2")});
  }
  json.at("tour_s").get_to(plan.tour_s);
  json.at("nearest_neighbour_s").get_to(plan.nearest_neighbour_s);
  json.at("remarks").get_to(plan.remarks);
  for (const Json& pose : json.at("poses")) plan.poses.push_back(pose_of(pose));
  for (const Json& view : json.at("views")) plan.views.push_back(view_of(view));
  json.at("covered_before").get_to(plan.covered_before);
  plan.samples = samples_of(json.at("samples"));
  return plan;
}

}  // namespace

void write_plan(const std::filesystem::path& file, const ScanPlan& plan) {
  Json limits = Json::array(), poses = Json::array(), views = Json::array();
  for (const LimitCost& cost : plan.limits) {
    limits.push_back({{"limit", text_of(cost.limit)}, {"area_mm2", cost.area_mm2}});
  }
  for (const PlatformPose& pose : plan.poses) poses.push_back(json_of(pose));
  for (const PlannedView& view : plan.views) views.push_back(json_of(view));
  const Json json = {{"schema", kSchema},
                     {"in_words", plan.in_words},
                     {"bound", plan.bound},
                     {"optimal", plan.optimal},
                     {"greedy_views", plan.greedy_views},
                     {"candidates", plan.candidates},
                     {"area_mm2",
                      {{"surface", plan.surface_mm2},
                       {"reachable", plan.reachable_mm2},
                       {"coverable", plan.coverable_mm2},
                       {"covered_before", plan.covered_before_mm2},
                       {"covered", plan.covered_mm2}}},
                     {"limits", limits},
                     {"tour_s", plan.tour_s},
                     {"nearest_neighbour_s", plan.nearest_neighbour_s},
                     {"remarks", plan.remarks},
                     {"poses", poses},
                     {"views", views},
                     {"covered_before", plan.covered_before},
                     {"samples", json_of(plan.samples)}};
  write_file(file, json.dump(1, '\t') + "\n");
}

ScanPlan read_plan(const std::filesystem::path& file) {
  ScanPlan plan;
  try {
    const Json json = Json::parse(read_file(file));
    if (json.value("schema", "") != kSchema) {
      throw InputError(file.string(), fmt::format("is no plan: its `schema` should be \"{}\"", kSchema));
    }
    plan = plan_of(json);
  } catch (const Json::exception& error) {
    throw InputError(file.string(), fmt::format("is no plan: {}", error.what()));
  }
  check_indices(plan, file);
  return plan;
}

}  // namespace asterism
