// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/hypervolume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

std::vector<double> random_points(std::size_t count, std::size_t m, std::uint64_t seed,
                                  std::uint32_t levels = 0) {
  RandomStream random(seed, m);
  std::vector<double> points(count * m);
  for (double& x : points)
    x = levels > 0 ? random.below(levels) / static_cast<double>(levels) : random.uniform();
  return points;
}

/// A front: no point of it dominates another; with `levels`, many share coordinates.
std::vector<double> random_front(std::size_t count, std::size_t m, std::uint64_t seed,
                                 std::uint32_t levels = 0) {
  auto points = random_points(count, m, seed, levels);
  if (seed % 2 == 0) {  // on a plane, where nearly none dominates another
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 1e-3;
      for (std::size_t k = 0; k < m; ++k) sum += points[i * m + k];
      for (std::size_t k = 0; k < m; ++k) points[i * m + k] /= sum;
    }
  }
  std::vector<double> front;
  for (std::size_t i = 0; i < count; ++i) {
    bool dominated = false;
    for (std::size_t j = 0; j < count && !dominated; ++j) {
      bool at_most = true, less = false;
      for (std::size_t k = 0; k < m; ++k) {
        at_most &= points[j * m + k] <= points[i * m + k];
        less |= points[j * m + k] < points[i * m + k];
      }
      dominated = at_most && less;
    }
    for (std::size_t k = 0; !dominated && k < m; ++k) front.push_back(points[i * m + k]);
  }
  return front;
}

/// Inclusion and exclusion over all subsets of the points.
double textbook(const std::vector<double>& points, std::size_t m, const std::vector<double>& reference) {
  const std::size_t count = points.size() / m;
  double volume = 0;
  for (std::uint32_t subset = 1; subset < 1U << count; ++subset) {
    double common = 1;
    for (std::size_t k = 0; k < m; ++k) {
      double corner = -1e300;
      for (std::size_t i = 0; i < count; ++i)
        if (subset >> i & 1) corner = std::max(corner, points[i * m + k]);
      common *= std::max(0.0, reference[k] - corner);
    }
    volume += std::popcount(subset) % 2 == 1 ? common : -common;
  }
  return volume;
}

TEST(Hypervolume, IsThatOfInclusionAndExclusion) {
  for (std::uint64_t set = 0; set < 200; ++set) {
    const std::size_t m = 1 + set % 6;
    const auto points = random_points(1 + set % 11, m, 71 + set, set % 2 ? 4 : 0);
    const std::vector<double> reference(m, 0.9);  // some points lie beyond
    ASSERT_NEAR(hypervolume(points, m, reference), textbook(points, m, reference), 1e-12)
        << "set " << set << ", m " << m;
  }
}

TEST(Hypervolume, IsKnownInClosedForm) {
  EXPECT_DOUBLE_EQ(hypervolume(std::vector{1.0, 3.0, 2.0, 1.0}, 2, std::vector{4.0, 4.0}), 7.0);
  EXPECT_DOUBLE_EQ(hypervolume(std::vector{1.0, 2.0, 3.0}, 3, std::vector{4.0, 4.0, 4.0}), 6.0);
  EXPECT_EQ(hypervolume({}, 3, std::vector{1.0, 1.0, 1.0}), 0);
  EXPECT_EQ(hypervolume(std::vector{1.0, 0.0}, 2, std::vector{1.0, 1.0}), 0);

  // A unit sphere's octant seen from the corner (1, 1, 1): the finer the front, the nearer 1 − π/6.
  std::vector<double> sphere;
  constexpr int kSteps = 300;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double a = i * std::numbers::pi / 2 / kSteps, b = j * std::numbers::pi / 2 / kSteps;
      sphere.insert(sphere.end(), {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
    }
  EXPECT_NEAR(hypervolume(sphere, 3, std::vector{1.0, 1.0, 1.0}), 1 - std::numbers::pi / 6, 0.01);
}

TEST(Hypervolume, OfManyPointsAgreesWithDrawingLots) {
  for (const std::size_t m : {3, 4, 5}) {
    const auto points = random_points(60, m, 73);
    const std::vector<double> reference(m, 1.0);
    RandomStream random(79, m);
    constexpr int kDraws = 100000;
    int inside = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<double> at(m);
      for (double& x : at) x = random.uniform();
      bool dominated = false;
      for (std::size_t i = 0; i < points.size() && !dominated; i += m) {
        dominated = true;
        for (std::size_t k = 0; k < m; ++k) dominated &= points[i + k] <= at[k];
      }
      inside += dominated ? 1 : 0;
    }
    const double share = static_cast<double>(inside) / kDraws;
    const double four_sigmas = 4 * std::sqrt(share * (1 - share) / kDraws);
    EXPECT_NEAR(hypervolume(points, m, reference), share, four_sigmas);
  }
}

TEST(Hypervolume, OfAnEmbeddedFrontIsTheSameInMoreObjectives) {
  // One more objective that is nought for all and one at the reference multiplies by one.
  const auto points = random_points(40, 3, 83);
  std::vector<double> more;
  for (std::size_t i = 0; i < points.size(); i += 3)
    more.insert(more.end(), {points[i], 0, points[i + 1], points[i + 2], 0});
  EXPECT_NEAR(hypervolume(more, 5, std::vector<double>(5, 1.0)),
              hypervolume(points, 3, std::vector<double>(3, 1.0)), 1e-12);
}

TEST(HypervolumeContributions, AreTheDifferencesOfHypervolumes) {
  for (std::uint64_t set = 0; set < 400; ++set) {
    const std::size_t m = 2 + set % 2;
    auto front = random_front(2 + set % 60, m, 89 + set, set % 3 == 0 ? 6 : 0);
    if (set % 5 == 0)
      front.insert(front.end(), front.begin(), front.begin() + static_cast<std::ptrdiff_t>(m));
    const std::vector<double> reference(m, set % 7 == 0 ? 0.7 : 1.1);
    const auto contributions = hypervolume_contributions(front, m, reference);
    const double whole = hypervolume(front, m, reference);
    for (std::size_t i = 0; i < front.size() / m; ++i) {
      auto rest = front;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i * m),
                 rest.begin() + static_cast<std::ptrdiff_t>((i + 1) * m));
      ASSERT_NEAR(contributions[i], whole - hypervolume(rest, m, reference), 1e-13)
          << "set " << set << ", point " << i;
    }
  }
}

TEST(HypervolumeContributions, RefusePointsThatAreNoFront) {
  EXPECT_THROW(
      static_cast<void>(hypervolume_contributions(std::vector{0.0, 0.0, 0.5, 0.5}, 2, std::vector{1.0, 1.0})),
      ContractViolation);
  EXPECT_THROW(static_cast<void>(hypervolume_contributions(std::vector{0.0, 0.0, 0.0, 0.5, 0.5, 0.5}, 3,
                                                           std::vector{1.0, 1.0, 1.0})),
               ContractViolation);
  EXPECT_THROW(
      static_cast<void>(hypervolume_contributions(std::vector<double>(4), 4, std::vector<double>(4, 1.0))),
      ContractViolation);
}

}  // namespace
}  // namespace asterism
