// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/pose.hpp"

#include <gtest/gtest.h>

#include "asterism/tracking/scene_for_tests.hpp"

namespace asterism {
namespace {

constexpr double kSigma_px = 0.02;

RigidMotion nearby(const RigidMotion& truth) {
  Vec6 error;
  error << 0.004, -0.006, 0.003, 2, -3, 5;
  return perturbed(truth, error);
}

double nees(const PoseEstimate& estimate, const RigidMotion& truth) {
  const Vec6 error = difference(estimate.tracker_from_body, truth);
  return error.dot(*solve_positive(estimate.covariance, error));
}

/// Mean of `draws` NEES / 6 of what `estimate_from(random)` gives; its own spread is √(2/(6 draws)).
template <class Draw>
double mean_nees(int draws, Draw&& draw) {
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    RandomStream random(7, static_cast<std::uint64_t>(i));
    sum += draw(random) / 6.0;
  }
  return sum / draws;
}

class EstimatePoseThrough : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Coefficients, EstimatePoseThrough, testing::Values(0, 5));

TEST_P(EstimatePoseThrough, FindsAPoseFromPerfectViewsToANanometre) {
  const StereoRig rig = scene::rig(GetParam());
  const Body body = scene::body();
  RandomStream random(1, 0);
  for (int i = 0; i < 20; ++i) {
    const RigidMotion truth = scene::pose(random);
    const auto views = scene::views(rig, body, truth, 0.0, random);
    const auto found = estimate_pose(body, views, rig, nearby(truth), {});
    ASSERT_TRUE(found);
    const Vec6 error = difference(found->estimate.tracker_from_body, truth);
    EXPECT_LT(error.head<3>().norm(), 1e-8);
    EXPECT_LT(error.tail<3>().norm(), 1e-5);  // 600 mm of lever arm times the above
    EXPECT_LT(found->rms_px, 1e-5);
  }
}

TEST_P(EstimatePoseThrough, StatesACovarianceThatHolds) {
  const StereoRig rig = scene::rig(GetParam());
  const Body body = scene::body();
  const double mean = mean_nees(2000, [&](RandomStream& random) {
    const RigidMotion truth = scene::pose(random);
    const auto found =
        estimate_pose(body, scene::views(rig, body, truth, kSigma_px, random), rig, nearby(truth), {});
    return found ? nees(found->estimate, truth) : 1e9;
  });
  EXPECT_NEAR(mean, 1.0, 0.04);  // three of its own sigmas
}

TEST(EstimatePose, StatesACovarianceThatHoldsWithTargetsSeenByOneCamera) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  const double mean = mean_nees(1500, [&](RandomStream& random) {
    const RigidMotion truth = scene::pose(random);
    auto views = scene::views(rig, body, truth, {0, 2, 3, 5}, kSigma_px, random);
    views.push_back(scene::view(rig, body, truth, 1, Side::Left, kSigma_px, random));
    views.push_back(scene::view(rig, body, truth, 4, Side::Right, kSigma_px, random));
    const auto found = estimate_pose(body, views, rig, nearby(truth), {});
    return found ? nees(found->estimate, truth) : 1e9;
  });
  EXPECT_NEAR(mean, 1.0, 0.045);
}

TEST(EstimatePose, StatesACovarianceThatHoldsWhenTheBodyItselfIsUncertain) {
  const StereoRig rig = scene::rig();
  const Body ideal = scene::body();
  Mat3 of_target = 0.02 * 0.02 * Mat3::Identity();
  of_target(2, 2) = 0.05 * 0.05;
  double share = 0;
  const double mean = mean_nees(1500, [&](RandomStream& random) {
    const RigidMotion truth = scene::pose(random);
    Body real = ideal;
    Body believed = ideal;
    for (std::size_t i = 0; i < real.targets.size(); ++i) {
      real.targets[i].position +=
          Vec3(0.02 * random.normal(), 0.02 * random.normal(), 0.05 * random.normal());
      believed.targets[i].covariance = of_target;
    }
    const auto found =
        estimate_pose(believed, scene::views(rig, real, truth, kSigma_px, random), rig, nearby(truth), {});
    if (!found) return 1e9;
    share += found->estimate.systematic(0, 0) / found->estimate.covariance(0, 0) / 1500;
    return nees(found->estimate, truth);
  });
  EXPECT_NEAR(mean, 1.0, 0.045);
  EXPECT_NEAR(share, 0.6, 0.35);  // of the variance that averaging over frames would not remove
}

