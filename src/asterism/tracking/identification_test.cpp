// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/tracking/identification_scene_for_tests.hpp"

namespace asterism {
namespace {

using namespace identification_scene;

TEST(Identify, FindsEachBodyAmongGhostsWithTargetsHidden) {
  Seen seen;
  seen.add_ghosts(30);
  seen.add(1, kProbe, kElsewhere, {0, 1, 2, 4});
  seen.add(0, kPlatform, kThere, {5, 1, 3, 0});
  seen.add_ghosts(30);
  const auto found = identify(seen, {kPlatform, kProbe});
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].body, static_cast<int>(i));
    EXPECT_EQ(found[i].status, LabelStatus::Ok);
    EXPECT_EQ(found[i].points.size(), 4U);
    EXPECT_TRUE(all_right(found[i], seen));
    EXPECT_LT(found[i].rms_mm, 4 * kSigma);
  }
  EXPECT_LT((found[0].tracker_from_body * Vec3(0, 0, 600) - kThere * Vec3(0, 0, 600)).norm(), 0.3);
}

TEST(Identify, GivesTheSameLabelsWhereverTheSceneIs) {
  Seen seen;
  seen.add(0, kPlatform, kThere, {0, 1, 2, 4});
  seen.add_ghosts(40);
  const auto before = identify(seen, {kPlatform});
  for (Point& point : seen.points) point.in_tracker = kElsewhere * point.in_tracker;
  const auto after = identify(seen, {kPlatform});
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
  ASSERT_EQ(before[0].points.size(), after[0].points.size());
  for (std::size_t i = 0; i < before[0].points.size(); ++i) {
    EXPECT_EQ(before[0].points[i].point, after[0].points[i].point);
    EXPECT_EQ(before[0].points[i].target, after[0].points[i].target);
  }
  EXPECT_NEAR(before[0].rms_mm, after[0].rms_mm, 1e-9);
  const Vec6 off = difference(after[0].tracker_from_body, kElsewhere * before[0].tracker_from_body);
  EXPECT_LT(off.norm(), 1e-8);
}

TEST(Identify, GivesTheSameLabelsInWhateverOrderThePointsCome) {
  Seen seen;
  seen.add(0, kPlatform, kThere, {0, 1, 2, 4});
  seen.add_ghosts(40);
  seen.add(1, kProbe, kElsewhere, all_targets(kProbe));
  for (int trial = 0; trial < 20; ++trial) {
    for (std::size_t i = seen.points.size(); i > 1; --i) {
      const std::size_t j = seen.random.below(static_cast<std::uint32_t>(i));
      std::swap(seen.points[i - 1], seen.points[j]);
      std::swap(seen.truth[i - 1], seen.truth[j]);
    }
    const auto found = identify(seen, {kPlatform, kProbe});
    ASSERT_EQ(found.size(), 2U);
    for (const auto& labels : found) EXPECT_TRUE(all_right(labels, seen));
    EXPECT_EQ(found[0].points.size(), 4U);
    EXPECT_EQ(found[1].points.size(), 5U);
  }
}

TEST(Identify, RefusesAMirrorImage) {
  Seen seen;
  seen.add(0, kProbe, kThere, all_targets(kProbe));
  for (Point& point : seen.points) point.in_tracker.x() = -point.in_tracker.x();
  EXPECT_TRUE(identify(seen, {kProbe}).empty());
}

TEST(Identify, NeverFindsABodyByTwoTargetsEvenWithAPrior) {
  Seen seen;
  seen.add(0, kPlatform, kThere, {0, 1});
  seen.add_ghosts(3);
  EXPECT_TRUE(identify(seen, {kPlatform}, {prior_at(kThere, 0.03, 5)}).empty());
  const Body pair = body_of("pair", {{0, 0, 0}, {100, 0, 0}});
  Seen both;
  both.add(0, pair, kThere, {0, 1});
  both.add_ghosts(3);
  EXPECT_TRUE(identify(both, {pair}, {prior_at(kThere, 0.03, 5)}).empty());
}

