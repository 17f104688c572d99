// SPDX-License-Identifier: Apache-2.0
// How good poses are against their Cramér–Rao bound and against other ways to make them, and how long they
// take.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>

#include "asterism/geometry/rigid_fit.hpp"
#include "asterism/tracking/pose_model.hpp"
#include "asterism/tracking/scene_for_tests.hpp"
#include "asterism/tracking/triangulation.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

constexpr double kArm_mm = 500;  // from the targets' middle to the point where the error is told

/// One draw: views of the body, the points they make, the truth.
struct Draw {
  RigidMotion truth;
  std::vector<TargetView> views;
  std::vector<Vec3> in_tracker, in_body;
  std::vector<Mat3> covariance;
};

struct Setting {
  double sigma_px, range_mm;
  int coefficients = 0;
  std::vector<int> both = {0, 1, 2, 3, 4, 5};  // targets seen by both cameras
  std::vector<int> left = {}, right = {};      // by one alone
};

Draw draw(const Setting& setting, const StereoRig& rig, const Body& body, std::uint64_t index) {
  RandomStream random(2026, index);
  Draw d;
  d.truth = scene::pose(random, 15, setting.range_mm);
  d.views = scene::views(rig, body, d.truth, setting.both, setting.sigma_px, random);
  for (std::size_t i = 0; i < d.views.size(); i += 2) {
    // The alternatives take centres as images of points; a point body (no normals) gives them their best.
    const auto point = triangulate_pair(rig, d.views[i].px, d.views[i].covariance, d.views[i + 1].px,
                                        d.views[i + 1].covariance);
    d.in_tracker.push_back(point->in_tracker);
    d.covariance.push_back(point->covariance);
    d.in_body.push_back(body.targets[static_cast<std::size_t>(d.views[i].target)].position);
  }
  for (const int target : setting.left)
    d.views.push_back(scene::view(rig, body, d.truth, target, Side::Left, setting.sigma_px, random));
  for (const int target : setting.right)
    d.views.push_back(scene::view(rig, body, d.truth, target, Side::Right, setting.sigma_px, random));
  return d;
}

using Method = std::function<std::optional<RigidMotion>(const Draw&)>;

/// Gauss–Newton on the points with each one's covariance.
std::optional<RigidMotion> anisotropic_fit(const Draw& d) {
  const auto start = fit_rigid_motion(d.in_tracker, d.in_body);
  if (!start) return std::nullopt;
  RigidMotion pose = start->a_from_b;
  for (int iteration = 0; iteration < 5; ++iteration) {
    Mat6 information = Mat6::Zero();
    Vec6 gradient = Vec6::Zero();
    for (std::size_t i = 0; i < d.in_body.size(); ++i) {
      Mat36 by;
      by << -skew(pose.rotation * d.in_body[i]), Mat3::Identity();
      const Mat3 weight = d.covariance[i].inverse();
      information += by.transpose() * weight * by;
      gradient += by.transpose() * weight * (d.in_tracker[i] - pose * d.in_body[i]);
    }
    const auto step = solve_positive(information, gradient);
    if (!step) return std::nullopt;
    pose = perturbed(pose, *step);
  }
  return pose;
}

struct Errors {
  double turn_deg = 0, middle_mm = 0, arm_mm = 0;  // RMS
  int failed = 0;
};

Errors errors_of(const Method& method, const Setting& setting, const StereoRig& rig, const Body& body,
                 int draws) {
  Vec3 middle = Vec3::Zero();
  for (const Target& target : body.targets)
    middle += target.position / static_cast<double>(body.targets.size());
  Errors e;
  for (int i = 0; i < draws; ++i) {
    const Draw d = draw(setting, rig, body, static_cast<std::uint64_t>(i));
    const auto pose = method(d);
    if (!pose) {
      ++e.failed;
      continue;
    }
    e.turn_deg += std::pow(deg_from_rad(difference(*pose, d.truth).head<3>().norm()), 2);
    e.middle_mm += (*pose * middle - d.truth * middle).squaredNorm();
    const Vec3 arm = middle + Vec3(0, 0, -kArm_mm);
    e.arm_mm += (*pose * arm - d.truth * arm).squaredNorm();
  }
  const double n = draws - e.failed;
  return {std::sqrt(e.turn_deg / n), std::sqrt(e.middle_mm / n), std::sqrt(e.arm_mm / n), e.failed};
}

Method reprojection(const StereoRig& rig, const Body& body) {
  return [&](const Draw& d) -> std::optional<RigidMotion> {
    const auto start = fit_rigid_motion(d.in_tracker, d.in_body);
    const auto found = estimate_pose(body, d.views, rig, start->a_from_b, {});
    if (!found) return std::nullopt;
    return found->estimate.tracker_from_body;
  };
}

Method kabsch() {
  return [](const Draw& d) -> std::optional<RigidMotion> {
    return fit_rigid_motion(d.in_tracker, d.in_body)->a_from_b;
  };
}

Method three_points() {
  return [](const Draw& d) -> std::optional<RigidMotion> {
    return three_point_motion(d.in_tracker, d.in_body)->a_from_b;
  };
}