TEST(EstimatePose, StatesACovarianceThatHoldsWhenTheRigIsUncertain) {
  StereoRig believed = scene::rig();
  believed.covariance_order = rig_parameter_names(believed);
  VecX sigma(16);
  sigma << 0.3, 0.3, 1e-9, 0.4, 0.4, 0.3, 0.3, 1e-9, 0.4, 0.4, 5e-5, 5e-5, 5e-5, 0.05, 0.05, 0.05;
  believed.covariance = sigma.cwiseAbs2().asDiagonal();
  const Body body = scene::body();
  const double mean = mean_nees(1500, [&](RandomStream& random) {
    StereoRig real = believed;
    double* values[] = {&real.left.fx,  &real.left.fy,  &real.left.skew,  &real.left.cx,  &real.left.cy,
                        &real.right.fx, &real.right.fy, &real.right.skew, &real.right.cx, &real.right.cy};
    for (int i = 0; i < 10; ++i) *values[i] += sigma(i) * random.normal();
    Vec6 moved;
    for (int i = 0; i < 6; ++i) moved(i) = sigma(10 + i) * random.normal();
    real.right_from_left = perturbed(real.right_from_left, moved);
    const RigidMotion truth = scene::pose(random);
    PoseOptions options;
    options.model_error_px = 5;  // the rig's error alone reaches a pixel
    const auto found = estimate_pose(body, scene::views(real, body, truth, kSigma_px, random), believed,
                                     nearby(truth), options);
    return found ? nees(found->estimate, truth) : 1e9;
  });
  // The widening by χ² comes on top of the rig's share in the draws where the rig is far off.
  EXPECT_GT(mean, 0.75);
  EXPECT_LT(mean, 1.1);
}

TEST(EstimatePose, DoesNotDependOnWhereItStarts) {
  const StereoRig rig = scene::rig(5);
  const Body body = scene::body();
  RandomStream random(3, 0);
  const RigidMotion truth = scene::pose(random);
  const auto views = scene::views(rig, body, truth, kSigma_px, random);
  const auto near = estimate_pose(body, views, rig, truth, {});
  Vec6 far;
  far << 0.2, -0.3, 0.2, 100, -80, 200;
  const auto from_far = estimate_pose(body, views, rig, perturbed(truth, far), {});
  ASSERT_TRUE(near && from_far);
  const Vec6 apart = difference(near->estimate.tracker_from_body, from_far->estimate.tracker_from_body);
  EXPECT_LT(apart.dot(*solve_positive(near->estimate.covariance, apart)), 1e-4);
}

TEST(EstimatePose, RejectsAWrongTargetAndNamesItsViews) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  int exact = 0;
  for (int draw = 0; draw < 200; ++draw) {
    RandomStream random(4, static_cast<std::uint64_t>(draw));
    const RigidMotion truth = scene::pose(random);
    auto views = scene::views(rig, body, truth, kSigma_px, random);
    const double size_px = random.uniform(0.5, 30);
    views[4].px += size_px * Vec2(0.6, -0.8);
    views[5].px += size_px * Vec2(0.5, -0.8);
    const auto found = estimate_pose(body, views, rig, nearby(truth), {});
    ASSERT_TRUE(found) << "draw " << draw;
    exact += found->rejected == std::vector<int>{4, 5} ? 1 : 0;
    EXPECT_LT(nees(found->estimate, truth), 60) << "draw " << draw;
  }
  EXPECT_GE(exact, 195);
}

TEST(EstimatePose, KeepsTheGoodViewOfATargetWhoseOtherViewIsSpoilt) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  RandomStream random(5, 0);
  const RigidMotion truth = scene::pose(random);
  auto views = scene::views(rig, body, truth, kSigma_px, random);
  views[7].px.x() += 2.0;  // an outline half covered
  const auto found = estimate_pose(body, views, rig, nearby(truth), {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rejected, std::vector<int>{7});
}

TEST(EstimatePose, WidensTheCovarianceWhenTheSigmasAreTooSmall) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  double factor = 0;
  const double mean = mean_nees(500, [&](RandomStream& random) {
    const RigidMotion truth = scene::pose(random);
    auto views = scene::views(rig, body, truth, 0.05, random);
    for (auto& view : views) view.covariance = 0.01 * 0.01 * Mat2::Identity();
    const auto found = estimate_pose(body, views, rig, nearby(truth), {});
    if (!found) return 1e9;
    factor += found->variance_factor / 500;
    return nees(found->estimate, truth);
  });
  EXPECT_NEAR(factor, 25, 3);
  EXPECT_LT(mean, 1.5);  // six degrees of freedom over eighteen: an F ratio, of mean 18/16
  EXPECT_GT(mean, 0.9);
}

