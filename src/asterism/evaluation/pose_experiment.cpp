// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/pose_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/camera/disc_image.hpp"
#include "asterism/camera/two_view.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

constexpr std::array<Side, 2> kSides = {Side::Left, Side::Right};

Disc disc_of(const Target& target, const RigidMotion& camera_from_body) {
  return {camera_from_body * target.position,
          target.normal ? Vec3(camera_from_body.rotation * *target.normal) : Vec3(Vec3::UnitZ()),
          target.imaged_radius_mm()};
}

double centre_variance(const Target& target, const Disc& disc, const Lens& lens,
                       const AccuracyOptions& noise) {
  double variance = noise.sigma_px * noise.sigma_px;
  if (!noise.bound || !target.diameter_mm) return variance;
  const double cosine = target.normal ? -disc.normal.dot(disc.centre) / disc.centre.norm() : 1.0;
  const double semi_minor =
      std::sqrt(lens.fx * lens.fy) * 0.5 * *target.diameter_mm / disc.centre.z() * std::max(cosine, 1e-3);
  variance += noise.bound->variance_times_px(std::acos(std::clamp(cosine, -1.0, 1.0))) / semi_minor;
  return variance;
}

Result<RigidMotion, PoseFailure> pose_of_points(const Body& body, const StereoRig& rig,
                                                std::span<const TargetView> views, Estimator estimator) {
  std::vector<Vec3> in_tracker, in_body;
  for (std::size_t i = 0; i + 1 < views.size(); ++i) {
    if (views[i].target != views[i + 1].target) continue;
    const auto point =
        triangulate_pair(rig, views[i].px, views[i].covariance, views[i + 1].px, views[i + 1].covariance);
    if (!point) return because(PoseFailure::NotDetermined);
    in_tracker.push_back(point->in_tracker);
    in_body.push_back(body.targets[static_cast<std::size_t>(views[i].target)].position);
  }
  const auto fit = estimator == Estimator::LeastSquares ? fit_rigid_motion(in_tracker, in_body)
                                                        : three_point_motion(in_tracker, in_body);
  if (!fit) return because(PoseFailure::NotDetermined);
  return fit->a_from_b;
}

}  // namespace

std::string_view text_of(Estimator estimator) {
  static constexpr std::array<std::string_view, 3> kWords = {"maximum likelihood", "least squares (Eq. 18)",
                                                             "three-point frame"};
  return kWords[static_cast<std::size_t>(estimator)];
}

PoseExperiment::PoseExperiment(const Cell& cell, std::size_t mover, double time_s,
                               const std::array<TargetMask, 2>& seen, const AccuracyOptions& noise)
    : disturber_(cell, 0),
      model_(cell.noise),
      mover_(mover),
      time_s_(time_s),
      motion_(cell.movers[mover].motion),
      truth_(pose_at(motion_, time_s)),
      targets_(cell.movers[mover].body.targets),
      seen_(seen) {
  for (std::size_t target = 0; target < targets_.size(); ++target) {
    for (const Side side : kSides) {
      if ((seen[static_cast<std::size_t>(side)] >> target & 1U) != 0)
        add_view(cell, static_cast<int>(target), side, time_s, noise);
    }
  }
  const std::size_t n = targets_.size();
  const std::array<std::size_t, kErrorSources> counts = {
      4 * n, disturber_.calibration_inputs(), 3 * n, 2 * n, 1, 1};
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    inputs_[i] = {static_cast<ErrorSource>(i), count_, counts[i]};
    count_ += counts[i];
  }
}

