// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

// No tracker's working volume is smaller; where a body without a prior is looked for.
constexpr double kSmallestVolume_mm3 = 1e9;
constexpr double kPoseVolume = 8.0 * std::numbers::pi * std::numbers::pi * 8e9;  // rad³ mm³, in a 2 m cube
// How often a prior is simply wrong (the body was knocked, or named wrongly before).
constexpr double kPriorAstray = 0.01;
constexpr std::size_t kMaxPairs = 400000;

double log_two_pi() { return std::log(2.0 * std::numbers::pi); }

double frame_density(std::span<const UncertainPoint> points) {
  Vec3 low = points.front().position;
  Vec3 high = low;
  for (const auto& point : points) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  return static_cast<double>(points.size()) / std::max(kSmallestVolume_mm3, (high - low).prod());
}

/// The frame's density, or that of the points near the body which it does not explain.
double density_beside(const Labelling& labelling, const PointScene& scene, double reach_mm) {
  Vec3 middle = Vec3::Zero();
  for (const auto& label : labelling.labels)
    middle += scene.points[static_cast<std::size_t>(label.scene)].position;
  middle /= static_cast<double>(labelling.labels.size());
  const auto near = std::count_if(scene.points.begin(), scene.points.end(), [&](const UncertainPoint& point) {
    return (point.position - middle).squaredNorm() < reach_mm * reach_mm;
  });
  const double others = static_cast<double>(near) - static_cast<double>(labelling.labels.size());
  return std::max(scene.density_per_mm3,
                  others / (4.0 / 3.0 * std::numbers::pi * reach_mm * reach_mm * reach_mm));
}

bool fixes_a_pose(const LabelFit& fit, double max_rotation_sigma_deg) {
  const auto covariance = inverse_positive(fit.information);
  if (!covariance) return false;
  const double sigma = rad_from_deg(max_rotation_sigma_deg);
  return covariance->topLeftCorner<3, 3>().trace() < sigma * sigma;
}

struct PriorFit {
  double cost;  // −2 ln of the density of poses there
  double gain;  // by how much that is less than for a pose far from the prior
  bool near;
  double log_volume;  // of the poses that would have been near
};

PriorFit weigh_prior(const LabelFit& fit, const std::optional<PriorPose>& prior, double sigma) {
  const double anywhere = 2.0 * std::log(kPoseVolume);
  if (!prior) return {anywhere, 0, false, 0};
  const double astray = anywhere - 2.0 * std::log(kPriorAstray);
  const auto of_fit = inverse_positive(fit.information);
  if (!of_fit) return {astray, 0, false, 0};
  const Mat6 covariance = prior->covariance + *of_fit;
  const Vec6 off = difference(fit.tracker_from_body, prior->tracker_from_body);
  const auto scaled = solve_positive(covariance, off);
  const auto log_det = log_determinant_positive(covariance);
  if (!scaled || !log_det) return {astray, 0, false, 0};
  const double distance = off.dot(*scaled);
  const double cost = distance + *log_det + 6.0 * log_two_pi();
  const double limit = chi_square_limit(sigma, 6);
  return {std::min(cost, astray), std::max(0.0, astray - cost), distance < limit && cost < astray,
          log_ball_volume(6, std::sqrt(limit)) + 0.5 * *log_det};
}

void weigh(Labelling& labelling, const PointScene& scene, const BodyCatalogue& catalogue,
           const IdentificationOptions& options, const std::optional<PriorPose>& prior) {
  const auto body = static_cast<std::size_t>(labelling.body);
  const std::size_t labels = labelling.labels.size();
  const LabelFit& fit = labelling.fit;
  const PriorFit at = weigh_prior(fit, prior, options.fit_sigma);
  const double log_det = log_determinant_positive(fit.information).value_or(0.0);
  const double density = density_beside(labelling, scene, catalogue.diameter_mm(body));
  // Each point's density under the labelling, over that of clutter; poses nearby are summed over.
  labelling.cost = fit.chi_square + fit.log_det_covariances +
                   static_cast<double>(labels) * (3.0 * log_two_pi() + 2.0 * std::log(density)) + log_det -
                   6.0 * log_two_pi() + at.cost;
  labelling.near_prior = at.near;
  labelling.prior_gain = at.gain;

  const std::size_t targets = catalogue.targets(body).size();
  const Clutter clutter{static_cast<double>(scene.points.size()), density};
  labelling.log_accidental = log_accidental_fits(fit, labels, targets, clutter);
  if (!at.near) return;
  labelling.log_accidental = std::min(
      labelling.log_accidental, log_accidental_fits_within(at.log_volume, fit, labels, targets, clutter));
}

