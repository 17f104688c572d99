// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/tracker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "asterism/core/parallel.hpp"
#include "asterism/tracking/scene_for_tests.hpp"

namespace asterism {
namespace {

constexpr double kSigma_px = 0.01;

/// Says which targets a camera sees.
using Sees = std::function<bool(int target, Side side)>;
bool all(int, Side) { return true; }

/// The centres of one body, in the order left 0, 1, …, right 0, 1, ….
void add_centres(StereoCentres& centres, const StereoRig& rig, const Body& body, const RigidMotion& at,
                 const Sees& sees, RandomStream& random) {
  for (int target = 0; target < static_cast<int>(body.targets.size()); ++target) {
    for (const Side side : {Side::Left, Side::Right}) {
      if (!sees(target, side)) continue;
      auto& list = side == Side::Left ? centres.left : centres.right;
      list.push_back(scene::centre(scene::image_of(rig, body, at, target, side), kSigma_px, random));
    }
  }
}

void add_clutter(StereoCentres& centres, int count, RandomStream& random) {
  for (auto* list : {&centres.left, &centres.right}) {
    for (int i = 0; i < count; ++i) {
      Ellipse image;
      image.centre = {random.uniform(0, 2048), random.uniform(0, 1536)};
      image.semi_major = image.semi_minor = 6;
      list->push_back(scene::centre(image, kSigma_px, random));
    }
  }
}

/// A slow sweep of the platform at 50 Hz.
RigidMotion sweep(int frame) {
  RandomStream same(81, 0);
  const RigidMotion start = scene::pose(same, 0);
  const double t = 0.02 * frame;
  return rotation_about(start * Vec3(0, 0, 300),
                        exp_rotation({0.1 * std::sin(t), 0.2 * std::sin(0.7 * t), 0.1 * t})) *
         start;
}

void expect_near(const PoseEstimate& estimate, const RigidMotion& truth) {
  const Vec6 error = difference(estimate.tracker_from_body, truth);
  EXPECT_LT(error.dot(*solve_positive(estimate.covariance, error)), 40);  // χ² with six degrees: 1 in 2·10⁶
  EXPECT_LT(deg_from_rad(error.head<3>().norm()), 0.1);
}

TEST(Tracker, FindsABodyAmongClutterWithAnHonestPose) {
  const StereoRig rig = scene::rig(5);
  Tracker tracker(rig, {scene::body()});
  for (int frame = 0; frame < 20; ++frame) {
    RandomStream random(82, static_cast<std::uint64_t>(frame));
    StereoCentres centres{frame, 0.02 * frame, {}, {}};
    add_centres(centres, rig, scene::body(), sweep(frame), all, random);
    add_clutter(centres, 40, random);
    const TrackedFrame tracked = tracker.process(centres);
    ASSERT_EQ(tracked.poses.size(), 1u);
    EXPECT_EQ(tracked.poses[0].status, PoseStatus::Ok);
    EXPECT_EQ(tracked.poses[0].targets, 6);
    expect_near(*tracked.poses[0].estimate, sweep(frame));
    EXPECT_EQ(tracked.filtered[0].status, PoseStatus::Ok);
  }
}

TEST(Tracker, UsesTargetsThatOneCameraAloneSees) {
  const StereoRig rig = scene::rig();
  Tracker tracker(rig, {scene::body()});
  RandomStream random(83, 0);
  StereoCentres centres{0, 0, {}, {}};
  const auto sees = [](int target, Side side) { return target < 4 || (target == 4) == (side == Side::Left); };
  add_centres(centres, rig, scene::body(), sweep(0), sees, random);
  const TrackedFrame tracked = tracker.process(centres);
  EXPECT_EQ(tracked.poses[0].status, PoseStatus::Ok);
  EXPECT_EQ(tracked.poses[0].targets, 6);
  expect_near(*tracked.poses[0].estimate, sweep(0));
}

TEST(Tracker, CarriesOnWithFewTargetsAsPartialThenPredictedThenLost) {
  const StereoRig rig = scene::rig();
  Tracker tracker(rig, {scene::body()});
  const auto frame_with = [&](int frame, const Sees& sees) {
    RandomStream random(84, static_cast<std::uint64_t>(frame));
    StereoCentres centres{frame, 0.02 * frame, {}, {}};
    add_centres(centres, rig, scene::body(), sweep(frame), sees, random);
    return tracker.process(centres);
  };
  for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(frame_with(frame, all).poses[0].status, PoseStatus::Ok);
  // Two seen by both, two by the left, one by the right.
  const auto few = [](int target, Side side) {
    return target < 2 || (target < 4 && side == Side::Left) || (target == 4 && side == Side::Right);
  };
  const TrackedFrame partial = frame_with(10, few);
  ASSERT_EQ(partial.poses[0].status, PoseStatus::Partial);
  EXPECT_EQ(partial.poses[0].targets, 5);
  expect_near(*partial.poses[0].estimate, sweep(10));

  const TrackedFrame predicted = frame_with(11, [](int target, Side) { return target == 0; });
  EXPECT_EQ(predicted.poses[0].status, PoseStatus::Lost);
  EXPECT_FALSE(predicted.poses[0].estimate);
  EXPECT_EQ(predicted.filtered[0].status, PoseStatus::Predicted);
  const TrackedFrame lost = frame_with(60, [](int, Side) { return false; });
  EXPECT_EQ(lost.filtered[0].status, PoseStatus::Lost);
  EXPECT_FALSE(lost.filtered[0].estimate);
}

TEST(Tracker, LivesThroughACameraThatLostFrames) {
  const StereoRig rig = scene::rig();
  Tracker tracker(rig, {scene::body()});
  int partial = 0;
  for (int frame = 0; frame < 40; ++frame) {
    RandomStream random(85, static_cast<std::uint64_t>(frame));
    StereoCentres centres{frame, 0.02 * frame, {}, {}};
    const bool lost = frame >= 20 && frame < 24;
    add_centres(
        centres, rig, scene::body(), sweep(frame),
        [&](int, Side side) { return !lost || side == Side::Left; }, random);
    const BodyPose pose = tracker.process(centres).poses[0];
    EXPECT_EQ(pose.status == PoseStatus::Ok, !lost);
    if (pose.estimate) expect_near(*pose.estimate, sweep(frame));
    partial += pose.status == PoseStatus::Partial ? 1 : 0;
  }
  EXPECT_EQ(partial, 4);
}

TEST(Tracker, TrustsFewTargetsOnlyWhenTheyFitAsWellAsUsual) {
  const StereoRig rig = scene::rig();
  for (const double wrong_px : {0.0, 0.25}) {
    Tracker tracker(rig, {scene::body()});
    for (int frame = 0; frame <= 10; ++frame) {
      RandomStream random(91, static_cast<std::uint64_t>(frame));
      StereoCentres centres{frame, 0.02 * frame, {}, {}};
      const bool few = frame == 10;
      add_centres(
          centres, rig, scene::body(), sweep(frame), [&](int target, Side) { return !few || target < 3; },
          random);
      if (few) centres.left[1].ellipse.centre.x() += wrong_px;
      const BodyPose pose = tracker.process(centres).poses[0];
      if (few) {
        EXPECT_EQ(pose.status == PoseStatus::Partial, wrong_px == 0.0) << wrong_px;
      }
    }
  }
}

TEST(Tracker, NamesTheTargetThatWasSeenAndDidNotFit) {
  const StereoRig rig = scene::rig();
  for (const double mm : {0.0, 0.4, 1.0, 5.0}) {
    Body there = scene::body();
    there.targets[3].position += mm * Vec3(0.48, 0.6, -0.64);
    Tracker tracker(rig, {scene::body()});
    for (int frame = 0; frame < 10; ++frame) {
      RandomStream random(93, static_cast<std::uint64_t>(frame));
      StereoCentres centres{frame, 0.02 * frame, {}, {}};
      add_centres(centres, rig, there, sweep(frame), all, random);
      add_clutter(centres, 20, random);
      const TrackedFrame tracked = tracker.process(centres);
      ASSERT_EQ(tracked.poses[0].status, PoseStatus::Ok) << mm;
      expect_near(*tracked.poses[0].estimate, sweep(frame));
      const std::vector<int> expected = mm == 0 ? std::vector<int>{} : std::vector<int>{3};
      EXPECT_EQ(tracked.poses[0].rejected, expected) << mm << " mm, frame " << frame;
      EXPECT_EQ(tracked.filtered[0].rejected, expected);
    }
  }
}

TEST(Tracker, TellsTwoBodiesApart) {
  const StereoRig rig = scene::rig();
  Body scanner{"scanner", {}};
  const std::vector<Vec3> at = {{0, 0, 0}, {90, 10, 5}, {-70, 60, 10}, {20, -110, 15}, {60, 85, -20}};
  for (const Vec3& p : at) scanner.targets.push_back({std::to_string(p.x()), p, Vec3(0, 0, 1), 8.0, {}});
  Tracker tracker(rig, {scene::body(), scanner});
  RandomStream random(86, 0);
  RigidMotion in_front{exp_rotation({std::numbers::pi - 0.2, 0.1, 0}), Vec3(420, 60, 1800)};
  StereoCentres centres{0, 0, {}, {}};
  add_centres(
      centres, rig, scene::body(), sweep(0), [](int target, Side) { return target != 2; }, random);
  add_centres(centres, rig, scanner, in_front, all, random);
  const TrackedFrame tracked = tracker.process(centres);
  ASSERT_EQ(tracked.poses.size(), 2u);
  EXPECT_EQ(tracked.poses[0].status, PoseStatus::Ok);
  EXPECT_EQ(tracked.poses[1].status, PoseStatus::Ok);
  expect_near(*tracked.poses[0].estimate, sweep(0));
  expect_near(*tracked.poses[1].estimate, in_front);
}

TEST(Tracker, SaysAmbiguousRatherThanGuessWhenTheBodyFitsTurnedRound) {
  const StereoRig rig = scene::rig();
  Body square{"square", {}};
  for (const Vec3& p : {Vec3(100, 80, 0), Vec3(-100, 80, 0), Vec3(-100, -80, 0), Vec3(100, -80, 0)}) {
    square.targets.push_back({std::to_string(p.x()) + std::to_string(p.y()), p, Vec3(0, 0, 1), 8.0, {}});
  }
  Tracker tracker(rig, {square});
  RandomStream random(87, 0);
  StereoCentres centres{0, 0, {}, {}};
  add_centres(centres, rig, square, {exp_rotation({std::numbers::pi, 0, 0}), Vec3(350, 0, 2200)}, all,
              random);
  const TrackedFrame tracked = tracker.process(centres);
  EXPECT_EQ(tracked.poses[0].status, PoseStatus::Ambiguous);
  EXPECT_FALSE(tracked.poses[0].estimate);
}

TEST(Tracker, OfNothingOrOfTenThousandBlobsSaysLostInShortTime) {
  const StereoRig rig = scene::rig();
  Tracker tracker(rig, {scene::body()});
  EXPECT_EQ(tracker.process(StereoCentres{0, 0, {}, {}}).poses[0].status, PoseStatus::Lost);
  RandomStream random(88, 0);
  StereoCentres centres{1, 1, {}, {}};
  add_clutter(centres, 10000, random);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(tracker.process(centres).poses[0].status, PoseStatus::Lost);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2.0);
}

TEST(Tracker, NeverCallsAWrongPoseOkUnderHeavyOcclusionAndClutter) {
  const StereoRig rig = scene::rig();
  int ok = 0;
  for (int draw = 0; draw < 300; ++draw) {
    RandomStream random(89, static_cast<std::uint64_t>(draw));
    Tracker tracker(rig, {scene::body()});
    const RigidMotion truth = scene::pose(random);
    bool hidden[2][6];
    for (auto& side : hidden) {
      for (bool& target : side) target = random.uniform() < 0.4;
    }
    StereoCentres centres{0, 0, {}, {}};
    add_centres(
        centres, rig, scene::body(), truth,
        [&](int target, Side side) { return !hidden[static_cast<int>(side)][target]; }, random);
    add_clutter(centres, 60, random);
    const BodyPose pose = tracker.process(centres).poses[0];
    if (!pose.estimate) continue;
    ++ok;
    expect_near(*pose.estimate, truth);
  }
  EXPECT_GT(ok, 30);
}

void paint(Raster8& image, const Ellipse& disc) {
  const Mat2 inverse = shape_matrix(disc).inverse();
  const int reach = static_cast<int>(disc.semi_major) + 3;
  const int x0 = static_cast<int>(disc.centre.x()), y0 = static_cast<int>(disc.centre.y());
  constexpr int kSub = 8;
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      if (!image.contains(x, y)) continue;
      int inside = 0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Vec2 p =
            Vec2(x + (k % kSub + 0.5) / kSub - 0.5, y + (k / kSub + 0.5) / kSub - 0.5) - disc.centre;
        inside += p.dot(inverse * p) <= 1 ? 1 : 0;
      }
      image.row(y)[x] = static_cast<std::uint8_t>(20 + 180 * inside / (kSub * kSub));
    }
  }
}

