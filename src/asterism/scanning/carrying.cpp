// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/carrying.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr double kSameMoment_s = 1e-6;

/// The pose that leans on `count` poses from `first` on by `share`.
PoseAt leaning_on(const BodyTrack& track, const RigidMotion& pose, std::size_t first, const double* share,
                  std::size_t count) {
  PoseAt at{pose, Mat6::Zero(), Mat6::Zero()};
  double whole = 0;
  for (std::size_t i = 0; i < count; ++i) {
    at.noise += share[i] * share[i] * track.curve.noise[first + i];
    at.systematic += std::abs(share[i]) * track.systematic[first + i];
    whole += std::abs(share[i]);
  }
  at.systematic /= whole;  // the same in all of them: their mean
  return at;
}

}  // namespace

void describe(CarryOptions& options, OptionVisitor& visit) {
  visit.number("largest_gap_s", options.largest_gap_s, {1e-4, 100},
               "largest gap between poses for one between them to be told");
  visit.number("independent_s", options.independent_s, {1e-3, 1e6},
               "the noise of poses farther apart in time is independent");
  visit.flag("use_predicted", options.use_predicted, "also poses that were only predicted");
}

BodyTrack track_of(std::span<const PoseRecord> records, const std::string& body, bool predicted) {
  BodyTrack track;
  track.body = body;
  std::vector<const PoseRecord*> rows;
  for (const PoseRecord& record : records) {
    if (record.body != body) continue;
    const bool measured = record.status == PoseStatus::Ok || record.status == PoseStatus::Partial ||
                          (predicted && record.status == PoseStatus::Predicted);
    if (measured && record.tracker_from_body) {
      rows.push_back(&record);
    } else {
      ++track.not_measured;
    }
  }
  const auto earlier = [](const PoseRecord* a, const PoseRecord* b) { return a->time_s < b->time_s; };
  std::stable_sort(rows.begin(), rows.end(), earlier);
  for (const PoseRecord* row : rows) {
    const Mat6 systematic = row->systematic.value_or(Mat6::Zero());
    track.curve.times_s.push_back(row->time_s);
    track.curve.tracker_from_body.push_back(*row->tracker_from_body);
    track.curve.noise.push_back(row->covariance ? Mat6(*row->covariance - systematic) : Mat6::Zero());
    track.systematic.push_back(systematic);
    if (!row->covariance) track.covariance_known = false;
  }
  return track;
}

Result<PoseAt, NotCarried> pose_at(const BodyTrack& track, double time_s, double largest_gap_s) {
  const auto& times = track.curve.times_s;
  if (times.empty()) return because(NotCarried::NoPose);
  if (const auto between = pose_between(track.curve, time_s, largest_gap_s)) {
    return leaning_on(track, between->tracker_from_body, between->first, between->share.data(), 4);
  }
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  for (const auto& near : {after, after == times.begin() ? after : after - 1}) {
    if (near == times.end() || std::abs(*near - time_s) > kSameMoment_s) continue;
    const double all = 1;
    const auto row = static_cast<std::size_t>(near - times.begin());
    return leaning_on(track, track.curve.tracker_from_body[row], row, &all, 1);
  }
  if (after == times.begin() || after == times.end()) return because(NotCarried::OutsideRun);
  const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
  const double gap = times[first + 1] - times[first];
  if (gap > largest_gap_s) return because(NotCarried::Gap);
  const double late = (time_s - times[first]) / gap;
  const RigidMotion& from = track.curve.tracker_from_body[first];
  const Vec6 way = difference(track.curve.tracker_from_body[first + 1], from);
  const double share[] = {1 - late, late};
  return leaning_on(track, perturbed(from, late * way), first, share, 2);
}

Result<ScannerPose, NotCarried> scanner_pose_at(const ScanChain& chain, double time_s, double largest_gap_s) {
  const auto body = pose_at(chain.scanner, time_s, largest_gap_s);
  if (!body) return because(body.error());
  const Mat6 exact = Mat6::Zero();
  const RigidMotion tracker_from_scanner = body->tracker_from_body * chain.body_from_scanner;
  const Mat6 noise =
      covariance_of_product(body->tracker_from_body, body->noise, chain.body_from_scanner, exact);
  const Mat6 systematic = covariance_of_product(body->tracker_from_body, body->systematic,
                                                chain.body_from_scanner, chain.of_body_from_scanner);
  if (!chain.reference) return ScannerPose{tracker_from_scanner, noise, systematic};
  const auto reference = pose_at(*chain.reference, time_s, largest_gap_s);
  if (!reference) return because(reference.error());

  const RigidMotion tracker_from_workpiece = reference->tracker_from_body * chain.reference_from_workpiece;
  const RigidMotion workpiece_from_tracker = tracker_from_workpiece.inverse();
  const auto relative = [&](const Mat6& of_reference, const Mat6& of_alignment, const Mat6& of_scanner) {
    const Mat6 of_workpiece = covariance_of_product(reference->tracker_from_body, of_reference,
                                                    chain.reference_from_workpiece, of_alignment);
    return covariance_of_product(workpiece_from_tracker,
                                 covariance_of_inverse(tracker_from_workpiece, of_workpiece),
                                 tracker_from_scanner, of_scanner);
  };
  return ScannerPose{workpiece_from_tracker * tracker_from_scanner, relative(reference->noise, exact, noise),
                     relative(reference->systematic, chain.of_reference_from_workpiece, systematic)};
}

}  // namespace asterism