/// Correspondences that a prior allows, and which of them agree.
std::vector<CompatiblePair> pairs_near(const PriorPose& prior, std::span<const UncertainPoint> targets,
                                       const PointScene& scene, const IdentificationOptions& options) {
  std::vector<Correspondence> allowed;
  const double limit = chi_square_limit(options.fit_sigma, 3);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const Vec3 expected = prior.tracker_from_body * targets[t].position;
    const Mat3 of_prior = covariance_of_point(prior.tracker_from_body, prior.covariance, targets[t].position);
    for (std::size_t p = 0; p < scene.points.size(); ++p) {
      const Vec3 off = scene.points[p].position - expected;
      const Mat3 covariance = of_prior + targets[t].covariance + scene.points[p].covariance;
      if (!(off.dot(covariance.inverse() * off) < limit)) continue;
      allowed.push_back({static_cast<int>(t), static_cast<int>(p)});
    }
  }
  std::vector<CompatiblePair> pairs;
  for (std::size_t j = 1; j < allowed.size(); ++j) {
    for (std::size_t i = 0; i < j && pairs.size() < kMaxPairs; ++i) {
      const Correspondence a = allowed[i];
      const Correspondence b = allowed[j];
      if (a.pattern == b.pattern || a.scene == b.scene) continue;
      const auto sa = static_cast<std::size_t>(a.scene);
      const auto sb = static_cast<std::size_t>(b.scene);
      if (share_a_claim(scene.claims[sa], scene.claims[sb])) continue;
      if (!distances_agree(targets[static_cast<std::size_t>(a.pattern)],
                           targets[static_cast<std::size_t>(b.pattern)], scene.points[sa], scene.points[sb],
                           options.gate_sigma)) {
        continue;
      }
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Takes out the label without which the others fit best. Empty when none of them fix a pose.
Result<LabelFit, RigidFitFailure> fit_without_one(std::vector<Correspondence>& labels,
                                                  std::span<const UncertainPoint> targets,
                                                  std::span<const UncertainPoint> points) {
  Result<LabelFit, RigidFitFailure> best = because(RigidFitFailure::Collinear);
  std::vector<Correspondence> kept;
  for (std::size_t out = 0; out < labels.size(); ++out) {
    std::vector<Correspondence> others = labels;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
    const auto fit = fit_labels(others, targets, points);
    if (!fit || (best && fit->chi_square >= best->chi_square)) continue;
    best = fit;
    kept = std::move(others);
  }
  labels = std::move(kept);
  return best;
}

/// Cliques of `fewest` correspondences or more; where these are too many to list, only larger ones.
struct LargestCliques {
  Cliques cliques;
  std::size_t fewest;
};

LargestCliques largest_cliques(std::span<const CompatiblePair> pairs, std::size_t targets, std::size_t points,
                               std::size_t fewest) {
  Cliques cliques;
  CliqueLimits limits;
  for (; fewest <= targets; ++fewest) {
    limits.min_size = static_cast<int>(fewest);
    cliques = grow_cliques(pairs, targets, points, limits);
    if (cliques.complete) break;
  }
  return {std::move(cliques), fewest};
}

void add(LabellingSearch& search, Labelling labelling) {
  const bool known =
      std::any_of(search.labellings.begin(), search.labellings.end(), [&](const Labelling& other) {
        return other.body == labelling.body && other.labels == labelling.labels;
      });
  if (!known) search.labellings.push_back(std::move(labelling));
}

}  // namespace

PointScene scene_of(std::span<const Point> points, const IdentificationOptions& options) {
  PointScene scene;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    Mat3 covariance = point.covariance;
    if (!point.in_tracker.allFinite() || !covariance.allFinite()) {
      throw InputError(fmt::format("point {}: its place or covariance is not a finite number", i));
    }
    if (covariance.isZero(0))
      covariance = options.default_sigma_mm * options.default_sigma_mm * Mat3::Identity();
    covariance.diagonal().array() += options.sigma_floor_mm * options.sigma_floor_mm;
    const bool positive = covariance(0, 0) > 0 && covariance.topLeftCorner<2, 2>().determinant() > 0 &&
                          covariance.determinant() > 0;
    if (!positive) throw InputError(fmt::format("point {}: its covariance is not positive definite", i));
    scene.points.push_back({point.in_tracker, covariance});
    scene.claims.push_back({point.left, point.right});
  }
  if (!scene.points.empty()) scene.density_per_mm3 = frame_density(scene.points);
  return scene;
}

