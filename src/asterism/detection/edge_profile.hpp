// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/detection/edge_fit.hpp"

namespace asterism {

/// One target's share in what its image's edges look like.
struct ProfileView {
  const Patch* patch;
  EdgeModel model;
  EdgeNoise noise;
  BlurPrior blur;
};

/// One Gauss–Newton step for the profile all views share, their own parameters eliminated (Schur complement).
/// Needs a few hundred edge pixels; the profile comes back unchanged where the views cannot tell.
[[nodiscard]] EdgeProfile improved_profile(const EdgeProfile& profile, std::span<const ProfileView> views);

}  // namespace asterism
