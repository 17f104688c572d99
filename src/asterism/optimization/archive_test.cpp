// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"

namespace asterism {
namespace {

using Point = std::vector<double>;

std::vector<Point> points_of(std::size_t count, std::size_t m, std::uint64_t seed, std::uint32_t levels) {
  RandomStream random(seed, m);
  std::vector<Point> points(count, Point(m));
  for (Point& point : points)
    for (double& x : point) x = levels > 0 ? random.below(levels) : random.uniform();
  return points;
}

std::set<Point> first_front(const std::vector<Point>& points, std::size_t m) {
  std::vector<double> flat;
  for (const Point& point : points) flat.insert(flat.end(), point.begin(), point.end());
  const auto rank = non_dominated_ranks(flat, m);
  std::set<Point> front;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (rank[i] == 0) front.insert(points[i]);
  return front;
}

TEST(ParetoArchive, HoldsTheFirstFrontOfAllThatCame) {
  for (const std::size_t m : {1, 2, 3, 4, 6})
    for (const std::uint32_t levels : {0U, 5U, 40U}) {
      const auto points = points_of(2000, m, 103, levels);
      ParetoArchive archive(m);
      for (std::size_t i = 0; i < points.size(); ++i) archive.add(points[i], i);
      std::set<Point> held;
      for (const auto& member : archive.members()) {
        held.insert(member.objectives);
        EXPECT_EQ(points[member.number], member.objectives);
      }
      EXPECT_EQ(held, first_front(points, m)) << "m " << m << ", levels " << levels;
      EXPECT_EQ(held.size(), archive.size());
    }
}

TEST(ParetoArchive, DoesNotDependOnTheOrderInWhichPointsCome) {
  for (const std::size_t m : {2, 4}) {
    auto points = points_of(1500, m, 107, 0);
    ParetoArchive forwards(m), backwards(m);
    for (const Point& point : points) forwards.add(point, 0);
    std::ranges::reverse(points);
    for (const Point& point : points) backwards.add(point, 0);
    ASSERT_EQ(forwards.size(), backwards.size());
    const auto a = forwards.members(), b = backwards.members();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].objectives, b[i].objectives);
  }
}

TEST(ParetoArchive, NamesThoseDrivenOut) {
  for (const std::size_t m : {2, 3}) {
    const auto points = points_of(800, m, 109, 20);
    ParetoArchive archive(m);
    std::set<std::size_t> held;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (archive.add(points[i], i)) held.insert(i);
      for (const std::size_t gone : archive.dropped()) EXPECT_EQ(held.erase(gone), 1U);
      ASSERT_EQ(held.size(), archive.size());
    }
    std::set<std::size_t> numbers;
    for (const auto& member : archive.members()) numbers.insert(member.number);
    EXPECT_EQ(held, numbers);
  }
}

TEST(ParetoArchive, KeepsTheFirstOfEqualPoints) {
  for (const std::size_t m : {2, 3}) {
    ParetoArchive archive(m);
    const Point point(m, 1.0);
    EXPECT_TRUE(archive.add(point, 7));
    EXPECT_FALSE(archive.add(point, 8));
    EXPECT_EQ(archive.members()[0].number, 7U);
    archive.clear();
    EXPECT_EQ(archive.size(), 0U);
    EXPECT_TRUE(archive.add(point, 8));
  }
}

TEST(ParetoArchive, GrowsWithoutLimit) {
  ParetoArchive archive(3);
  RandomStream random(113, 0);
  for (std::size_t i = 0; i < 5000; ++i) {
    const double a = random.uniform(0, 1.57), b = random.uniform(0, 1.57);
    archive.add(Point{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)}, i);
  }
  EXPECT_GT(archive.size(), 4990U);
}

TEST(ParetoArchive, RefusesWhatIsNotANumber) {
  ParetoArchive archive(2);
  EXPECT_THROW(archive.add(Point{0, std::nan("")}, 0), ContractViolation);
  EXPECT_THROW(archive.add(Point{0, 0, 0}, 0), ContractViolation);
}

}  // namespace
}  // namespace asterism