std::optional<Labelling> labelling_of(int body, std::vector<Correspondence> labels, std::size_t fewest,
                                      const PointScene& scene, const BodyCatalogue& catalogue,
                                      const IdentificationOptions& options,
                                      const std::optional<PriorPose>& prior) {
  const auto targets = catalogue.targets(static_cast<std::size_t>(body));
  auto fit = fit_labels(labels, targets, scene.points);
  while (fit) {
    const double degrees = 3.0 * static_cast<double>(labels.size()) - 6.0;
    if (fit->chi_square < chi_square_limit(options.fit_sigma, degrees)) {
      if (!fixes_a_pose(*fit, options.max_rotation_sigma_deg)) return std::nullopt;
      Labelling labelling{body, std::move(labels), *fit};
      weigh(labelling, scene, catalogue, options, prior);
      return labelling;
    }
    if (labels.size() <= std::max<std::size_t>(fewest, 3)) return std::nullopt;
    fit = fit_without_one(labels, targets, scene.points);
  }
  return std::nullopt;
}

double prior_gain(const LabelFit& fit, const std::optional<PriorPose>& prior) {
  return weigh_prior(fit, prior, 1.0).gain;
}

bool is_evident(const Labelling& labelling, const BodyCatalogue& catalogue,
                const IdentificationOptions& options) {
  const std::size_t targets = catalogue.targets(static_cast<std::size_t>(labelling.body)).size();
  const std::size_t wanted = std::min(targets, static_cast<std::size_t>(options.min_targets));
  if (labelling.labels.size() < wanted && !labelling.near_prior) return false;
  return labelling.log_accidental < std::log(options.max_accidental);
}

LabellingSearch find_labellings(const PointScene& scene, const BodyCatalogue& catalogue,
                                const IdentificationOptions& options,
                                std::span<const std::optional<PriorPose>> priors) {
  const std::size_t bodies = catalogue.bodies().size();
  LabellingSearch search{{}, std::vector<bool>(bodies, true)};
  const bool everywhere = scene.points.size() <= static_cast<std::size_t>(options.max_points);
  CompatiblePairs pairs{std::vector<std::vector<CompatiblePair>>(bodies), true};
  if (everywhere) pairs = catalogue.table().match(scene.points, scene.claims, options.gate_sigma, kMaxPairs);

  for (std::size_t body = 0; body < bodies; ++body) {
    const auto targets = catalogue.targets(body);
    const auto prior = priors.empty() ? std::optional<PriorPose>() : priors[body];
    const std::size_t enough = std::min(targets.size(), static_cast<std::size_t>(options.min_targets));
    if (enough < 3) continue;
    bool near = false;
    const auto grow = [&](std::span<const CompatiblePair> agreeing, std::size_t least, double min_gain) {
      const auto [cliques, fewest] = largest_cliques(agreeing, targets.size(), scene.points.size(), least);
      if (!cliques.complete) search.complete[body] = false;
      for (const auto& clique : cliques.found) {
        auto labelling =
            labelling_of(static_cast<int>(body), clique, fewest, scene, catalogue, options, prior);
        // Labellings with fewer labels were not all seen, nor are they rivals worth the name: a point that
        // completes the larger one by accident is rarer than what is taken for certain.
        if (!labelling) continue;
        labelling->decided = labelling->prior_gain >= min_gain;
        near = near || labelling->near_prior;
        add(search, std::move(*labelling));
      }
    };
    if (!pairs.complete) search.complete[body] = false;
    grow(pairs.of_pattern[body], enough, 0);
    // Rivals far from the prior are not searched for here, so the prior alone must rule them out.
    if (prior && !near) grow(pairs_near(*prior, targets, scene, options), 3, options.decisive_chi_square);
  }
  return search;
}

}  // namespace asterism
