// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/scanning/hand_eye.hpp"
#include "asterism/workflow/poses_by_frame.hpp"

namespace asterism {

/// What tells where a scanner sits in its body.
struct HandEyeJob {
  std::filesystem::path artefact;  // poses CSV: where the scanner saw the artefact, scanner_from_artefact
  std::filesystem::path poses;     // poses CSV of the tracker
  std::string body = "scanner";    // carries the scanner
  std::string reference;           // carries the artefact; empty: it stands still before the tracker
  StatedSigma stated;              // of poses without a covariance of their own
};

/// The frames that both files tell. Throws InputError where there is none, or a body is not there.
[[nodiscard]] std::vector<HandEyeView> hand_eye_views(const HandEyeJob& job);

}  // namespace asterism
