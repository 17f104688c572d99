// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asterism/core/result.hpp"
#include "asterism/geometry/rigid_motion.hpp"

namespace asterism {

/// One view of a fixed artefact: where the scanner's body was, and where its scan saw the artefact.
struct HandEyeView {
  RigidMotion reference_from_body;  // of the tracker, or of the body that carries the artefact
  Mat6 of_body = Mat6::Zero();
  RigidMotion scanner_from_artefact;
  Mat6 of_artefact = Mat6::Zero();
};

/// Where the scanner sits in its body.
struct HandEye {
  RigidMotion body_from_scanner;
  Mat6 covariance = Mat6::Zero();  // ω, δ along the body's axes
  RigidMotion reference_from_artefact;
  double chi2 = 0, degrees = 0;  // of the views against their covariances
  double rms_mm = 0, rms_deg = 0;
};

enum class HandEyeFailure {
  TooFewViews,  // three at least
  NoTurn,       // all views have one attitude: the scanner's place cannot be told
  OneAxis,      // all turns are about one axis: its place along that axis cannot be told
};
[[nodiscard]] std::string text_of(HandEyeFailure failure);

/// AX = XB: A X Bᵢ = Y for all views, X = body_from_scanner, Y = reference_from_artefact. Started by Park &
/// Martin (IEEE Trans. Robot. Autom. 10 (1994) 717), then the most likely X and Y with the views'
/// covariances.
[[nodiscard]] Result<HandEye, HandEyeFailure> hand_eye(std::span<const HandEyeView> views);

}  // namespace asterism