/// Against the bound: the inverse information at the truth.
void print_bound_table(int draws) {
  bench::Table table(
      fmt::format("Pose against its Cramer-Rao bound, {} draws, scheme S3, f 2400 px, b 1 m, +-15 deg",
                  draws),
      {"setting", "rotation/CRB", "translation/CRB", "NEES/6", "in 95 %", "failed"});
  const Body body = scene::body();
  const std::vector<std::pair<std::string, Setting>> settings = {
      {"0.02 px 2.25 m", {0.02, 2250}},
      {"0.02 px 5 coeff", {0.02, 2250, 5}},
      {"0.10 px 3.5 m", {0.10, 3500}},
      {"4 both 2 mono", {0.02, 2250, 0, {0, 2, 3, 4}, {1}, {5}}},
      {"3 both", {0.02, 2250, 0, {0, 2, 3}, {}, {}}},
      {"3 both 3 mono", {0.02, 2250, 0, {0, 2, 3}, {1, 4}, {5}}}};
  for (const auto& [name, setting] : settings) {
    const StereoRig rig = scene::rig(setting.coefficients);
    PoseOptions options;
    options.sigma_floor_px = 0;  // the draws have no error but their sigma
    double turn = 0, turn_bound = 0, shift = 0, shift_bound = 0, nees = 0;
    int inside = 0, failed = 0;
    for (int i = 0; i < draws; ++i) {
      const Draw d = draw(setting, rig, body, static_cast<std::uint64_t>(i));
      const auto start = fit_rigid_motion(d.in_tracker, d.in_body);
      const auto found = estimate_pose(body, d.views, rig, start->a_from_b, options);
      if (!found) {
        ++failed;
        continue;
      }
      const PoseProblem problem(body, d.views, rig, options);
      const Mat6 bound = *inverse_positive(problem.at(d.truth)->information);
      const Vec6 error = difference(found->estimate.tracker_from_body, d.truth);
      turn += error.head<3>().squaredNorm();
      turn_bound += bound.topLeftCorner<3, 3>().trace();
      const Vec3 middle(-15, -2, 596);
      shift += (found->estimate.tracker_from_body * middle - d.truth * middle).squaredNorm();
      shift_bound += covariance_of_point(d.truth, bound, middle).trace();
      const double square = error.dot(*solve_positive(found->estimate.covariance, error));
      nees += square / 6;
      inside += square < 12.5916 ? 1 : 0;  // 95 % of chi-square with six degrees
    }
    const double n = draws - failed;
    table.row({name, fmt::format("{:.4f}", std::sqrt(turn / turn_bound)),
               fmt::format("{:.4f}", std::sqrt(shift / shift_bound)), fmt::format("{:.4f}", nees / n),
               fmt::format("{:.2f} %", 100 * inside / n), fmt::format("{}", failed)});
  }
  table.print_json();
}

void print_alternatives_table(int draws) {
  bench::Table table(
      fmt::format("Rotation RMS deg / error RMS mm {} mm from the targets, {} draws", kArm_mm, draws),
      {"sigma, range", "three-point", "Kabsch", "anisotropic 3-D", "reprojection", "Kabsch 4",
       "reproj 4 + 2 mono"});
  const StereoRig rig = scene::rig();
  Body body = scene::body();
  for (Target& target : body.targets) target.normal.reset();  // points: the alternatives know no discs
  for (const auto& [sigma, range] :
       {std::pair(0.01, 1500.0), {0.02, 2500.0}, {0.02, 3500.0}, {0.05, 2500.0}}) {
    const Setting all{sigma, range};
    const Setting hidden{sigma, range, 0, {0, 2, 3, 4}, {1}, {5}};
    const auto cell = [&](const Method& method, const Setting& setting) {
      const Errors e = errors_of(method, setting, rig, body, draws);
      return fmt::format("{:.4f} / {:.3f}", e.turn_deg, e.arm_mm);
    };
    table.row({fmt::format("{} px, {} m", sigma, range / 1000), cell(three_points(), all),
               cell(kabsch(), all), cell(anisotropic_fit, all), cell(reprojection(rig, body), all),
               cell(kabsch(), hidden), cell(reprojection(rig, body), hidden)});
  }
  table.print_json();
}

void print_times() {
  bench::Table table("Microseconds a pose, 6 targets in 2 cameras, start from the rigid fit, one thread",
                     {"what", "us"});
  const Body body = scene::body();
  Body uncertain = body;
  for (Target& target : uncertain.targets) target.covariance = 1e-4 * Mat3::Identity();
  const auto time = [&](const std::string& name, const StereoRig& rig, const Body& shape) {
    const Draw d = draw({0.02, 2250}, rig, shape, 1);
    const RigidMotion start = fit_rigid_motion(d.in_tracker, d.in_body)->a_from_b;
    const double s = bench::median_seconds([&] { (void)estimate_pose(shape, d.views, rig, start, {}); });
    table.row({name, fmt::format("{:.2f}", 1e6 * s)});
  };
  time("pinhole", scene::rig(0), body);
  time("5 coefficients", scene::rig(5), body);
  time("body covariance", scene::rig(0), uncertain);
  StereoRig calibrated = scene::rig(5);
  calibrated.covariance_order = rig_parameter_names(calibrated);
  calibrated.covariance = 1e-8 * MatX::Identity(26, 26);
  time("rig covariance", calibrated, body);
  const Draw d = draw({0.02, 2250}, scene::rig(), body, 1);
  table.row({"Kabsch alone", fmt::format("{:.2f}", 1e6 * bench::median_seconds([&] {
                                                     (void)fit_rigid_motion(d.in_tracker, d.in_body);
                                                   }))});
  table.print_json();
}

}  // namespace

int main(int argc, char** argv) {
  const int draws = argc > 1 ? std::atoi(argv[1]) : 10000;
  print_bound_table(draws);
  print_alternatives_table(std::min(draws, 4000));
  print_times();
  return 0;
}
