// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/statistics/distributions.hpp"
#include "asterism/tracking/pose_model.hpp"

namespace asterism {
namespace {

using Fit = Result<PoseFit, PoseFailure>;

// A χ² less likely than this among good frames starts the search for a wrong target and the widening.
constexpr double kSuspicious = 1e-3;
// Less likely than this even with `model_error_px` allowed for: refused.
constexpr double kImpossible = 1e-6;
// Another minimum within this much χ² cannot be told from the first (odds of e^10).
constexpr double kAsGood = 20.0;

/// P(χ² > value) < p, for p ≤ 0.001; the common answer without the costly tail: the quantile of χ² lies above
/// that of the normal variable of its mean and variance.
bool less_likely(double chi_square, int degrees, double p) {
  if (chi_square < degrees + 3.0 * std::sqrt(2.0 * degrees)) return false;
  return chi_square_tail(chi_square, degrees) < p;
}

int degrees_of_freedom(const NormalEquations& equations) { return 2 * equations.views - 6; }

/// Three targets, for else a motion is free; four views, for else nothing is left to contradict.
bool enough(const PoseProblem& problem) {
  int views = 0;
  for (std::size_t i = 0; i < problem.size(); ++i) views += problem.used(i) ? 1 : 0;
  return views >= 4 && problem.targets_used() >= 3;
}

/// The target that stands out most and how unlikely that is if it were good.
struct Suspect {
  std::size_t group = 0;
  double per_degree = 0;
  double probability = 1;
};

std::optional<Suspect> worst_target(const PoseProblem& problem, const PoseFit& fit) {
  std::optional<Suspect> worst;
  for (std::size_t g = 0; g < problem.groups().size(); ++g) {
    const auto share = problem.at(fit.pose, g);
    if (!share || share->views == 0) continue;
    const Mat6 without = fit.equations.information - share->information;
    const auto pull = solve_positive(without, share->gradient);
    if (!pull) continue;
    // What χ² falls by when this target is left out and the pose moves to where the others want it.
    const double drop = share->chi_square + share->gradient.dot(*pull);
    const double m = 2.0 * share->views;
    const double rest_degrees = degrees_of_freedom(fit.equations) - m;
    if (rest_degrees < 1) continue;
    const double rest = std::max(0.0, fit.equations.chi_square - drop);
    // If the others agree among themselves their sigmas are believed; if not, their own scatter is the scale.
    const bool others_agree = chi_square_tail(rest, rest_degrees) > 0.01;
    const double probability = others_agree ? chi_square_tail(drop, m)
                                            : fisher_tail(drop / m / (rest / rest_degrees), m, rest_degrees);
    if (worst && drop / m <= worst->per_degree) continue;
    worst = Suspect{g, drop / m, probability};
  }
  return worst;
}

void use_group(PoseProblem& problem, std::size_t group, bool yes) {
  const auto [first, last] = problem.groups()[group];
  for (std::size_t i = first; i < last; ++i) problem.use(i, yes);
}

/// Takes back each rejected view that the pose of the others foretells within its doubt.
bool readmit(PoseProblem& problem, const PoseFit& fit, const PoseOptions& options) {
  const auto covariance = inverse_positive(fit.equations.information);
  if (!covariance) return false;
  const int degrees = degrees_of_freedom(fit.equations);
  const double scale = degrees > 0 ? std::max(1.0, fit.equations.chi_square / degrees) : 1.0;
  const double gate = scale * chi_square_quantile(1 - options.outlier_probability, 2);
  bool any = false;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (problem.used(i)) continue;
    const auto at = problem.linearised(fit.pose, i);
    if (!at) continue;
    Mat2 expected = problem.weight(i).inverse() + at->by_pose * *covariance * at->by_pose.transpose();
    if (const auto& own = problem.target(i).covariance) {
      const Mat23 by = at->by_point * fit.pose.rotation.toRotationMatrix();
      expected += by * *own * by.transpose();
    }
    if (at->residual.dot(expected.inverse() * at->residual) > gate) continue;
    problem.use(i, true);
    any = true;
  }
  return any;
}

bool suspicious(const NormalEquations& equations) {
  const int degrees = degrees_of_freedom(equations);
  return degrees > 0 && less_likely(equations.chi_square, degrees, kSuspicious);
}

/// Rejects the targets that stand out, one by one; never more than a third of them, for a majority must
/// agree.
Fit fit_without_outliers(PoseProblem& problem, const RigidMotion& start, const PoseOptions& options) {
  Fit fit = minimise(problem, start, options.max_iterations);
  if (!fit || !suspicious(fit->equations)) return fit;
  const int most = static_cast<int>(problem.groups().size()) / 3;
  int rejected = 0;
  while (rejected < most && suspicious(fit->equations)) {
    const auto suspect = worst_target(problem, *fit);
    if (!suspect || suspect->probability > options.outlier_probability) break;
    use_group(problem, suspect->group, false);
    if (!enough(problem)) {
      use_group(problem, suspect->group, true);
      break;
    }
    ++rejected;
    fit = minimise(problem, fit->pose, options.max_iterations);
    if (!fit) return fit;
  }
  if (rejected > 0 && readmit(problem, *fit, options))
    fit = minimise(problem, fit->pose, options.max_iterations);
  return fit;
}

/// What the covariance of the rig does to the pose, and by how much it lets χ² grow.
struct RigShare {
  Mat6 covariance = Mat6::Zero();
  double chi_square = 0;
};

/// Σ Jᵀ W K and Σ Kᵀ W K over the views, K = ∂px / ∂(the rig's parameters) and W as add_group has it: a
/// target's own error is common to its views.
struct RigEquations {
  MatX cross, own;
};

void add_group(const PoseProblem& problem, const PoseFit& fit, const PoseProblem::Group& group,
               RigEquations& sum) {
  Mat3 a = Mat3::Zero();
  Mat36 b = Mat36::Zero();
  MatX d = MatX::Zero(3, sum.own.cols());
  for (std::size_t i = group.first; i < group.last; ++i) {
    if (!problem.used(i)) continue;
    const auto at = problem.linearised(fit.pose, i);
    if (!at) continue;
    const Side side = problem.side(i);
    const Mat3 tracker_from_camera =
        problem.rig().camera_from_tracker(side).rotation.conjugate().toRotationMatrix();
    const MatX by_rig = pixel_by_rig(problem.rig(), side, at->in_tracker, at->by_point * tracker_from_camera);
    require(by_rig.cols() == sum.own.cols(), "a rig's covariance covers each of its parameters");
    const Mat2& weight = problem.weight(i);
    sum.cross += at->by_pose.transpose() * weight * by_rig;
    sum.own += by_rig.transpose() * weight * by_rig;
    a += at->by_point.transpose() * weight * at->by_point;
    b += at->by_point.transpose() * weight * at->by_pose;
    d += at->by_point.transpose() * weight * by_rig;
  }
  const std::optional<Mat3>& own = problem.target(group.first).covariance;
  if (!own) return;
  const Mat3 turn = fit.pose.rotation.toRotationMatrix();
  const Mat3 c = turn * *own * turn.transpose();
  const Mat3 m = c * (Mat3::Identity() + a * c).inverse();
  sum.cross -= b.transpose() * m * d;
  sum.own -= d.transpose() * m * d;
}

RigShare share_of_rig(const PoseProblem& problem, const PoseFit& fit, const Mat6& covariance) {
  const MatX& of_rig = problem.rig().covariance;
  if (of_rig.size() == 0) return {};
  RigEquations sum{MatX::Zero(6, of_rig.cols()), MatX::Zero(of_rig.cols(), of_rig.cols())};
  for (const PoseProblem::Group& group : problem.groups()) add_group(problem, fit, group, sum);
  const MatX by = covariance * sum.cross;
  return {by * of_rig * by.transpose(), ((sum.own - sum.cross.transpose() * by) * of_rig).trace()};
}

/// What the bodies' own covariances add to the pose's, which each frame shares.
Mat6 share_of_body(const PoseProblem& problem, const PoseFit& fit, const Mat6& covariance) {
  const bool any = std::any_of(problem.groups().begin(), problem.groups().end(), [&](const auto& group) {
    return problem.target(group.first).covariance.has_value();
  });
  if (!any) return Mat6::Zero();
  // The same views with a perfect body: what is left is the body's.
  Mat6 information = Mat6::Zero();
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (!problem.used(i)) continue;
    if (const auto at = problem.linearised(fit.pose, i)) {
      information += at->by_pose.transpose() * problem.weight(i) * at->by_pose;
    }
  }
  const auto of_centres = inverse_positive(information);
  return of_centres ? Mat6(covariance - *of_centres) : Mat6(Mat6::Zero());
}

