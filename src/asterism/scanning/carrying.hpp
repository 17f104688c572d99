// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "asterism/measurement/pose_curve.hpp"
#include "asterism/measurement/pose_record.hpp"
#include "asterism/scanning/cloud_fusion.hpp"

namespace asterism {

/// Where one body was over a run, as far as the tracker told it.
struct BodyTrack {
  std::string body;
  PoseCurve curve;               // in order of time
  std::vector<Mat6> systematic;  // one a pose: what is the same in all of them
  std::size_t not_measured = 0;  // rows without a pose that was measured: left out
  bool covariance_known = true;  // false: at least one pose came without, and counts as exact
};
/// Of the records that name `body`; PREDICTED poses only when asked for. Empty when there is none.
[[nodiscard]] BodyTrack track_of(std::span<const PoseRecord> records, const std::string& body,
                                 bool predicted = false);

/// Why a moment has no pose.
enum class NotCarried {
  NoPose,      // the body was never measured
  OutsideRun,  // before the first pose or after the last: nothing is extrapolated
  Gap,         // its neighbours in time lie too far apart: the tracker had lost the body
};

struct PoseAt {
  RigidMotion tracker_from_body;
  Mat6 noise, systematic;
};
/// By the cubic through four poses where two lie on either side, else by the line between two; the very pose
/// where a row has that time. Its noise is Σ share² Σᵢ of the poses it leans on.
[[nodiscard]] Result<PoseAt, NotCarried> pose_at(const BodyTrack& track, double time_s, double largest_gap_s);

/// What stands between a scanner and the part. The rig's own error is common to both poses and partly
/// cancels; it is counted in both: an upper bound, as in tracking/relative_pose.
struct ScanChain {
  BodyTrack scanner;
  RigidMotion body_from_scanner;  // hand–eye
  Mat6 of_body_from_scanner = Mat6::Zero();
  std::optional<BodyTrack> reference;    // the platform; none: points stay in the tracker's frame
  RigidMotion reference_from_workpiece;  // alignment; identity: they stay in the platform's
  Mat6 of_reference_from_workpiece = Mat6::Zero();
};
[[nodiscard]] Result<ScannerPose, NotCarried> scanner_pose_at(const ScanChain& chain, double time_s,
                                                              double largest_gap_s);

struct CarryOptions {
  double largest_gap_s = 0.2;   // between neighbouring poses, for one between them to be told
  double independent_s = 0.25;  // noise of poses farther apart is independent: longer scans are told in parts
  bool use_predicted = false;   // also poses that the filter only carried on
};
void describe(CarryOptions& options, OptionVisitor& visit);

/// Points of one scan whose poses have their noise in common.
struct CarriedPart {
  double from_s = 0;
  std::vector<CarriedPoint> points;
};
struct CarriedScan {
  int scan = 0;
  std::vector<ScannerPose> poses;
  std::vector<CarriedPart> parts;                     // in order of time
  std::size_t no_pose = 0, outside_run = 0, gap = 0;  // points left out, by reason
  [[nodiscard]] std::size_t left_out() const { return no_pose + outside_run + gap; }
};
/// Each point to the part, by the pose of its own moment, with the covariance that the scanner's noise
/// (range_noise) gives it. Moments within half a millisecond share two poses, with the line between them.
[[nodiscard]] CarriedScan carried(const Scan& scan, const ScanChain& chain, const Scanner& scanner,
                                  const CarryOptions& options);

}  // namespace asterism
