// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kSigma = 0.05;

Body body_of(const std::string& name, const std::vector<Vec3>& positions) {
  Body body{name, {}};
  for (const Vec3& position : positions) {
    body.targets.push_back({"T" + std::to_string(body.targets.size() + 1), position, {}, {}, {}});
  }
  return body;
}

// Table 1 S3, S1 and Table 9 S4 (exactly symmetric) of Machines 2025, 13, 592; a probe; two small ones.
const Body kPlatform = body_of("platform", {{200, -100, 590},
                                            {-100, 300, 610},
                                            {-200, 100, 600},
                                            {0, -250, 605},
                                            {210, 180, 580},
                                            {-200, -240, 590}});
const Body kNearlyTurned = body_of(
    "nearly",
    {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}, {220, 220, 580}, {-220, -220, 605}});
const Body kSymmetric =
    body_of("symmetric", {{220, 220, 580}, {220, -220, 590}, {-220, 220, 595}, {-220, -220, 605}});
const Body kProbe = body_of("probe", {{0, 0, 0}, {61, 0, 10}, {12, 95, -20}, {-40, 50, 130}, {30, -70, 90}});
const Body kTriangle = body_of("triangle", {{0, 0, 0}, {70, 0, 0}, {20, 50, 0}});
const Body kRod = body_of("rod", {{0, 0, 0}, {50, 0, 0}, {105, 0, 0}, {190, 0, 0}});

const RigidMotion kThere{exp_rotation(Vec3(0.3, -0.4, 1.1)), Vec3(120, -80, 2300)};
const RigidMotion kElsewhere{exp_rotation(Vec3(-0.8, 1.2, 0.2)), Vec3(-500, 300, 2600)};

/// What is seen of bodies, and what of it is true.
struct Seen {
  std::vector<Point> points;
  std::vector<std::pair<int, int>> truth;  // body, target
  RandomStream random{11, 0};

  void add(const Vec3& place, std::pair<int, int> of = {-1, -1}) {
    const Vec3 noise(random.normal(), random.normal(), random.normal());
    points.push_back({place + kSigma * noise, kSigma * kSigma * Mat3::Identity(), 0, -1, -1});
    truth.push_back(of);
  }
  void add(int index, const Body& body, const RigidMotion& tracker_from_body,
           const std::vector<int>& targets) {
    for (const int t : targets) {
      add(tracker_from_body * body.targets[static_cast<std::size_t>(t)].position, {index, t});
    }
  }
  void add_ghosts(int count) {
    for (int i = 0; i < count; ++i) {
      add(Vec3(random.uniform(-1000, 1000), random.uniform(-1000, 1000), random.uniform(1700, 3200)));
    }
  }
};

std::vector<int> all_targets(const Body& body) {
  std::vector<int> targets(body.targets.size());
  std::iota(targets.begin(), targets.end(), 0);
  return targets;
}

testing::AssertionResult all_right(const BodyLabels& labels, const Seen& seen) {
  for (const auto& label : labels.points) {
    if (seen.truth[static_cast<std::size_t>(label.point)] == std::make_pair(labels.body, label.target))
      continue;
    return testing::AssertionFailure()
           << "point " << label.point << " is not target " << label.target << " of body " << labels.body;
  }
  return testing::AssertionSuccess();
}

PriorPose prior_at(const RigidMotion& tracker_from_body, double sigma_rad, double sigma_mm) {
  Vec6 variances;
  variances << Vec3::Constant(sigma_rad * sigma_rad), Vec3::Constant(sigma_mm * sigma_mm);
  return {tracker_from_body, variances.asDiagonal()};
}

std::vector<BodyLabels> identify(const Seen& seen, const std::vector<Body>& bodies,
                                 const std::vector<std::optional<PriorPose>>& priors = {}) {
  return identify(seen.points, BodyCatalogue(bodies), {}, priors);
}

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

TEST(Identify, GivesTheLayoutsMarginForTheTargetsSeen) {
  Seen seen;
  seen.add(0, kNearlyTurned, kThere, all_targets(kNearlyTurned));
  const auto found = identify(seen, {kNearlyTurned});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_NEAR(found[0].margin_mm, 14.2, 0.05) << "the margin of S1 with all targets seen";
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

TEST(Identify, CallsALayoutThatFitsItselfTurnedAmbiguousWhateverTheNoiseFavours) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Seen seen;
    seen.random = RandomStream(12, trial);
    seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
    seen.add_ghosts(10);
    const auto found = identify(seen, {kSymmetric});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
    EXPECT_LT(found[0].margin_mm, 0.01);
  }
}