/// Residuals of the views in use: RMS a coordinate, χ² with the model's error allowed for, facing, middle.
struct Remains {
  double rms_px = 0;
  double loose_chi_square = 0;
  bool all_face = true;
  Vec3 middle_in_body = Vec3::Zero();
};

Remains what_remains(const PoseProblem& problem, const PoseFit& fit, const PoseOptions& options) {
  Remains remains;
  const double smallest_cosine = std::cos(rad_from_deg(options.max_incidence_deg));
  const double allowed = options.model_error_px * options.model_error_px;
  // What fits without allowance fits with it.
  const bool ask = suspicious(fit.equations);
  int used = 0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (!problem.used(i)) continue;
    const auto at = problem.linearised(fit.pose, i);
    if (!at) continue;
    ++used;
    remains.rms_px += at->residual.squaredNorm();
    remains.all_face = remains.all_face && at->facing > smallest_cosine;
    remains.middle_in_body += problem.target(i).position;
    if (!ask) continue;
    Mat2 loose = problem.weight(i).inverse() + allowed * Mat2::Identity();
    if (const auto& own = problem.target(i).covariance) {
      const Mat23 by = at->by_point * fit.pose.rotation.toRotationMatrix();
      loose += by * *own * by.transpose();
    }
    remains.loose_chi_square += at->residual.dot(loose.inverse() * at->residual);
  }
  remains.rms_px = std::sqrt(remains.rms_px / (2.0 * used));
  remains.middle_in_body /= used;
  return remains;
}

