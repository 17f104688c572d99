// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asterism/tracking/identification.hpp"
#include "asterism/tracking/identification_fit.hpp"

namespace asterism {

/// The points of a frame as identification sees them: covariances with the floor added, and which points
/// exclude one another.
struct PointScene {
  std::vector<UncertainPoint> points;
  std::vector<Claims> claims;  // left and right centre
  double density_per_mm3 = 0;  // of the frame as a whole
};

/// Throws InputError for a point that is not finite or whose covariance is not one.
[[nodiscard]] PointScene scene_of(std::span<const Point> points, const IdentificationOptions& options);

/// One way to see one body in a scene.
struct Labelling {
  int body;
  std::vector<Correspondence> labels;  // target, point; ascending
  LabelFit fit;
  double cost = 0;            // −2 ln of its odds against "these points are clutter"; the lower the better
  double log_accidental = 0;  // ln of how many such fits chance would make
  bool near_prior = false;
  double prior_gain = 0;  // by how much `cost` is less than it were far from the prior
  bool decided = true;    // false: found only near a prior that does not rule out rivals not sought
};

struct LabellingSearch {
  std::vector<Labelling> labellings;
  std::vector<bool> complete;  // by body; false: a rival may have gone unseen
};

/// All labellings of all bodies that fit.
[[nodiscard]] LabellingSearch find_labellings(const PointScene& scene, const BodyCatalogue& catalogue,
                                              const IdentificationOptions& options,
                                              std::span<const std::optional<PriorPose>> priors);

/// Fits `labels`, leaving out one after the other of those that do not fit, down to `fewest`. Empty when
/// the rest does not fit or fixes no pose.
[[nodiscard]] std::optional<Labelling> labelling_of(int body, std::vector<Correspondence> labels,
                                                    std::size_t fewest, const PointScene& scene,
                                                    const BodyCatalogue& catalogue,
                                                    const IdentificationOptions& options,
                                                    const std::optional<PriorPose>& prior);

/// By how much more a prior expects this pose than one far from it, as −2 ln of the ratio; 0 without a prior
/// or far from it.
[[nodiscard]] double prior_gain(const LabelFit& fit, const std::optional<PriorPose>& prior);

/// Enough targets, and more than chance would give.
[[nodiscard]] bool is_evident(const Labelling& labelling, const BodyCatalogue& catalogue,
                              const IdentificationOptions& options);

}  // namespace asterism