TEST(Identify, CallsAPartlyHiddenLayoutAmbiguousWhenWhatIsLeftIsNearlySymmetric) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Seen seen;
    seen.random = RandomStream(13, trial);
    seen.add(0, kNearlyTurned, kThere, {0, 1, 2, 3});
    const auto found = identify(seen, {kNearlyTurned});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
    EXPECT_NEAR(found[0].margin_mm, 0.198, 0.15) << "less what the noise gives to the rival";
  }
}

TEST(Identify, SettlesAnAmbiguityByAPriorThatIsNear) {
  Seen seen;
  seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
  Vec6 moved;
  moved << 0.02, -0.01, 0.03, 2, -3, 1;
  const auto prior = prior_at(perturbed(kThere, moved), 0.03, 5);
  const auto found = identify(seen, {kSymmetric}, {prior});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_TRUE(all_right(found[0], seen));
}

TEST(Identify, LeavesAnAmbiguityToAPriorThatIsFarOrVague) {
  Seen seen;
  seen.add(0, kSymmetric, kThere, all_targets(kSymmetric));
  const auto vague = prior_at(kThere, 2.0, 500);
  const RigidMotion turned = kThere * RigidMotion{exp_rotation(Vec3(0, 0, 1.4)), Vec3::Zero()};
  for (const auto& prior : {vague, prior_at(turned, 0.03, 5)}) {
    const auto found = identify(seen, {kSymmetric}, {prior});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
  }
}

TEST(Identify, TakesThreeTargetsOnlyWithAPriorNear) {
  Seen seen;
  seen.add(0, kPlatform, kThere, {0, 1, 3});
  seen.add_ghosts(30);
  EXPECT_TRUE(identify(seen, {kPlatform}).empty());
  EXPECT_TRUE(identify(seen, {kPlatform}, {prior_at(kElsewhere, 0.03, 5)}).empty());
  const auto found = identify(seen, {kPlatform}, {prior_at(kThere, 0.03, 5)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_EQ(found[0].points.size(), 3U);
  EXPECT_TRUE(all_right(found[0], seen));
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

TEST(Identify, CannotTellWhichOfTwinsItSees) {
  Body twin = kPlatform;
  twin.name = "twin";
  Seen one;
  one.add(0, kPlatform, kThere, all_targets(kPlatform));
  const auto single = identify(one, {kPlatform, twin});
  ASSERT_EQ(single.size(), 1U) << "points are given to one body only";
  EXPECT_EQ(single[0].status, LabelStatus::Ambiguous);
  EXPECT_LT(single[0].margin_mm, 1e-6);

  one.add(1, twin, kElsewhere, all_targets(twin));
  const auto both = identify(one, {kPlatform, twin});
  ASSERT_EQ(both.size(), 2U);
  for (const auto& labels : both) EXPECT_EQ(labels.status, LabelStatus::Ambiguous);

  const auto settled =
      identify(one, {kPlatform, twin}, {prior_at(kThere, 0.03, 5), prior_at(kElsewhere, 0.03, 5)});
  ASSERT_EQ(settled.size(), 2U);
  for (const auto& labels : settled) {
    EXPECT_EQ(labels.status, LabelStatus::Ok);
    EXPECT_TRUE(all_right(labels, one));
  }
}

TEST(Identify, CallsABodySeenTwiceAmbiguous) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  seen.add(0, kPlatform, kElsewhere, all_targets(kPlatform));
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ambiguous);
}

TEST(Identify, LeavesOutATargetThatTwoPointsContest) {
  Seen seen;
  seen.add(0, kPlatform, kThere, all_targets(kPlatform));
  seen.add(kThere * kPlatform.targets[2].position + Vec3(0.2, 0.1, -0.1));
  const auto found = identify(seen, {kPlatform});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, LabelStatus::Ok);
  EXPECT_EQ(found[0].points.size(), 5U);
  EXPECT_TRUE(all_right(found[0], seen));
  for (const auto& label : found[0].points) EXPECT_NE(label.target, 2);
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

TEST(BodyCatalogue, CountsOtherBodiesInTheMargin) {
  Body near_twin = kProbe;
  near_twin.name = "near twin";
  near_twin.targets[3].position.z() += 3;
  const double alone = BodyCatalogue({kProbe}).margin_mm(0, {0, 1, 2, 3, 4});
  const double beside = BodyCatalogue({kProbe, near_twin}).margin_mm(0, {0, 1, 2, 3, 4});
  EXPECT_GT(alone, 5);
  EXPECT_LT(beside, 1.35) << "3 mm on one of five points: 3/√5 before the fit";
  EXPECT_GT(beside, 0.5);
}

}  // namespace
}  // namespace asterism
