// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/seeds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

DeployableSurface disc() { return {{{"top", Annulus{{0, 0, 600}, 0, 350}}}, {}}; }

/// Information that a point known to 0.1 mm gives, in each of three poses seen or not.
std::vector<PlaceInformation> places_for_tests(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<PlaceInformation> places;
  for (const Place& place : poisson_disc(disc(), 60, 0, count, random)) {
    Mat36 jacobian;
    jacobian << -skew(place.position_mm - Vec3(0, 0, 600)), Mat3::Identity();
    PlaceInformation information;
    for (int pose = 0; pose < 3; ++pose) {
      information.push_back(random.uniform() < 0.8 ? Mat6(jacobian.transpose() * jacobian / 0.01)
                                                   : Mat6(Mat6::Zero()));
    }
    places.push_back(information);
  }
  return places;
}

Mat6 prior_for_tests() {
  Vec6 weight;
  weight << Vec3::Constant(100), Vec3::Constant(1e-4);
  return weight.asDiagonal();
}

double gain_of(const std::vector<PlaceInformation>& places, unsigned mask) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Mat6 information = prior_for_tests();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if ((mask >> i) & 1U) information += places[i][k];
    }
    sum += *log_determinant_positive(information) - *log_determinant_positive(prior_for_tests());
  }
  return sum / 3;
}

TEST(GreedyLayouts, KeepTheirBoundAgainstTheTrueBest) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto places = places_for_tests(12, seed);
    const auto layouts = greedy_layouts(places, prior_for_tests(), 6);
    ASSERT_EQ(layouts.size(), 6U);
    for (std::size_t n = 1; n <= 6; ++n) {
      double best = 0;
      for (unsigned mask = 0; mask < 1U << places.size(); ++mask) {
        if (static_cast<std::size_t>(__builtin_popcount(mask)) == n) {
          best = std::max(best, gain_of(places, mask));
        }
      }
      unsigned chosen = 0;
      for (const std::size_t i : layouts[n - 1].places) chosen |= 1U << i;
      EXPECT_NEAR(layouts[n - 1].gain, gain_of(places, chosen), 1e-9);
      EXPECT_LE(best, layouts[n - 1].upper_bound + 1e-9);
      EXPECT_GE(layouts[n - 1].gain, (1 - 1 / std::exp(1.0)) * best);
      EXPECT_GE(layouts[n - 1].gain, layouts[n - 1].guaranteed * best - 1e-9);
      EXPECT_GE(layouts[n - 1].guaranteed, 1 - 1 / std::exp(1.0) - 1e-12);
    }
  }
}

TEST(GreedyLayouts, StopAtTheNumberOfPlaces) {
  const auto places = places_for_tests(4, 9);
  const auto layouts = greedy_layouts(places, prior_for_tests(), 12);
  ASSERT_EQ(layouts.size(), 4U);
  EXPECT_NEAR(layouts[3].guaranteed, 1, 1e-12);  // nothing is left to choose
  EXPECT_TRUE(greedy_layouts({}, prior_for_tests(), 12).empty());
}

TEST(GreedyLayouts, AreTheSameForAnyThreadCount) {
  const auto places = places_for_tests(40, 3);
  set_thread_count(1);
  const auto one = greedy_layouts(places, prior_for_tests(), 12);
  set_thread_count(4);
  const auto four = greedy_layouts(places, prior_for_tests(), 12);
  set_thread_count(0);
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].places, four[n].places);
    EXPECT_EQ(one[n].upper_bound, four[n].upper_bound);
  }
}

TEST(PoissonDisc, KeepsItsDistanceAndFillsTheSurface) {
  RandomStream random(8, 0);
  const auto places = poisson_disc(disc(), 100, 0, 1000, random);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((places[i].position_mm - places[j].position_mm).norm(), 100);
    }
  }
  EXPECT_GE(places.size(), 25U);  // random sequential packing covers some 55 % of the enlarged disc
  EXPECT_EQ(poisson_disc(disc(), 100, 0, 7, random).size(), 7U);
}

}  // namespace
}  // namespace asterism
