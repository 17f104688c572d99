// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/core/random.hpp"
#include "asterism/optimization/front_thinning.hpp"
#include "asterism/optimization/hypervolume.hpp"
#include "asterism/optimization/surface_thinning.hpp"

namespace asterism {
namespace {

using Positions = std::vector<std::uint32_t>;

/// The textbook's: of those left, the one of least contribution goes.
Positions textbook(const std::vector<double>& front, std::size_t m, std::size_t keep,
                   const std::vector<double>& reference) {
  Positions left(front.size() / m);
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  while (left.size() > keep) {
    std::vector<double> points;
    for (const std::uint32_t i : left) points.insert(points.end(), &front[i * m], &front[i * m] + m);
    const auto shares = hypervolume_contributions(points, m, reference);
    left.erase(left.begin() + (std::ranges::min_element(shares) - shares.begin()));
  }
  return left;
}

double volume(const std::vector<double>& front, const Positions& of, const std::vector<double>& reference) {
  std::vector<double> points;
  for (const std::uint32_t i : of) points.insert(points.end(), &front[i * 3], &front[i * 3] + 3);
  return hypervolume(points, 3, reference);
}

std::vector<double> spherical_front(std::size_t count, std::size_t m, RandomStream& random) {
  std::vector<double> front(count * m);
  for (std::size_t i = 0; i < count * m; i += m) {
    double norm = 0;
    for (std::size_t k = 0; k < m; ++k) {
      front[i + k] = random.uniform(0.01, 1);
      norm += front[i + k] * front[i + k];
    }
    for (std::size_t k = 0; k < m; ++k) front[i + k] /= std::sqrt(norm);
  }
  return front;
}

TEST(FrontThinning, LeavesOutWhatTheTextbookWould) {
  FrontThinning thin;
  for (std::uint64_t set = 0; set < 100; ++set) {
    RandomStream random(97, set);
    std::vector<double> x(2 + random.below(60)), y, front;
    for (double& value : x) value = random.uniform();
    std::ranges::sort(x);
    for (const double value : x) y.push_back(1 - std::sqrt(value));
    for (std::size_t i = 0; i < x.size(); ++i) front.insert(front.end(), {x[i], y[i]});
    const std::size_t keep = 2 + random.below(static_cast<std::uint32_t>(x.size()) - 1);
    const auto kept = thin(x, y, keep);
    // So far off, a reference never lets an end go.
    EXPECT_EQ(Positions(kept.begin(), kept.end()), textbook(front, 2, keep, {1e3, 1e3}));
  }
}

TEST(FrontThinning, TellsTheSharesOfThoseKept) {
  FrontThinning thin;
  const std::vector<double> x = {0, 1, 1.1, 3, 5}, y = {9, 6, 5.9, 2, 0};
  const auto kept = thin(x, y, 4);
  EXPECT_EQ(Positions(kept.begin(), kept.end()), (Positions{0, 1, 3, 4}));
  EXPECT_TRUE(std::isinf(thin.contributions()[0]));
  EXPECT_DOUBLE_EQ(thin.contributions()[1], 6.0);
  EXPECT_DOUBLE_EQ(thin.contributions()[2], 8.0);
}

TEST(FrontThinning, KeepsOneOrNoneIfSoAsked) {
  FrontThinning thin;
  const std::vector<double> x = {0, 1, 2}, y = {2, 1, 0};
  EXPECT_EQ(thin(x, y, 1).size(), 1U);
  EXPECT_EQ(thin(x, y, 0).size(), 0U);
  EXPECT_EQ(thin({}, {}, 0).size(), 0U);
  EXPECT_EQ(thin(std::array{1.0}, std::array{1.0}, 1).size(), 1U);
}

TEST(SurfaceThinning, LeavesOutWhatTheTextbookWould) {
  SurfaceThinning thin;
  for (std::uint64_t set = 0; set < 60; ++set) {
    RandomStream random(101, set);
    const std::size_t count = 2 + random.below(70);
    const auto front = spherical_front(count, 3, random);
    const std::size_t keep = random.below(static_cast<std::uint32_t>(count));
    const std::vector<double> reference(3, set % 3 == 0 ? 0.8 : 1.1);
    const auto kept = thin(front, keep, reference);
    const Positions ours(kept.begin(), kept.end());
    const Positions theirs = textbook(front, 3, keep, reference);
    if (set % 3 == 0)  // those beyond the reference are all worth nothing, whichever goes first
      EXPECT_NEAR(volume(front, ours, reference), volume(front, theirs, reference), 1e-12) << "set " << set;
    else
      EXPECT_EQ(ours, theirs) << "set " << set;
  }
}

TEST(SurfaceThinning, ParesCopiesFirst) {
  SurfaceThinning thin;
  std::vector<double> front;
  for (int copy = 0; copy < 2; ++copy)
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) front.insert(front.end(), {x, 1 - x, x * (1 - x)});
  const auto kept = thin(front, 5, std::array{1.1, 1.1, 1.1});
  std::vector<double> x;
  for (const std::uint32_t i : kept) x.push_back(front[3 * i]);
  std::ranges::sort(x);
  EXPECT_EQ(x, (std::vector{0.0, 0.25, 0.5, 0.75, 1.0}));
}

}  // namespace
}  // namespace asterism
