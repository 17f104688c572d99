// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/knocked_targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/tracking/pose_model.hpp"
#include "asterism/tracking/refused_targets.hpp"
#include "asterism/tracking/shape_equations.hpp"

namespace asterism {
namespace {

// A shift is found four times in five when it lies this many σ beyond the gate.
constexpr double kPower = 0.8416;
// Others that fit less likely than this are not believed as stated: their own scatter is the scale.
constexpr double kAgree = 0.01;

/// A set of targets that may stand anywhere, and how well the run is explained then.
struct Hypothesis {
  std::vector<int> free;
  double chi_square = 0;  // what is left over
  int degrees = 0;
  VecX shifts;  // 3 a target
  MatX covariance;
};

class ShapeTest {
 public:
  ShapeTest(const ShapeEquations& equations, const Body& body, const KnockOptions& options)
      : equations_(equations), body_(body), options_(options) {}

  /// Empty when what is free cannot be told from the body's pose.
  [[nodiscard]] std::optional<Hypothesis> with_free(std::vector<int> free) const {
    Hypothesis hypothesis;
    const auto seen = std::count_if(equations_.frames_seen.begin(), equations_.frames_seen.end(),
                                    [](std::size_t frames) { return frames > 0; });
    hypothesis.degrees = 3 * static_cast<int>(seen) - 6 - 3 * static_cast<int>(free.size());
    if (hypothesis.degrees < 0) return std::nullopt;
    MatX sum = equations_.normal;
    for (std::size_t t = 0; t < body_.targets.size(); ++t) {
      if (std::find(free.begin(), free.end(), static_cast<int>(t)) != free.end()) continue;
      const auto at = static_cast<Eigen::Index>(3 * t);
      sum.block<3, 3>(at, at) += map_covariance(body_.targets[t]).inverse();
    }
    const auto covariance = inverse_positive(sum);
    if (!covariance) return std::nullopt;
    hypothesis.free = std::move(free);
    hypothesis.covariance = *covariance;
    hypothesis.shifts = *covariance * equations_.gradient;
    hypothesis.chi_square =
        std::max(0.0, equations_.shape_chi_square - equations_.gradient.dot(hypothesis.shifts));
    return hypothesis;
  }

  /// How likely chance makes `with` so much better than `without`.
  [[nodiscard]] static double chance(const Hypothesis& without, const Hypothesis& with) {
    const double drop = without.chi_square - with.chi_square;
    const double degrees = without.degrees - with.degrees;
    if (drop <= 0) return 1;
    if (with.degrees < 1 || chi_square_tail(with.chi_square, with.degrees) > kAgree)
      return chi_square_tail(drop, degrees);
    return fisher_tail(drop / degrees / (with.chi_square / with.degrees), degrees, with.degrees);
  }

  [[nodiscard]] static double misfit(const Hypothesis& hypothesis) {
    return hypothesis.degrees > 0 ? std::max(1.0, hypothesis.chi_square / hypothesis.degrees) : 1.0;
  }

 private:
  [[nodiscard]] Mat3 map_covariance(const Target& target) const {
    // A coordinate without doubt would make the equations singular: a thousandth of what is usual.
    const double usual = options_.map_sigma_mm * options_.map_sigma_mm;
    const Mat3 least = 1e-6 * usual * Mat3::Identity();
    return target.covariance ? Mat3(*target.covariance + least) : Mat3(usual * Mat3::Identity());
  }