TEST(Identify, FindsABodyOfThreeTargetsWhenThereIsLittleElse) {
  Seen seen;
  seen.add(0, kTriangle, kThere, all_targets(kTriangle));
  seen.add_ghosts(4);
  const auto found = identify(seen, {kTriangle});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_TRUE(all_right(found[0], seen));
  seen.add_ghosts(1000);
  EXPECT_TRUE(identify(seen, {kTriangle}).empty()) << "a thousand points hold many triangles";
}

TEST(Identify, IsNotMadeToDoubtByAWrongPriorNearWhichThreePointsHappenToFit) {
  // The body is where the frame shows it whole; the prior is far off, vague, and three ghosts fit it.
  const RigidMotion astray{(exp_rotation({0, 0, 2.9}) * kThere.rotation).normalized(),
                           kThere.translation + Vec3(600, 0, 200)};
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  for (const int target : {0, 1, 3})
    seen.add(astray * kPlatform.targets[static_cast<std::size_t>(target)].position);
  const auto found = identify(seen, {kPlatform}, {prior_at(astray, 0.35, 200)});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_EQ(found[0].points.size(), 6u);
  EXPECT_TRUE(all_right(found[0], seen));
}

TEST(Identify, RefusesCollinearTargetsWhichLeaveTheTurnAboutTheirLineOpen) {
  Seen seen;
  seen.add(0, kRod, kThere, all_targets(kRod));
  EXPECT_TRUE(identify(seen, {kRod}).empty());
  EXPECT_TRUE(identify(seen, {kRod}, {prior_at(kThere, 0.03, 5)}).empty());
}

TEST(Identify, DemandsMoreThanFourTargetsWherePointsAreManyAndVague) {
  Seen four;
  four.add(0, kPlatform, kThere, {0, 1, 3, 4});
  four.add_ghosts(400);
  Seen all;
  all.add(0, kPlatform, kThere, all_targets(kPlatform));
  all.add_ghosts(400);
  IdentificationOptions vague;
  vague.sigma_floor_mm = 1.0;
  const BodyCatalogue catalogue({kPlatform});
  EXPECT_TRUE(identify(four.points, catalogue, vague).empty());
  const auto found = identify(all.points, catalogue, vague);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_TRUE(all_right(found[0], all));
}

TEST(Identify, FindsNothingAmongGhosts) {
  const BodyCatalogue catalogue({kPlatform, kProbe});
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    Seen seen;
    seen.random = RandomStream(14, trial);
    seen.add_ghosts(80);
    EXPECT_TRUE(identify(seen.points, catalogue, {}).empty());
  }
}

TEST(Identify, UsesEachPointAndEachCentreOnce) {
  // The platform's points and, through every wrong pairing of two centres, ghosts that share them.
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  for (int i = 0; i < 6; ++i)
    seen.points[static_cast<std::size_t>(i)].left = seen.points[static_cast<std::size_t>(i)].right = i;
  for (int i = 0; i < 6; ++i) {
    const Vec3 place = seen.points[static_cast<std::size_t>(i)].in_tracker;
    seen.add(place * 1.05);
    seen.points.back().left = i;
    seen.points.back().right = (i + 1) % 6;
  }
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].points.size(), 6U);
  EXPECT_TRUE(all_right(found[0], seen));

  // Were two targets seen by the same left centre, one of them cannot be real.
  seen.points[1].left = 0;
  for (const auto& labels : identify(seen, {kPlatform})) {
    std::vector<int> left;
    for (const auto& label : labels.points)
      left.push_back(seen.points[static_cast<std::size_t>(label.point)].left);
    std::sort(left.begin(), left.end());
    EXPECT_EQ(std::adjacent_find(left.begin(), left.end()), left.end());
  }
}

TEST(Identify, WidensItsGatesWithTheCovarianceGiven) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  for (Point& point : seen.points) {  // depth ten times worse than the rest
    point.in_tracker.z() += 2.0 * seen.random.normal();
    point.covariance(2, 2) = 4.0;
  }
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].points.size(), 6U);
  for (Point& point : seen.points) point.covariance(2, 2) = kSigma * kSigma;
  for (const auto& labels : identify(seen, {kPlatform})) {
    EXPECT_LT(labels.points.size(), 6U) << "the same points, said to be good";
  }
}

TEST(Identify, TakesACovarianceOfZeroForUnknown) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  for (Point& point : seen.points) point.covariance.setZero();
  EXPECT_EQ(identify(seen, {kPlatform}).size(), 1U);
}

