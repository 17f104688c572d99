// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asterism/cell/body.hpp"
#include "asterism/core/options.hpp"
#include "asterism/geometry/congruence.hpp"
#include "asterism/measurement/label.hpp"
#include "asterism/measurement/point.hpp"

// Which points are which targets of which bodies, from the points of one frame alone. A wrong label costs
// more than a missing one: what chance could have made is not reported, and what fits in two ways is
// Ambiguous.

namespace asterism {

struct IdentificationOptions {
  double sigma_floor_mm = 0.15;
  double default_sigma_mm = 0.25;
  double gate_sigma = 7.0;
  double fit_sigma = 6.0;
  double decisive_chi_square = 28.0;
  double max_accidental = 1e-6;
  double max_rotation_sigma_deg = 5.0;
  int min_targets = 4;
  int max_points = 1500;
  double margin_cap_mm = 1000.0;
};

void describe(IdentificationOptions& options, OptionVisitor& visit);

/// Where a body was expected before this frame was looked at.
struct PriorPose {
  RigidMotion tracker_from_body;
  Mat6 covariance;  // ω (rad), δ (mm) along the tracker's axes
};

/// The bodies to look for, with the table of their pair distances made once. May be shared by threads.
class BodyCatalogue {
 public:
  /// Throws InputError as check_bodies does. Of the options only `margin_cap_mm` is used here.
  explicit BodyCatalogue(std::vector<Body> bodies, const IdentificationOptions& options = {});

  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] std::span<const UncertainPoint> targets(std::size_t body) const { return targets_[body]; }
  [[nodiscard]] const PairDistanceTable& table() const { return table_; }
  /// The greatest distance between two of a body's targets, mm.
  [[nodiscard]] double diameter_mm(std::size_t body) const { return diameters_mm_[body]; }

  /// The identifiability margin: when only these targets (ascending; three or more) of a body are seen,
  /// without noise, the RMS of the best rigid fit under a wrong labelling, of this body or another; at
  /// most `margin_cap_mm`. Worked out at the first question and kept.
  [[nodiscard]] double margin_mm(std::size_t body, const std::vector<int>& targets) const;

 private:
  struct Margins;
  std::vector<Body> bodies_;
  std::vector<std::vector<UncertainPoint>> targets_;
  std::vector<double> diameters_mm_;
  PairDistanceTable table_;
  double margin_cap_mm_;
  std::shared_ptr<Margins> margins_;
};

/// One entry a body that was found, in the order of the bodies; disjoint in points and in the centres the
/// points are made of.
///
/// Pair distances that agree grow to cliques; a clique that a proper rotation fits (χ² with the points' and
/// the targets' covariances) is a labelling; over all bodies the disjoint set of labellings with the best
/// odds is chosen. Ok: no other set has odds within exp(−decisive_chi_square / 2), and fewer than
/// `max_accidental` such fits are expected from as many points at random. Targets that two points contest
/// are left out. `priors`, if given, one a body: what fits in two ways is settled by a prior that is
/// decisively nearer to one of them; three targets are enough where one is near. A body of three targets
/// may do without when all are seen. With more than `max_points` points only bodies with a prior are
/// sought. A covariance of zero means "not known": `default_sigma_mm` stands in.
/// Throws InputError for a point that is not finite or whose covariance is not one.
[[nodiscard]] std::vector<BodyLabels> identify(std::span<const Point> points, const BodyCatalogue& catalogue,
                                               const IdentificationOptions& options,
                                               std::span<const std::optional<PriorPose>> priors = {});

}  // namespace asterism
