// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Stops on a plane in groups whose change costs extra, and there another time than back.
TourProblem scattered(std::size_t stops, std::uint64_t seed, double uneven = 0.3, double change_s = 8) {
  RandomStream random(seed, stops);
  std::vector<std::array<double, 2>> at(stops);
  for (auto& p : at) p = {random.uniform(0, 10), random.uniform(0, 10)};
  TourProblem problem;
  problem.stops = stops;
  for (std::size_t a = 0; a < stops; ++a)
    for (std::size_t b = 0; b < stops; ++b)
      problem.time_s.push_back(std::hypot(at[a][0] - at[b][0], at[a][1] - at[b][1]) *
                                   (1 + uneven * random.uniform()) +
                               (a % 3 == b % 3 ? 0 : change_s));
  return problem;
}

double length_of(const TourProblem& problem, const std::vector<std::uint32_t>& order) {
  double sum = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    sum += problem.time_s[order[k - 1] * problem.stops + order[k]];
  return sum;
}

void expect_sound(const TourProblem& problem, const Tour& tour) {
  std::vector<std::uint32_t> all(problem.stops), sorted = tour.order;
  std::iota(all.begin(), all.end(), 0);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, all);
  EXPECT_NEAR(tour.length_s, length_of(problem, tour.order), 1e-9);
  EXPECT_LE(tour.length_s, tour.nearest_length_s);
  if (problem.first) {
    EXPECT_EQ(tour.order.front(), *problem.first);
  }
}

/// Held & Karp (1962): the shortest way over each set of stops to each of its members.
double shortest(const TourProblem& problem) {
  const std::size_t n = problem.stops, sets = std::size_t{1} << n;
  std::vector<double> best(sets * n, std::numeric_limits<double>::infinity());
  for (std::size_t stop = 0; stop < n; ++stop)
    if (!problem.first || *problem.first == stop) best[(std::size_t{1} << stop) * n + stop] = 0;
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t last = 0; last < n; ++last)
      for (std::size_t next = 0; next < n; ++next) {
        if ((set >> next & 1U) != 0) continue;
        double& way = best[(set | std::size_t{1} << next) * n + next];
        way = std::min(way, best[set * n + last] + problem.time_s[last * n + next]);
      }
  return *std::min_element(best.end() - static_cast<std::ptrdiff_t>(n), best.end());
}

void expect_refused(const std::function<void(TourProblem&)>& spoil, const std::string& message) {
  TourProblem problem = scattered(3, 1);
  spoil(problem);
  try {
    (void)short_tour(problem);
    FAIL() << "taken, but expected: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ("tour: " + message, error.what());
  }
}

TEST(ShortTour, IsTheShortestOfFewStops) {
  for (std::size_t stops = 1; stops <= 11; ++stops)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      TourProblem problem = scattered(stops, seed);
      if (seed % 2 == 1) problem.first = static_cast<std::uint32_t>(stops / 2);
      const Tour tour = short_tour(problem);
      expect_sound(problem, tour);
      EXPECT_NEAR(tour.length_s, shortest(problem), 1e-9) << stops << " stops, seed " << seed;
    }
}

TEST(ShortTour, GoesAlongALine) {
  TourProblem problem;
  problem.stops = 30;
  for (std::size_t a = 0; a < 30; ++a)
    for (std::size_t b = 0; b < 30; ++b)  // the stops' places are shuffled by 7
      problem.time_s.push_back(std::abs(static_cast<double>(a * 7 % 30) - static_cast<double>(b * 7 % 30)));
  EXPECT_DOUBLE_EQ(short_tour(problem).length_s, 29);
}

TEST(ShortTour, StaysWithAGroupWhileThatSaves) {
  const TourProblem problem = scattered(60, 5);
  const Tour tour = short_tour(problem);
  expect_sound(problem, tour);
  int changes = 0;
  for (std::size_t k = 1; k < tour.order.size(); ++k) changes += tour.order[k - 1] % 3 != tour.order[k] % 3;
  EXPECT_EQ(changes, 2);
}

TEST(ShortTour, IsMuchShorterThanNearestNeighbourForManyStops) {
  TourProblem problem = scattered(150, 3, 0, 0);
  problem.first = 0;
  const Tour tour = short_tour(problem);
  expect_sound(problem, tour);
  // nearest neighbour is about a quarter longer than the shortest tour on a plane (Johnson & McGeoch 1997)
  EXPECT_LT(tour.length_s, 0.88 * tour.nearest_length_s);
  EXPECT_EQ(tour.order, short_tour(problem).order);
}

TEST(ShortTour, OfNoStopsIsEmpty) { EXPECT_TRUE(short_tour({}).order.empty()); }

TEST(ShortTour, RefusesTimesThatAreMissingOrCannotBe) {
  expect_refused([](TourProblem& p) { p.time_s.pop_back(); },
                 "8 times for 3 stops; 9 are needed, from each to each");
  expect_refused([](TourProblem& p) { p.time_s[5] = -1; },
                 "from stop 1 to 2 takes -1 s; it must be 0 or more");
  expect_refused([](TourProblem& p) { p.time_s[1] = std::nan(""); },
                 "from stop 0 to 1 takes nan s; it must be 0 or more");
  expect_refused([](TourProblem& p) { p.first = 3; }, "begins at stop 3, but there are 3, counted from 0");
}

}  // namespace
}  // namespace asterism