TEST(Identify, AddsTheCovarianceOfTheBodysTargets) {
  Body learnt = kPlatform;
  Seen seen;
  seen.add(0, learnt, kThere, all_targets(learnt));
  learnt.targets[3].position += Vec3(1.5, -2.0, 1.0);
  const auto strict = identify(seen, {learnt});
  ASSERT_EQ(strict.size(), 1U);
  EXPECT_EQ(strict[0].points.size(), 5U) << "the misplaced target does not fit";
  learnt.targets[3].covariance = 4.0 * Mat3::Identity();
  const auto lenient = identify(seen, {learnt});
  ASSERT_EQ(lenient.size(), 1U);
  EXPECT_EQ(lenient[0].points.size(), 6U);
}

TEST(Identify, IsQuietWithoutPointsBodiesOrEnoughOfThem) {
  EXPECT_TRUE(identify({}, {kPlatform}).empty());
  Seen seen;
  seen.add_ghosts(2);
  EXPECT_TRUE(identify(seen, {kPlatform}).empty());
  seen.add_ghosts(20);
  EXPECT_TRUE(identify(seen, {}).empty());
}

TEST(Identify, SurvivesPointsInOnePlace) {
  Seen seen;
  for (int i = 0; i < 50; ++i)
    seen.points.push_back({Vec3(0, 0, 2000), kSigma * kSigma * Mat3::Identity(), 0, -1, -1});
  EXPECT_TRUE(identify(seen.points, BodyCatalogue({kPlatform}), {}).empty());
}

TEST(Identify, SeeksOnlyBodiesWithAPriorAmongTenThousandPoints) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  seen.add(1, kProbe, kElsewhere, all_targets(kProbe));
  seen.add_ghosts(10000);
  const auto found = identify(seen, {kPlatform, kProbe}, {prior_at(kThere, 0.01, 2), std::nullopt});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].body, 0);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_TRUE(all_right(found[0], seen));
}

TEST(Identify, RefusesPointsThatAreNoNumbers) {
  const auto message = [](const Point& point) {
    const std::vector<Point> points = {{Vec3::Zero(), Mat3::Identity(), 0, -1, -1}, point};
    try {
      (void)identify(points, BodyCatalogue({kPlatform}), {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Point point{Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0), Mat3::Identity(), 0, -1, -1};
  EXPECT_EQ(message(point), "point 1: its place or covariance is not a finite number");
  point.in_tracker.setZero();
  point.covariance(0, 0) = -1;
  EXPECT_EQ(message(point), "point 1: its covariance is not positive definite");
}

TEST(Identify, TakesPriorsForEveryBodyOrNone) {
  EXPECT_THROW(identify(Seen{}, {kPlatform, kProbe}, {std::nullopt}), ContractViolation);
}

TEST(Identify, GivesTheSameBitsOnAnyNumberOfThreads) {
  const BodyCatalogue catalogue({kPlatform, kProbe, kNearlyTurned});
  const auto run = [&](int threads) {
    set_thread_count(threads);
    std::vector<std::vector<BodyLabels>> all(40);
    parallel_for(all.size(), [&](std::size_t i) {
      Seen seen;
      seen.random = RandomStream(15, i);
      seen.add(0, kPlatform, kThere, {0, 1, 2, 4});
      seen.add(2, kNearlyTurned, kElsewhere, {1, 2, 3, 4, 5});
      seen.add_ghosts(60);
      all[i] = identify(seen.points, catalogue, {});
    });
    set_thread_count(0);
    return all;
  };
  const auto one = run(1);
  const auto four = run(4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].size(), 2U);
    ASSERT_EQ(four[i].size(), 2U);
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_EQ(one[i][b].rms_mm, four[i][b].rms_mm);
      EXPECT_EQ(one[i][b].margin_mm, four[i][b].margin_mm);
      EXPECT_EQ(one[i][b].tracker_from_body.translation, four[i][b].tracker_from_body.translation);
    }
  }
}

TEST(BodyCatalogue, RefusesWhatIsNoBody) { EXPECT_THROW(BodyCatalogue({kPlatform, kPlatform}), InputError); }

}  // namespace
}  // namespace asterism
