// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {

ScanViews views_of(const std::vector<ScanSurvey>& surveys,
                   const std::vector<std::optional<RigidMotion>>& workpiece_from_frame) {
  constexpr double kAway = 10;  // times the scan's width: so far that all points are about as far
  ScanViews views;
  views.scanner_from_frame.resize(surveys.size());
  Vec3 middle = Vec3::Zero();
  double scans = 0;
  std::size_t set = 0;
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    if (surveys[i].points == 0 || !workpiece_from_frame[i]) continue;
    middle += *workpiece_from_frame[i] * surveys[i].centre;
    ++scans;
    if (surveys[i].from_origin) continue;
    views.stand_off_mm = std::max(views.stand_off_mm, kAway * surveys[i].across_mm);
    ++set;
  }
  if (set == 0) return views;
  middle /= scans;
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    const ScanSurvey& survey = surveys[i];
    if (survey.points == 0 || survey.from_origin || !workpiece_from_frame[i]) continue;
    Vec3 towards = symmetric_eigen(survey.facing).vectors.col(2);
    const Vec3 outwards =
        workpiece_from_frame[i]->rotation.conjugate() * (*workpiece_from_frame[i] * survey.centre - middle);
    // A single scan has no middle of all: then the frame's origin is the better guess.
    const Vec3 side = scans > 1 ? outwards : Vec3(-survey.centre);
    if (towards.dot(side) < 0) towards = -towards;
    const Quaternion turn = Quaternion::FromTwoVectors(towards, -Vec3::UnitZ());
    const Vec3 ahead(0, 0, views.stand_off_mm);
    views.scanner_from_frame[i] = RigidMotion{turn, ahead - turn * survey.centre};
  }
  views.remarks.push_back(
      fmt::format("{} of {} scans hold points behind their frame's origin or far off its axis, so it is not "
                  "where they were seen "
                  "from: they are "
                  "taken as seen along the axis that they face, from outside; `range_mm` and `incidence_deg` "
                  "tell of that place",
                  set, surveys.size()));
  return views;
}

Scan seen_from(const RigidMotion& scanner_from_frame, Scan piece) {
  const Mat3 turn = scanner_from_frame.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < piece.in_scanner.size(); ++i) {
    piece.in_scanner[i] =
        (turn * piece.in_scanner[i].cast<double>() + scanner_from_frame.translation).cast<float>();
    if (piece.normals.empty()) continue;
    Vec3f& normal = piece.normals[i];
    normal = (turn * normal.cast<double>()).cast<float>();
    if (normal.dot(piece.in_scanner[i]) > 0) normal = -normal;
  }
  return piece;
}

}  // namespace asterism