bool well_determined(const RigidMotion& pose, const Mat6& covariance, const Vec3& middle,
                     const PoseOptions& options) {
  const double turn = symmetric_eigen(Mat3(covariance.topLeftCorner<3, 3>())).values(2);
  const double shift = symmetric_eigen(covariance_of_point(pose, covariance, middle)).values(2);
  return turn < std::pow(rad_from_deg(options.max_sigma_deg), 2) && shift < std::pow(options.max_sigma_mm, 2);
}

/// The better of this minimum and its mirror twin; Ambiguous when neither is clearly better.
Fit settle_between_minima(const PoseProblem& problem, const PoseFit& fit, const PoseOptions& options) {
  // Four targets in space hold a body fast; fewer may look the same turned over.
  if (problem.targets_in_both() >= 4) return fit;
  const int degrees = degrees_of_freedom(fit.equations);
  const auto scale = [&](const PoseFit& of) {
    return std::max(1.0, of.equations.chi_square / std::max(1, degrees));
  };
  const auto other = other_minimum(problem, fit, kAsGood * scale(fit), options.max_iterations);
  if (!other) return fit;
  if (other->equations.chi_square + kAsGood * scale(*other) < fit.equations.chi_square) return *other;
  return because(PoseFailure::Ambiguous);
}

}  // namespace

void describe(PoseOptions& options, OptionVisitor& visit) {
  visit.number("sigma_floor_px", options.sigma_floor_px, {0, 10},
               "no centre is taken as better known than this");
  visit.number("model_error_px", options.model_error_px, {0, 10},
               "residuals that an imperfect rig or body may cause; a pose beyond is refused");
  visit.number("outlier_probability", options.outlier_probability, {1e-12, 0.1},
               "of rejecting a good target");
  visit.number("max_sigma_deg", options.max_sigma_deg, {1e-6, 180},
               "a pose less certain in rotation is refused");
  visit.number("max_sigma_mm", options.max_sigma_mm, {1e-6, 1e6},
               "a pose less certain at its targets is refused");
  visit.number("max_incidence_deg", options.max_incidence_deg, {0, 180},
               "a target turned further away is not seen");
  visit.integer("max_iterations", options.max_iterations, {1, 1000}, "of the least-squares fit");
}

Result<PoseSolution, PoseFailure> estimate_pose(const Body& body, std::span<const TargetView> views,
                                                const StereoRig& rig, const RigidMotion& start,
                                                const PoseOptions& options) {
  PoseProblem problem(body, views, rig, options);
  if (!enough(problem)) return because(PoseFailure::TooFewViews);
  Fit fit = fit_without_outliers(problem, start, options);
  if (fit) fit = settle_between_minima(problem, *fit, options);
  if (!fit) return because(fit.error());

  const auto covariance = inverse_positive(fit->equations.information);
  if (!covariance) return because(PoseFailure::NotDetermined);
  const Remains remains = what_remains(problem, *fit, options);
  PoseSolution solution;
  solution.rms_px = remains.rms_px;
  solution.chi_square = fit->equations.chi_square;
  solution.degrees_of_freedom = degrees_of_freedom(fit->equations);
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (!problem.used(i)) solution.rejected.push_back(problem.given_index(i));
  }
  std::sort(solution.rejected.begin(), solution.rejected.end());
  if (less_likely(remains.loose_chi_square, solution.degrees_of_freedom, kImpossible)) {
    return because(PoseFailure::Inconsistent);
  }

  const RigShare of_rig = share_of_rig(problem, *fit, *covariance);
  const double expected = solution.degrees_of_freedom + of_rig.chi_square;
  if (less_likely(solution.chi_square * solution.degrees_of_freedom / expected, solution.degrees_of_freedom,
                  kSuspicious)) {
    solution.variance_factor = std::max(1.0, solution.chi_square / expected);
  }
  solution.estimate.tracker_from_body = fit->pose;
  solution.estimate.systematic = share_of_body(problem, *fit, *covariance) + of_rig.covariance;
  solution.estimate.covariance = solution.variance_factor * *covariance + of_rig.covariance;
  if (!well_determined(fit->pose, solution.estimate.covariance, remains.middle_in_body, options)) {
    return because(PoseFailure::NotDetermined);
  }
  if (!remains.all_face) return because(PoseFailure::FacesAway);
  return solution;
}

}  // namespace asterism