void PoseExperiment::add_view(const Cell& cell, int target, Side side, double time_s,
                              const AccuracyOptions& noise) {
  const Lens& lens = cell.rig.lens(side);
  const Target& disc_of_body = targets_[static_cast<std::size_t>(target)];
  const auto disc_at = [&](double t) {
    return disc_of(disc_of_body, cell.rig.camera_from_tracker(side) * pose_at(motion_, t));
  };
  const double half = 0.5 * cell.sensor.exposure_s;
  const Disc disc = disc_at(time_s);
  const auto middle = project_disc_centre(lens, disc),
             begin = project_disc_centre(lens, disc_at(time_s - half)),
             end = project_disc_centre(lens, disc_at(time_s + half));
  if (!middle || !begin || !end) return;
  View view{target, side, (begin->px + 4 * middle->px + end->px) / 6, middle->px, 0, Vec2::Zero()};
  const double variance = centre_variance(disc_of_body, disc, lens, noise);
  view.sigma_px = std::sqrt(variance);
  // A way of L px during the exposure widens the edge's blur along it to √(σ_b² + L²/12), and the centre's
  // variance grows as that (centre_sigma.hpp).
  const Vec2 way = end->px - begin->px;
  const double length = way.norm();
  if (length > 0 && cell.sensor.blur_px > 0) {
    const double wider = std::sqrt(1 + length * length / 12 / std::pow(cell.sensor.blur_px, 2));
    view.smear_px = std::sqrt(variance * (wider - 1)) * way / length;
  }
  views_.push_back(view);
}

std::vector<TargetView> PoseExperiment::views(std::span<const double> inputs, TargetMask lost,
                                              const MeansInForce& means) const {
  const std::size_t detection = this->inputs(ErrorSource::Detection).first;
  const std::size_t smear = this->inputs(ErrorSource::Smear).first;
  std::vector<TargetView> views;
  views.reserve(views_.size());
  for (const View& view : views_) {
    if ((lost >> view.target & 1U) != 0) continue;
    const std::size_t place = 2 * static_cast<std::size_t>(view.target) + static_cast<std::size_t>(view.side);
    const double* normal = &inputs[detection + 2 * place];
    const Vec2 px = (means.smear ? view.px : view.sharp_px) + view.sigma_px * Vec2(normal[0], normal[1]) +
                    view.smear_px * inputs[smear + place];
    views.push_back({view.target, view.side, px, Mat2::Identity() * (view.sigma_px * view.sigma_px)});
  }
  return views;
}

Result<Vec6, PoseFailure> PoseExperiment::error(std::span<const double> inputs, Estimator estimator,
                                                TargetMask lost, const MeansInForce& means) const {
  require(inputs.size() == count_, "an experiment gets all its inputs");
  const auto part = [&](ErrorSource source) {
    const Inputs& range = this->inputs(source);
    return VecX(Eigen::Map<const VecX>(inputs.data() + range.first, static_cast<Eigen::Index>(range.count)));
  };
  const double latency_s = (means.latency ? model_.latency_s : 0.0) +
                           model_.latency_sigma_s * inputs[this->inputs(ErrorSource::Latency).first];
  const double warming_k = (means.thermal ? model_.temperature_k : 0.0) +
                           model_.temperature_sigma_k * inputs[this->inputs(ErrorSource::Thermal).first];

  const StereoRig rig = disturber_.rig(part(ErrorSource::Calibration));
  const Body body = disturber_.body(mover_, part(ErrorSource::Map), warming_k);
  const std::vector<TargetView> seen = views(inputs, lost, means);
  RigidMotion pose;
  if (estimator == Estimator::MaximumLikelihood) {
    const auto found = estimate_pose(body, seen, rig, truth_, {});
    if (!found) return because(found.error());
    pose = found->estimate.tracker_from_body;
  } else {
    const auto found = pose_of_points(body, rig, seen, estimator);
    if (!found) return because(found.error());
    pose = *found;
  }
  return difference(latency_s == 0 ? truth_ : pose_at(motion_, time_s_ + latency_s), pose);
}

Vec3 PoseExperiment::at_point(const Vec6& error, const Vec3& in_body) const {
  return error.tail<3>() + error.head<3>().cross(truth_.rotation * in_body);
}

}  // namespace asterism