StereoImage painted(int frame, const StereoRig& rig, const Body& body, const RigidMotion& at) {
  StereoImage stereo{frame, 0.02 * frame, {}, {}};
  for (const Side side : {Side::Left, Side::Right}) {
    Raster8 image(2048, 1536);
    RandomStream random(90, static_cast<std::uint64_t>(2 * frame + static_cast<int>(side)));
    for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(18 + random.below(5));
    for (int target = 0; target < static_cast<int>(body.targets.size()); ++target) {
      paint(image, scene::image_of(rig, body, at, target, side));
    }
    (side == Side::Left ? stereo.left : stereo.right) = std::move(image);
  }
  return stereo;
}

TEST(Tracker, GivesTheSamePosesFromWindowsAsFromWholeImages) {
  const StereoRig rig = scene::rig(5);
  TrackerOptions whole;
  whole.full_search_interval = 1;
  Tracker by_windows(rig, {scene::body()}), by_image(rig, {scene::body()}, whole);
  for (int frame = 0; frame < 6; ++frame) {
    const StereoImage image = painted(frame, rig, scene::body(), sweep(frame));
    const BodyPose one = by_windows.process(image).poses[0], other = by_image.process(image).poses[0];
    ASSERT_EQ(one.status, PoseStatus::Ok);
    ASSERT_EQ(other.status, PoseStatus::Ok);
    EXPECT_EQ(one.targets, 6);
    const Vec6 apart = difference(one.estimate->tracker_from_body, other.estimate->tracker_from_body);
    EXPECT_LT(apart.head<3>().norm(), 1e-5) << "frame " << frame;
    EXPECT_LT((difference(one.estimate->tracker_from_body, sweep(frame)).head<3>().norm()), 1e-4);
  }
}