TEST(EstimatePose, RefusesWrongLabels) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  RandomStream random(6, 0);
  const RigidMotion truth = scene::pose(random);
  auto views = scene::views(rig, body, truth, kSigma_px, random);
  for (auto& view : views) view.target ^= 1;
  const auto found = estimate_pose(body, views, rig, nearby(truth), {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error(), PoseFailure::Inconsistent);
}

TEST(EstimatePose, RefusesTooFewViews) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  RandomStream random(8, 0);
  const RigidMotion truth = scene::pose(random);
  EXPECT_EQ(estimate_pose(body, {}, rig, truth, {}).error(), PoseFailure::TooFewViews);
  const auto two = scene::views(rig, body, truth, {0, 3}, kSigma_px, random);
  EXPECT_EQ(estimate_pose(body, two, rig, truth, {}).error(), PoseFailure::TooFewViews);
  std::vector<TargetView> mono;
  for (const int target : {0, 1, 3})
    mono.push_back(scene::view(rig, body, truth, target, Side::Left, kSigma_px, random));
  EXPECT_EQ(estimate_pose(body, mono, rig, truth, {}).error(), PoseFailure::TooFewViews);
}

TEST(EstimatePose, SaysThatTargetsOnALineLeaveATurnFree) {
  const StereoRig rig = scene::rig();
  Body line{"bar", {}};
  for (int i = 0; i < 4; ++i)
    line.targets.push_back({std::to_string(i), Vec3(-200 + 130 * i, 40, 600), {}, {}, {}});
  RandomStream random(9, 0);
  const RigidMotion truth = scene::pose(random);
  const auto found =
      estimate_pose(line, scene::views(rig, line, truth, kSigma_px, random), rig, nearby(truth), {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error(), PoseFailure::NotDetermined);
}

TEST(EstimatePose, RefusesAStartBehindTheCamera) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  RandomStream random(10, 0);
  const RigidMotion truth = scene::pose(random);
  RigidMotion behind = truth;
  behind.translation.z() = -2000;
  const auto views = scene::views(rig, body, truth, kSigma_px, random);
  EXPECT_EQ(estimate_pose(body, views, rig, behind, {}).error(), PoseFailure::BehindCamera);
}

TEST(EstimatePose, RefusesTargetsThatWouldFaceAway) {
  const StereoRig rig = scene::rig();
  Body body = scene::body();
  RandomStream random(11, 0);
  const RigidMotion truth = scene::pose(random);
  const auto views = scene::views(rig, body, truth, kSigma_px, random);
  for (auto& target : body.targets) target.normal = -*target.normal;
  EXPECT_EQ(estimate_pose(body, views, rig, nearby(truth), {}).error(), PoseFailure::FacesAway);
}

/// Four targets in a plane, seen by one camera from afar: the body turned over looks the same.
TEST(EstimatePose, SaysSoWhenTheBodyTurnedOverLooksTheSame) {
  StereoRig rig = scene::rig();
  Body plate{"plate", {}};
  const std::vector<Vec3> corners = {{-30, -20, 0}, {30, -25, 0}, {28, 22, 0}, {-33, 24, 0}};
  for (const Vec3& at : corners) plate.targets.push_back({std::to_string(at.x()), at, {}, {}, {}});
  const RigidMotion truth{exp_rotation({0.25, 0.1, 0}), Vec3(100, 0, 2500)};
  int ambiguous = 0;
  for (int draw = 0; draw < 20; ++draw) {
    RandomStream random(12, static_cast<std::uint64_t>(draw));
    std::vector<TargetView> views;
    for (int i = 0; i < 4; ++i) views.push_back(scene::view(rig, plate, truth, i, Side::Left, 0.1, random));
    PoseOptions options;
    options.max_sigma_deg = 30;
    options.max_sigma_mm = 100;
    const auto found = estimate_pose(plate, views, rig, truth, options);
    ASSERT_FALSE(found);
    ambiguous += found.error() == PoseFailure::Ambiguous ? 1 : 0;
  }
  EXPECT_GE(ambiguous, 18);
}

TEST(EstimatePose, BreaksAPromiseLoudlyWhenATargetHasTwoViewsInOneCamera) {
  const StereoRig rig = scene::rig();
  const Body body = scene::body();
  RandomStream random(13, 0);
  const RigidMotion truth = scene::pose(random);
  auto views = scene::views(rig, body, truth, kSigma_px, random);
  views.push_back(views.front());
  EXPECT_THROW((void)estimate_pose(body, views, rig, truth, {}), ContractViolation);
}

}  // namespace
}  // namespace asterism
