// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning_congruence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

// A distance is accepted within this many sigmas (plus the deformation).
constexpr double kDistanceGate = 5.5;
// A triangle flatter than this share of its longest side turns freely about it.
constexpr double kFlatTriangle = 0.05;

struct Distance {
  double mm;
  double variance;
};

/// Distances between all points of one set.
struct DistanceTable {
  std::size_t size;
  std::vector<Distance> values;

  [[nodiscard]] const Distance& operator()(std::size_t i, std::size_t j) const {
    return values[i * size + j];
  }
};

DistanceTable distances_of(std::span<const Point> points) {
  DistanceTable table{points.size(), std::vector<Distance>(points.size() * points.size(), Distance{0, 0})};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 difference = points[i].in_tracker - points[j].in_tracker;
      const double mm = difference.norm();
      const Vec3 along = mm > 0 ? Vec3(difference / mm) : Vec3::UnitX();
      const Distance distance{mm, along.dot((points[i].covariance + points[j].covariance) * along)};
      table.values[i * points.size() + j] = distance;
      table.values[j * points.size() + i] = distance;
    }
  }
  return table;
}

bool alike(const Distance& a, const Distance& b, double deformation_mm) {
  const double beyond = std::abs(a.mm - b.mm) - deformation_mm;
  return beyond <= 0 || beyond * beyond <= kDistanceGate * kDistanceGate * (a.variance + b.variance);
}

struct Candidate {
  double chi_square;
  PointPair pair;
};

/// Of the candidates the nearest first, each point and each centre once.
std::vector<PointPair> one_to_one(std::span<const Point> a, std::span<const Point> b,
                                  std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& p, const Candidate& q) { return p.chi_square < q.chi_square; });
  std::vector<PointPair> pairs;
  for (const Candidate& candidate : candidates) {
    const Point& pa = a[static_cast<std::size_t>(candidate.pair.a)];
    const Point& pb = b[static_cast<std::size_t>(candidate.pair.b)];
    const bool taken = std::any_of(pairs.begin(), pairs.end(), [&](const PointPair& pair) {
      return pair.a == candidate.pair.a || pair.b == candidate.pair.b ||
             share_a_centre(a[static_cast<std::size_t>(pair.a)], pa) ||
             share_a_centre(b[static_cast<std::size_t>(pair.b)], pb);
    });
    if (!taken) pairs.push_back(candidate.pair);
  }
  std::sort(pairs.begin(), pairs.end(), [](const PointPair& p, const PointPair& q) { return p.a < q.a; });
  return pairs;
}

/// All pairs a motion takes near each other; a point or a centre may come in several.
std::vector<Candidate> candidates_within(std::span<const Point> a, std::span<const Point> b,
                                         const Congruence& motion, double deformation_mm) {
  constexpr double kFar_mm = 20.0;  // farther than any gate reaches; saves the inverse for nearly all
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 there = motion.b_from_a * a[i].in_tracker;
    for (std::size_t j = 0; j < b.size(); ++j) {
      if ((b[j].in_tracker - there).squaredNorm() > kFar_mm * kFar_mm) continue;
      const double chi_square =
          mahalanobis_square(motion.b_from_a, motion.covariance, a[i], b[j], deformation_mm);
      if (chi_square <= kPointGate)
        candidates.push_back({chi_square, {static_cast<int>(i), static_cast<int>(j)}});
    }
  }
  return candidates;
}

bool flat(double d1, double d2, double d3) {
  const double longest = std::max({d1, d2, d3});
  const double half = 0.5 * (d1 + d2 + d3);
  const double area2 = half * (half - d1) * (half - d2) * (half - d3);
  return !(area2 > 0) || 2.0 * std::sqrt(area2) < kFlatTriangle * longest * longest;
}