TEST(Tracker, FindsABodyThatJumpedOutOfItsWindows) {
  const StereoRig rig = scene::rig();
  Tracker tracker(rig, {scene::body()});
  for (int frame = 0; frame < 5; ++frame) {
    RigidMotion at = sweep(frame);
    if (frame == 4) at.translation += Vec3(120, -80, 60);
    const BodyPose pose = tracker.process(painted(frame, rig, scene::body(), at)).poses[0];
    EXPECT_EQ(pose.status, PoseStatus::Ok) << "frame " << frame;
  }
}

TEST(Tracker, GivesTheSameBitsOnAnyNumberOfThreads) {
  const StereoRig rig = scene::rig();
  std::vector<RigidMotion> found;
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    Tracker tracker(rig, {scene::body()});
    found.push_back(tracker.process(painted(0, rig, scene::body(), sweep(0)))
                        .poses[0]
                        .estimate.value()
                        .tracker_from_body);
  }
  set_thread_count(0);
  EXPECT_EQ(found[0].translation, found[1].translation);
  EXPECT_EQ(found[0].rotation.coeffs(), found[1].rotation.coeffs());
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Tracker, NamesTheFrameOfAWrongImageSizeOrATimeThatGoesBack) {
  Tracker tracker(scene::rig(), {scene::body()});
  StereoImage small{7, 0.5, Image(Raster8(640, 480)), {}};
  EXPECT_EQ(message_of([&] { (void)tracker.process(small); }),
            "frame 7: the left image is 640 × 480, the rig's is 2048 × 1536");
  (void)tracker.process(StereoCentres{3, 0.4, {}, {}});
  EXPECT_EQ(message_of([&] {
              (void)tracker.process(StereoCentres{4, 0.3, {}, {}});
            }),
            "frame 4: its time 0.3 s is before that of frame 3 (0.4 s); frames must come in order of time");
  EXPECT_EQ(message_of([&] {
              (void)tracker.process(StereoCentres{5, std::nan(""), {}, {}});
            }),
            "frame 5: its time is not a finite number");
}

TEST(Tracker, RefusesARigWithANumberThatIsNone) {
  StereoRig rig = scene::rig();
  rig.left.fx = std::nan("");
  EXPECT_NE(message_of([&] { Tracker tracker(rig, {scene::body()}); }), "nothing was thrown");
}

}  // namespace
}  // namespace asterism
