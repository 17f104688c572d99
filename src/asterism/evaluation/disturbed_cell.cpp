// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/disturbed_cell.hpp"

#include <cmath>
#include <utility>

#include "asterism/core/random.hpp"

namespace asterism {
namespace {

// Purposes of the random streams.
constexpr std::uint32_t kCalibration = 0x63616c69, kMap = 0x6d617073, kWarmth = 0x77617268,
                        kLatency = 0x6c617465;

VecX normals(RandomStream random, Eigen::Index count) {
  VecX draw(count);
  for (double& value : draw) value = random.normal();
  return draw;
}

VecX sigmas_of(const Cell& cell) {
  const NoiseModel& noise = cell.noise;
  const std::vector<std::string> names = rig_parameter_names(cell.rig);
  VecX sigmas = VecX::Zero(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    double& sigma = sigmas(static_cast<Eigen::Index>(i));
    if (name[0] == 'f') sigma = noise.focal_sigma_px;
    if (name[0] == 'c') sigma = noise.principal_sigma_px;
    if (name == "rx" || name == "ry" || name == "rz") sigma = rad_from_deg(noise.turn_sigma_deg);
    if (name == "tx" || name == "ty" || name == "tz") sigma = noise.baseline_sigma_mm;
  }
  return sigmas;
}

/// Of a covariance, which may be singular and whose entries may be of very different size.
MatX root_of(const MatX& covariance) {
  if (covariance.size() == 0) return {};
  const VecX sigma = covariance.diagonal().cwiseSqrt();
  const VecX inverse = sigma.unaryExpr([](double s) { return s > 0 ? 1 / s : 0.0; });
  return sigma.asDiagonal() * symmetric_root(inverse.asDiagonal() * covariance * inverse.asDiagonal());
}

void add_to_lens(Lens& lens, const VecX& error, Eigen::Index& next) {
  for (double* value : {&lens.fx, &lens.fy, &lens.skew, &lens.cx, &lens.cy}) *value += error(next++);
  for (int i = 0; i < lens.coefficients; ++i) lens.distortion[static_cast<std::size_t>(i)] += error(next++);
}

}  // namespace

std::string_view text_of(ErrorSource source) {
  static constexpr std::array<std::string_view, kErrorSources> kWords = {
      "detection", "calibration", "map", "motion", "latency", "thermal"};
  return kWords[static_cast<std::size_t>(source)];
}

MatX calibration_covariance(const Cell& cell) {
  if (cell.rig.covariance.size() > 0) return cell.rig.covariance;
  const VecX sigmas = sigmas_of(cell);
  if (!(sigmas.maxCoeff() > 0)) return {};
  return sigmas.cwiseAbs2().asDiagonal();
}

Mat3 map_covariance(const Target& target, const NoiseModel& noise) {
  if (target.covariance) return *target.covariance;
  return Mat3::Identity() * (noise.map_sigma_mm * noise.map_sigma_mm);
}

StereoRig rig_with_error(StereoRig rig, const VecX& error) {
  Eigen::Index next = 0;
  add_to_lens(rig.left, error, next);
  add_to_lens(rig.right, error, next);
  rig.right_from_left = perturbed(rig.right_from_left, error.segment<6>(next));
  return rig;
}

Vec3 fixed_point(const Cell& cell, const Body& body) {
  if (cell.platform && cell.platform->body == body.name) return cell.platform->pivot_mm;
  return Vec3::Zero();
}

Belief exact_belief(const Cell& cell) {
  Belief belief{cell.rig, bodies_of(cell), 0};
  belief.rig.covariance.resize(0, 0);
  belief.rig.covariance_order.clear();
  for (Body& body : belief.bodies) {
    for (Target& target : body.targets) target.covariance.reset();
  }
  return belief;
}

Belief stated_belief(const Cell& cell) {
  Belief belief{cell.rig, bodies_of(cell), 0};
  belief.rig.covariance = calibration_covariance(cell);
  if (belief.rig.covariance.size() > 0) belief.rig.covariance_order = rig_parameter_names(cell.rig);
  for (Body& body : belief.bodies) {
    for (Target& target : body.targets) {
      const Mat3 covariance = map_covariance(target, cell.noise);
      if (covariance.trace() > 0) target.covariance = covariance;
    }
  }
  return belief;
}

Disturber::Disturber(Cell cell, std::uint64_t seed)
    : cell_(std::move(cell)),
      stated_(stated_belief(cell_)),
      root_(root_of(stated_.rig.covariance)),
      seed_(seed) {
  for (const Body& body : stated_.bodies) {
    std::vector<Mat3>& roots = roots_.emplace_back();
    for (const Target& target : body.targets)
      roots.push_back(target.covariance ? Mat3(symmetric_root(*target.covariance)) : Mat3(Mat3::Zero()));
  }
}

Belief Disturber::belief(std::uint64_t run) const {
  Belief belief{rig(calibration_draw(run)), {}, cell_.noise.latency_s};
  belief.latency_s += cell_.noise.latency_sigma_s * RandomStream(seed_, run, kLatency).normal();
  const double warming_k = cell_.noise.temperature_k + cell_.noise.temperature_sigma_k * warmth_draw(run);
  for (std::size_t mover = 0; mover < stated_.bodies.size(); ++mover)
    belief.bodies.push_back(body(mover, map_draw(run, mover), warming_k));
  return belief;
}

StereoRig Disturber::rig(const VecX& normal) const {
  return root_.size() == 0 ? stated_.rig : rig_with_error(stated_.rig, root_ * normal);
}

Body Disturber::body(std::size_t mover, const VecX& map, double warming_k) const {
  Body body = stated_.bodies[mover];
  const double growth = 1 + 1e-6 * cell_.noise.expansion_ppm_k * warming_k;
  const Vec3 fixed = fixed_point(cell_, body);
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    Vec3& place = body.targets[i].position;
    place = fixed + (place - fixed) / growth;
    place += roots_[mover][i] * map.segment<3>(3 * static_cast<Eigen::Index>(i));
  }
  return body;
}

VecX Disturber::calibration_draw(std::uint64_t run) const {
  return normals(RandomStream(seed_, run, kCalibration), root_.cols());
}

VecX Disturber::map_draw(std::uint64_t run, std::size_t mover) const {
  const auto targets = static_cast<Eigen::Index>(stated_.bodies[mover].targets.size());
  return normals(RandomStream(seed_, run << 8 | mover, kMap), 3 * targets);
}

double Disturber::warmth_draw(std::uint64_t run) const { return RandomStream(seed_, run, kWarmth).normal(); }

}  // namespace asterism
