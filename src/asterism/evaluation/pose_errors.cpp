// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/pose_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

using PosesByFrame = std::map<int, const PoseRecord*>;

PosesByFrame poses_of(std::span<const PoseRecord> poses, const std::string& body) {
  PosesByFrame found;
  for (const PoseRecord& pose : poses) {
    if (pose.body == body && pose.tracker_from_body) found[pose.frame] = &pose;
  }
  return found;
}

/// What the comparison gathers on its way.
struct Tally {
  std::vector<double> rotations_deg, translations_mm;
  std::size_t coordinates = 0, coordinates_within = 0;
  std::size_t with_covariance = 0, inside = 0;
  double nees_sum = 0;
  bool full = true;
};

void tally_covariance(const PoseRecord& measured, const RigidMotion& truth, const Vec3& at_mm,
                      FrameError& error, Tally& tally) {
  const Mat6& covariance = *measured.covariance;
  const RigidMotion& pose = *measured.tracker_from_body;
  const Vec6 off = difference(truth, pose);
  const auto weighted = solve_positive(covariance, off);
  if (!weighted) return;
  // A table of sigmas tells no correlations; at another point than the origin they cannot be done without.
  const bool full = !covariance.isDiagonal(0);
  tally.full = tally.full && full;
  error.nees = off.dot(*weighted);
  static const double kGate = chi_square_quantile(0.95, 6);
  ++tally.with_covariance;
  tally.nees_sum += *error.nees;
  tally.inside += *error.nees <= kGate ? 1 : 0;
  if (!full && at_mm.norm() > 0) return;
  const Vec3 sigma = covariance_of_point(pose, covariance, at_mm).diagonal().cwiseSqrt();
  const Vec3 miss = truth * at_mm - pose * at_mm;
  tally.coordinates += 3;
  for (int axis = 0; axis < 3; ++axis) {
    tally.coordinates_within += std::abs(miss(axis)) <= 2 * sigma(axis) ? 1 : 0;
  }
}

void finish(const Tally& tally, PoseErrors& errors) {
  errors.rotation_deg = summary_of(tally.rotations_deg);
  errors.translation_mm = summary_of(tally.translations_mm);
  if (tally.with_covariance > 0) {
    const double count = static_cast<double>(tally.with_covariance);
    errors.honesty = Honesty{tally.with_covariance, tally.nees_sum / count,
                             static_cast<double>(tally.inside) / count, tally.full};
  }
  if (tally.coordinates > 0) {
    errors.within_two_sigma =
        static_cast<double>(tally.coordinates_within) / static_cast<double>(tally.coordinates);
  }
}

PoseErrors errors_of_body(const std::string& body, const PosesByFrame& measured, const PosesByFrame& truth,
                          const PoseErrorOptions& options) {
  PoseErrors errors;
  errors.body = body;
  errors.truth_frames = truth.size();
  for (const auto& [frame, pose] : measured) {
    if (!truth.contains(frame)) errors.extra.push_back(frame);
  }
  Tally tally;
  const PoseRecord* first = nullptr;
  for (const auto& [frame, true_pose] : truth) {
    const auto found = measured.find(frame);
    if (found == measured.end()) {
      errors.lost.push_back(frame);
      continue;
    }
    RigidMotion pose = *found->second->tracker_from_body;
    RigidMotion wanted = *true_pose->tracker_from_body;
    if (options.relative) {
      if (first == nullptr) {
        first = found->second;
        continue;
      }
      pose = first->tracker_from_body->inverse() * pose;
      wanted = truth.at(first->frame)->tracker_from_body->inverse() * wanted;
    }
    FrameError error{frame,
                     true_pose->time_s,
                     deg_from_rad(rotation_angle(pose.rotation, wanted.rotation)),
                     (pose * options.at_mm - wanted * options.at_mm).norm(),
                     false,
                     {}};
    error.wrong = error.rotation_deg > options.wrong_deg || error.translation_mm > options.wrong_mm;
    if (error.wrong) errors.wrong.push_back(frame);
    if (!options.relative && found->second->covariance) {
      tally_covariance(*found->second, wanted, options.at_mm, error, tally);
    }
    tally.rotations_deg.push_back(error.rotation_deg);
    tally.translations_mm.push_back(error.translation_mm);
    errors.frames.push_back(error);
  }
  finish(tally, errors);
  return errors;
}

}  // namespace

ErrorSummary summary_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  ErrorSummary summary;
  for (const double value : values) {
    summary.mean += value;
    summary.rms += value * value;
  }
  summary.mean /= static_cast<double>(count);
  summary.rms = std::sqrt(summary.rms / static_cast<double>(count));
  summary.median = values[count / 2];
  summary.p95 = values[std::min(count - 1, static_cast<std::size_t>(0.95 * static_cast<double>(count)))];
  summary.max = values.back();
  return summary;
}

std::vector<PoseErrors> pose_errors(std::span<const PoseRecord> measured, std::span<const PoseRecord> truth,
                                    const PoseErrorOptions& options) {
  std::set<std::string> bodies;
  if (options.body) {
    bodies.insert(*options.body);
  } else {
    for (const PoseRecord& pose : truth) bodies.insert(pose.body);
  }
  std::vector<PoseErrors> all;
  for (const std::string& body : bodies) {
    all.push_back(errors_of_body(body, poses_of(measured, body), poses_of(truth, body), options));
  }
  return all;
}

}  // namespace asterism