/// Grows one triangle to all points its motion takes onto each other.
std::optional<Congruence> grow(std::span<const Point> a, std::span<const Point> b,
                               std::vector<PointPair> triangle, double deformation_mm,
                               std::size_t least_size) {
  auto found = fit_pairs(a, b, std::move(triangle), deformation_mm);
  if (!found || found->chi_square > 3 * kPointGate) return std::nullopt;
  // A triangle's motion is uncertain, and so its gate is wide; each round knows the motion better.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    auto pairs = one_to_one(a, b, candidates_within(a, b, *found, deformation_mm));
    if (pairs.size() < least_size) return std::nullopt;
    found = fit_pairs(a, b, std::move(pairs), deformation_mm);
    if (!found) return std::nullopt;
  }
  return found;
}

using Triangle = std::array<PointPair, 3>;

/// Calls back once for each triangle of the first set that has equal sides with one of the second, and
/// each way to lay it there.
template <class Callback>
void for_each_congruent_triangle(const DistanceTable& a, const DistanceTable& b, double deformation_mm,
                                 const Callback& callback) {
  const auto pair = [](std::size_t i, std::size_t j) {
    return PointPair{static_cast<int>(i), static_cast<int>(j)};
  };
  const auto third_corners = [&](std::size_t i, std::size_t k, std::size_t j, std::size_t l) {
    for (std::size_t m = k + 1; m < a.size; ++m) {
      if (flat(a(i, k).mm, a(i, m).mm, a(k, m).mm)) continue;
      for (std::size_t n = 0; n < b.size; ++n) {
        if (n == j || n == l) continue;
        if (!alike(a(i, m), b(j, n), deformation_mm) || !alike(a(k, m), b(l, n), deformation_mm)) continue;
        callback(Triangle{pair(i, j), pair(k, l), pair(m, n)});
      }
    }
  };
  for (std::size_t i = 0; i < a.size; ++i) {
    for (std::size_t k = i + 1; k < a.size; ++k) {
      for (std::size_t j = 0; j < b.size; ++j) {
        for (std::size_t l = 0; l < b.size; ++l) {
          if (l != j && alike(a(i, k), b(j, l), deformation_mm)) third_corners(i, k, j, l);
        }
      }
    }
  }
}

bool shares_centres(std::span<const Point> a, std::span<const Point> b, const Triangle& t) {
  const auto shared = [&](const PointPair& p, const PointPair& q) {
    return share_a_centre(a[static_cast<std::size_t>(p.a)], a[static_cast<std::size_t>(q.a)]) ||
           share_a_centre(b[static_cast<std::size_t>(p.b)], b[static_cast<std::size_t>(q.b)]);
  };
  return shared(t[0], t[1]) || shared(t[0], t[2]) || shared(t[1], t[2]);
}

/// Which pairs a motion already found explains, ghosts of the same centres included: what is explained
/// starts no search again.
class Explained {
 public:
  Explained(std::span<const Point> a, std::span<const Point> b, const Congruence& motion,
            double deformation_mm)
      : columns_(b.size()), pairs_(a.size() * b.size(), false) {
    for (const Candidate& one : candidates_within(a, b, motion, deformation_mm))
      pairs_[index(one.pair)] = true;
  }
  [[nodiscard]] bool holds(std::span<const PointPair> pairs) const {
    return std::all_of(pairs.begin(), pairs.end(),
                       [&](const PointPair& pair) { return pairs_[index(pair)]; });
  }

 private:
  [[nodiscard]] std::size_t index(const PointPair& pair) const {
    return static_cast<std::size_t>(pair.a) * columns_ + static_cast<std::size_t>(pair.b);
  }
  std::size_t columns_;
  std::vector<bool> pairs_;
};

bool is_part_of(const Congruence& part, const Congruence& whole) {
  return std::all_of(part.pairs.begin(), part.pairs.end(), [&](const PointPair& pair) {
    return std::find(whole.pairs.begin(), whole.pairs.end(), pair) != whole.pairs.end();
  });
}

}  // namespace

bool share_a_centre(const Point& p, const Point& q) {
  return (p.left >= 0 && p.left == q.left) || (p.right >= 0 && p.right == q.right);
}

