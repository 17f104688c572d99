// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_views.hpp"

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

struct Claim {
  double distance_px;
  std::size_t target, centre;
};

/// The centres of one image that are targets: the nearest to where the model expects each.
std::vector<Claim> claims_in(const StereoRig& rig, const BodyModel& model, std::size_t slot, Side side,
                             const std::vector<Centre>& centres, double gate_px) {
  std::vector<Claim> all, claims;
  for (std::size_t t = 0; t < model.positions.size(); ++t) {
    const auto expected = expect_view(rig, model, slot, t, side);
    if (!expected) continue;
    for (std::size_t c = 0; c < centres.size(); ++c) {
      // The ellipse of a disc that is covered in part, or cut by the image's edge, is not the disc's.
      if ((centres[c].flags & (kOccluded | kBorder)) != 0) continue;
      const double distance = (centres[c].px() - expected->px).norm();
      if (distance <= gate_px + std::sqrt(centres[c].covariance.trace())) all.push_back({distance, t, c});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Claim& a, const Claim& b) { return a.distance_px < b.distance_px; });
  for (const Claim& claim : all) {
    const bool taken = std::any_of(claims.begin(), claims.end(), [&](const Claim& other) {
      return other.target == claim.target || other.centre == claim.centre;
    });
    if (!taken) claims.push_back(claim);
  }
  return claims;
}

}  // namespace

std::vector<BodyView> views_of(const StereoRig& rig, const BodyModel& model, const RigidSet& set,
                               std::span<const ObservedFrame> frames, double gate_px) {
  constexpr std::size_t kLeastViews = 4;
  std::vector<BodyView> views;
  for (std::size_t slot = 0; slot < set.sightings.size(); ++slot) {
    const StereoCentres& centres = frames[set.sightings[slot].frame].centres;
    std::vector<BodyView> here;
    for (const Side side : {Side::Left, Side::Right}) {
      const auto& list = side == Side::Left ? centres.left : centres.right;
      for (const Claim& claim : claims_in(rig, model, slot, side, list, gate_px)) {
        here.push_back({slot, claim.target, side, list[claim.centre]});
      }
    }
    if (here.size() >= kLeastViews) views.insert(views.end(), here.begin(), here.end());
  }
  return views;
}

}  // namespace asterism