  const ShapeEquations& equations_;
  const Body& body_;
  const KnockOptions& options_;
};

/// Each target that is not yet free, freed beside the others; best first.
std::vector<Hypothesis> one_more(const ShapeTest& test, const Hypothesis& now,
                                 const ShapeEquations& equations) {
  std::vector<Hypothesis> more;
  for (std::size_t t = 0; t < equations.frames_seen.size(); ++t) {
    const int target = static_cast<int>(t);
    if (equations.frames_seen[t] == 0) continue;
    if (std::find(now.free.begin(), now.free.end(), target) != now.free.end()) continue;
    std::vector<int> free = now.free;
    free.push_back(target);
    if (auto hypothesis = test.with_free(std::move(free))) more.push_back(std::move(*hypothesis));
  }
  std::sort(more.begin(), more.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.chi_square != b.chi_square ? a.chi_square < b.chi_square : a.free < b.free;
  });
  return more;
}

/// Accuses targets while chance does not explain what freeing them gains.
Hypothesis accuse(const ShapeTest& test, const ShapeEquations& equations, const KnockOptions& options,
                  std::vector<KnockedTarget>& knocked) {
  auto now = test.with_free({});
  require(now.has_value(), "a shape with a prior is determined");
  const std::size_t most = equations.frames_seen.size() / 3;
  while (knocked.size() < most) {
    const auto more = one_more(test, *now, equations);
    if (more.empty()) break;
    const Hypothesis& best = more.front();
    const double targets = static_cast<double>(equations.frames_seen.size());
    if (ShapeTest::chance(*now, best) > options.probability / targets) break;
    KnockedTarget found;
    found.target = best.free.back();
    found.chi_square = now->chi_square - best.chi_square;
    for (std::size_t i = 1; i < more.size(); ++i) {
      if (more[i].chi_square - best.chi_square > options.decisive * ShapeTest::misfit(best)) break;
      found.rivals.push_back(more[i].free.back());
    }
    knocked.push_back(found);
    now = best;
  }
  return *now;
}

/// Of each target.
std::vector<double> detectable(const ShapeEquations& equations, const Body& body,
                               const KnockOptions& options) {
  const ShapeTest test(equations, body, options);
  const auto targets = body.targets.size();
  // Of χ² with three degrees and noncentrality λ²: (λ + normal)² + 2, nearly.
  const double gate = chi_square_quantile(1 - options.probability / static_cast<double>(targets), 3);
  const double lambda = std::sqrt(gate - 2) + kPower;
  std::vector<double> shifts(targets, std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < targets; ++t) {
    if (equations.frames_seen[t] == 0) continue;
    const auto alone = test.with_free({static_cast<int>(t)});
    if (!alone) continue;
    const auto at = static_cast<Eigen::Index>(3 * t);
    const Mat3 covariance = alone->covariance.block<3, 3>(at, at);
    shifts[t] = lambda * std::sqrt(symmetric_eigen(covariance).values(2));
  }
  return shifts;
}

ShapeEquations one_frame_of(ShapeEquations equations) {
  equations.normal /= static_cast<double>(equations.frames);
  return equations;
}

void count_refusals(std::size_t body, std::span<const TrackedFrame> frames,
                    std::vector<KnockedTarget>& knocked) {
  for (KnockedTarget& target : knocked) {
    for (const TrackedFrame& frame : frames) {
      const std::vector<int>& rejected = frame.poses[body].rejected;
      target.excluded += std::binary_search(rejected.begin(), rejected.end(), target.target) ? 1 : 0;
    }
  }
}

}  // namespace

void describe(KnockOptions& options, OptionVisitor& visit) {
  visit.number("probability", options.probability, {1e-12, 0.1},
               "of accusing a body whose targets all stand where they should");
  visit.number("map_sigma_mm", options.map_sigma_mm, {1e-6, 100},
               "of a target's coordinates, each axis, where none is stated");
  visit.number("decisive", options.decisive, {0, 1e6},
               "a target whose shift explains the run worse by this much chi-square is no rival");
}

ShapeCheck check_shape(std::size_t body, std::span<const TrackedFrame> frames,
                       const std::vector<Body>& bodies, const StereoRig& rig, const KnockOptions& options,
                       const ViewOptions& views) {
  const std::vector<SeenShape> seen = seen_shapes(body, frames, bodies[body], views);
  const Body& shape = bodies[body];
  ShapeCheck check;
  VecX moved = VecX::Zero(static_cast<Eigen::Index>(3 * shape.targets.size()));
  // The second time about the shape found the first time: what is left over is linear.
  for (int round = 0; round < 2; ++round) {
    const ShapeEquations equations = shape_equations(seen, shape, rig, moved);
    if (equations.frames == 0) break;
    const ShapeTest test(equations, shape, options);
    check.knocked.clear();
    check.detectable_mm = detectable(equations, shape, options);
    check.detectable_at_once_mm = detectable(one_frame_of(equations), shape, options);
    const Hypothesis found = accuse(test, equations, options, check.knocked);
    check.misfit = ShapeTest::misfit(found);
    for (KnockedTarget& knocked : check.knocked) {
      const auto at = static_cast<Eigen::Index>(3 * knocked.target);
      moved.segment<3>(at) = found.shifts.segment<3>(at);
      knocked.shift_mm = moved.segment<3>(at);
      knocked.covariance = check.misfit * found.covariance.block<3, 3>(at, at);
      knocked.seen = equations.frames_seen[static_cast<std::size_t>(knocked.target)];
    }
  }
  count_refusals(body, frames, check.knocked);
  return check;
}

}  // namespace asterism