double mahalanobis_square(const RigidMotion& b_from_a, const Mat6& motion_covariance, const Point& a,
                          const Point& b, double deformation_mm) {
  const Mat3 rotation = b_from_a.rotation.toRotationMatrix();
  const Mat3 covariance = b.covariance + rotation * a.covariance * rotation.transpose() +
                          covariance_of_point(b_from_a, motion_covariance, a.in_tracker) +
                          deformation_mm * deformation_mm * Mat3::Identity();
  const Vec3 apart = b.in_tracker - b_from_a * a.in_tracker;
  return apart.dot(covariance.inverse() * apart);
}

std::optional<Congruence> fit_pairs(std::span<const Point> a, std::span<const Point> b,
                                    std::vector<PointPair> pairs, double deformation_mm) {
  std::vector<Vec3> in_a, in_b;
  for (const PointPair& pair : pairs) {
    in_a.push_back(a[static_cast<std::size_t>(pair.a)].in_tracker);
    in_b.push_back(b[static_cast<std::size_t>(pair.b)].in_tracker);
  }
  const auto start = fit_rigid_motion(in_b, in_a);
  if (!start) return std::nullopt;
  Congruence fit{start->a_from_b, std::move(pairs)};
  constexpr int kSteps = 2;
  for (int step = 0; step <= kSteps; ++step) {
    const Mat3 rotation = fit.b_from_a.rotation.toRotationMatrix();
    Mat6 normal = Mat6::Zero();
    Vec6 gradient = Vec6::Zero();
    fit.chi_square = 0;
    for (const PointPair& pair : fit.pairs) {
      const Point& pa = a[static_cast<std::size_t>(pair.a)];
      const Point& pb = b[static_cast<std::size_t>(pair.b)];
      const Mat3 weight = Mat3(pb.covariance + rotation * pa.covariance * rotation.transpose() +
                               deformation_mm * deformation_mm * Mat3::Identity())
                              .inverse();
      const Vec3 apart = pb.in_tracker - fit.b_from_a * pa.in_tracker;
      Mat36 by_motion;
      by_motion << -skew(rotation * pa.in_tracker), Mat3::Identity();
      normal += by_motion.transpose() * weight * by_motion;
      gradient += by_motion.transpose() * (weight * apart);
      fit.chi_square += apart.dot(weight * apart);
    }
    if (step == kSteps) {
      const auto covariance = inverse_positive(normal);
      if (!covariance) return std::nullopt;
      fit.covariance = *covariance;
      break;
    }
    const auto update = solve_positive(normal, gradient);
    if (!update) break;
    fit.b_from_a = perturbed(fit.b_from_a, *update);
  }
  return fit;
}

std::vector<Congruence> congruent_subsets(std::span<const Point> a, std::span<const Point> b,
                                          double deformation_mm, std::size_t least_size) {
  require(least_size >= 3, "a congruent subset has three points or more");
  std::vector<Congruence> found;
  std::vector<Explained> explained;
  for_each_congruent_triangle(
      distances_of(a), distances_of(b), deformation_mm, [&](const Triangle& triangle) {
        if (shares_centres(a, b, triangle)) return;
        if (std::any_of(explained.begin(), explained.end(),
                        [&](const Explained& one) { return one.holds(triangle); }))
          return;
        auto grown = grow(a, b, {triangle.begin(), triangle.end()}, deformation_mm, least_size);
        if (!grown) return;
        explained.emplace_back(a, b, *grown, deformation_mm);
        found.push_back(std::move(*grown));
      });
  std::stable_sort(found.begin(), found.end(), [](const Congruence& p, const Congruence& q) {
    return p.pairs.size() != q.pairs.size() ? p.pairs.size() > q.pairs.size() : p.chi_square < q.chi_square;
  });
  // Larger ones come first now: what they hold is no subset of its own.
  std::vector<Congruence> largest;
  for (Congruence& one : found) {
    const bool part =
        std::any_of(largest.begin(), largest.end(), [&](const Congruence& l) { return is_part_of(one, l); });
    if (!part) largest.push_back(std::move(one));
  }
  return largest;
}

}  // namespace asterism
