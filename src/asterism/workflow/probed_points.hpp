// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/scanning/alignment.hpp"
#include "asterism/workflow/poses_by_frame.hpp"

namespace asterism {

/// Where touched points are told.
struct ProbedFile {
  std::filesystem::path points;  // CSV name,x_mm,y_mm,z_mm[,sigma_mm]; with `poses` also frame
  double sigma_mm = 0.02;        // of a point that tells none, each axis
  std::filesystem::path poses;   // the tracker's; then points are in its frame, empty: in the platform's
  std::string platform = "platform";
  StatedSigma stated;  // of poses without a covariance of their own
};

/// In the platform's frame, with the covariance of the platform's pose at each. Throws InputError, with the
/// line, for a sigma that is none or a frame in which the platform was not measured.
[[nodiscard]] std::vector<ProbedPoint> read_probed(const ProbedFile& file);

}  // namespace asterism
