// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/measurement/pose_record.hpp"

namespace asterism {

struct PoseErrorOptions {
  std::optional<std::string> body;  // only this one; else each body of the truth
  Vec3 at_mm = Vec3::Zero();        // point of the body at which the translation error is taken
  bool relative = false;            // motions since the first common frame: free of the calibration's frame
  double wrong_mm = 2;              // a pose farther off than one of these is wrong, not merely noisy
  double wrong_deg = 0.5;
};

struct ErrorSummary {
  double mean = 0, rms = 0, median = 0, p95 = 0, max = 0;
};

struct FrameError {
  int frame = 0;
  double time_s = 0;
  double rotation_deg = 0;
  double translation_mm = 0;
  bool wrong = false;
  std::optional<double> nees;  // eᵀ C⁻¹ e of the six-vector error; 6 on average when C is honest
};

/// How well the stated covariances tell the errors.
struct Honesty {
  std::size_t poses = 0;
  double mean_nees = 0;      // 6 is honest, more is too sure, less too modest
  double in_95_percent = 0;  // share of errors inside their own 95 % ellipsoid
  bool full = true;          // false: only sigmas were known, correlations taken as zero
};

/// One body's poses against the truth.
struct PoseErrors {
  std::string body;
  std::size_t truth_frames = 0;
  std::vector<int> lost;   // frames of the truth without a pose
  std::vector<int> extra;  // frames with a pose that the truth does not have
  std::vector<int> wrong;
  std::vector<FrameError> frames;  // those compared
  ErrorSummary rotation_deg, translation_mm;
  std::optional<Honesty> honesty;          // not for relative motions: their errors share a frame
  std::optional<double> within_two_sigma;  // share of the coordinate errors at the point

  [[nodiscard]] std::size_t found() const { return truth_frames - lost.size(); }
};

/// Errors of measured poses (status Ok, Partial or Predicted) against true ones, body by body.
[[nodiscard]] std::vector<PoseErrors> pose_errors(std::span<const PoseRecord> measured,
                                                  std::span<const PoseRecord> truth,
                                                  const PoseErrorOptions& options);

/// Mean, RMS, median, 95 % and maximum; zeros for no values.
[[nodiscard]] ErrorSummary summary_of(std::vector<double> values);

}  // namespace asterism
