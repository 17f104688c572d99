// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/carrying.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr double kGap_s = 0.2;

RigidMotion motion(const Vec3& omega, const Vec3& t) { return {exp_rotation(omega), t}; }

PoseRecord row(double time_s, const std::string& body, const RigidMotion& pose,
               PoseStatus status = PoseStatus::Ok) {
  PoseRecord record;
  record.frame = static_cast<int>(std::lround(100 * time_s));
  record.time_s = time_s;
  record.body = body;
  record.status = status;
  record.tracker_from_body = pose;
  record.covariance = Mat6::Identity();
  return record;
}

RigidMotion scanner_at(double t) {
  return motion({0.2 * std::sin(t), 0.1 * t, 0.3}, {100 * std::sin(2 * t), 50 * t, 1500});
}
RigidMotion platform_at(double t) { return motion({0.1, 0.05 * std::sin(t), 0.2 * t}, {10 * t, 0, 2000}); }

std::vector<PoseRecord> run(double step_s = 0.05) {
  std::vector<PoseRecord> rows;
  for (int i = 0; i <= 20; ++i) {
    rows.push_back(row(step_s * i, "scanner", scanner_at(step_s * i)));
    rows.push_back(row(step_s * i, "platform", platform_at(step_s * i)));
  }
  return rows;
}

ScanChain chain_of(const std::vector<PoseRecord>& rows) {
  ScanChain chain;
  chain.scanner = track_of(rows, "scanner");
  chain.body_from_scanner = motion({0.1, 0.2, -0.1}, {5, -20, 60});
  chain.reference = track_of(rows, "platform");
  chain.reference_from_workpiece = motion({0, 0.1, 0.4}, {0, 30, 500});
  return chain;
}

double apart_mm(const RigidMotion& a, const RigidMotion& b) {
  const Vec3 at(200, -100, 400);
  return (a * at - b * at).norm();
}

TEST(PoseAt, FollowsTheCurveBetweenFourPoses) {
  const BodyTrack track = track_of(run(), "scanner");
  const auto pose = pose_at(track, 0.512, kGap_s);
  ASSERT_TRUE(pose);
  // The cubic's remainder: |f⁗| h⁴ · 9/384 ≈ 100 · 2⁴ · 0.05⁴ / 43 = 0.2 µm.
  EXPECT_LT(apart_mm(pose->tracker_from_body, scanner_at(0.512)), 0.001);
  // Σ share² of the cubic at a quarter of the way: between 1/2 (middle) and 1 (at a pose).
  EXPECT_GT(pose->noise(0, 0), 0.5);
  EXPECT_LT(pose->noise(0, 0), 1.0);
}

TEST(PoseAt, IsTheVeryPoseWhereARowHasThatTime) {
  const std::vector<PoseRecord> rows = {row(1, "scanner", scanner_at(1)), row(5, "scanner", scanner_at(5)),
                                        row(9, "scanner", scanner_at(9))};
  const BodyTrack track = track_of(rows, "scanner");
  for (const double time_s : {1.0, 5.0, 9.0}) {
    const auto pose = pose_at(track, time_s, kGap_s);
    ASSERT_TRUE(pose) << time_s;
    EXPECT_EQ(apart_mm(pose->tracker_from_body, scanner_at(time_s)), 0);
    EXPECT_EQ(pose->noise(3, 3), 1);
  }
}

TEST(PoseAt, TakesTheLineWhereOnlyOnePoseLiesOnASide) {
  const BodyTrack track = track_of(run(), "scanner");
  const auto pose = pose_at(track, 0.025, kGap_s);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->noise(3, 3), 0.5, 1e-9);  // half of each
  // A line misses the curve by |f″| h² / 8 = 100 · 4 · 0.025 · 0.0025 / 8 and the like: 0.01 mm.
  EXPECT_LT(apart_mm(pose->tracker_from_body, scanner_at(0.025)), 0.03);
}

TEST(PoseAt, TellsWhyThereIsNone) {
  std::vector<PoseRecord> rows = run();
  EXPECT_EQ(pose_at(track_of(rows, "probe"), 0.5, kGap_s).error(), NotCarried::NoPose);
  EXPECT_EQ(pose_at(track_of(rows, "scanner"), -0.01, kGap_s).error(), NotCarried::OutsideRun);
  EXPECT_EQ(pose_at(track_of(rows, "scanner"), 1.01, kGap_s).error(), NotCarried::OutsideRun);
  for (PoseRecord& each : rows) {
    if (each.time_s > 0.42 && each.time_s < 0.68) each.status = PoseStatus::Lost;
  }
  const BodyTrack track = track_of(rows, "scanner");
  EXPECT_EQ(track.not_measured, 5u);  // 0.45 to 0.65
  EXPECT_EQ(pose_at(track, 0.5, kGap_s).error(), NotCarried::Gap);
  EXPECT_TRUE(pose_at(track, 0.5, 0.4));
}

TEST(TrackOf, TakesPredictedPosesOnlyWhenAsked) {
  std::vector<PoseRecord> rows = {row(0, "scanner", scanner_at(0), PoseStatus::Predicted)};
  EXPECT_TRUE(track_of(rows, "scanner").curve.times_s.empty());
  EXPECT_EQ(track_of(rows, "scanner", true).curve.times_s.size(), 1u);
}

TEST(ScannerPoseAt, IsTheChainOfTheCell) {
  const ScanChain chain = chain_of(run());
  const auto pose = scanner_pose_at(chain, 0.5, kGap_s);
  ASSERT_TRUE(pose);
  const RigidMotion expected = (platform_at(0.5) * chain.reference_from_workpiece).inverse() *
                               scanner_at(0.5) * chain.body_from_scanner;
  EXPECT_LT(apart_mm(pose->workpiece_from_scanner, expected), 1e-9);
}

TEST(ScannerPoseAt, DoesNotChangeWhenTheWholeCellIsMoved) {
  std::vector<PoseRecord> rows = run();
  const auto before = scanner_pose_at(chain_of(rows), 0.512, kGap_s);
  const RigidMotion elsewhere = motion({0.4, -1, 0.2}, {-300, 900, 40});
  for (PoseRecord& each : rows) each.tracker_from_body = elsewhere * *each.tracker_from_body;
  const auto after = scanner_pose_at(chain_of(rows), 0.512, kGap_s);
  ASSERT_TRUE(before && after);
  // Rotation vectors turn with the cell, so only rounding remains.
  EXPECT_LT(apart_mm(before->workpiece_from_scanner, after->workpiece_from_scanner), 1e-9);
}

TEST(ScannerPoseAt, StatesItsNoiseHonestly) {
  // 2,000 runs of poses with noise; the error of the carried pose against its stated covariance.
  Mat6 noise = Mat6::Zero();
  noise.diagonal() << 1e-8, 2e-8, 1e-8, 0.01, 0.01, 0.04;
  constexpr int kDraws = 2000;
  double nees = 0, nees_systematic = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(11, static_cast<std::uint64_t>(draw));
    const auto drawn = [&](const Mat6& covariance) {
      Vec6 error;
      for (int i = 0; i < 6; ++i) error[i] = std::sqrt(covariance(i, i)) * random.normal();
      return error;
    };
    std::vector<PoseRecord> rows = run();
    for (PoseRecord& each : rows) {
      each.covariance = noise;
      each.tracker_from_body = perturbed(*each.tracker_from_body, drawn(noise));
    }
    ScanChain chain = chain_of(rows);
    const ScanChain exact = chain_of(run());
    const auto pose = scanner_pose_at(chain, 0.512, kGap_s);
    const auto truth = scanner_pose_at(exact, 0.512, kGap_s);
    const Vec6 error = difference(pose->workpiece_from_scanner, truth->workpiece_from_scanner);
    nees += error.dot(*solve_positive(pose->noise, error)) / kDraws;

    ScanChain placed = exact;
    placed.of_body_from_scanner = placed.of_reference_from_workpiece = noise;
    placed.body_from_scanner = perturbed(placed.body_from_scanner, drawn(noise));
    placed.reference_from_workpiece = perturbed(placed.reference_from_workpiece, drawn(noise));
    const auto carried_with = scanner_pose_at(placed, 0.512, kGap_s);
    const Vec6 off = difference(carried_with->workpiece_from_scanner, truth->workpiece_from_scanner);
    nees_systematic += off.dot(*solve_positive(carried_with->systematic, off)) / kDraws;
  }
  EXPECT_NEAR(nees, 6, 0.24);  // three sigmas: 3 √(12/2000)
  EXPECT_NEAR(nees_systematic, 6, 0.24);
}

Scan line_scan() {
  Scan scan;
  scan.number = 7;
  for (int i = 0; i < 3000; ++i) {
    scan.in_scanner.push_back(
        Vec3f(static_cast<float>(i % 50), static_cast<float>(i) / 50, 300 + static_cast<float>(i % 7)));
    scan.times_s.push_back(0.2 + 0.5 * (i / 100) / 30 + 1e-6 * (i % 100));
    scan.normals.push_back(Vec3f(0, 0, -1));
  }
  return scan;
}

TEST(Carried, PutsEachPointByThePoseOfItsOwnMoment) {
  const Scan scan = line_scan();
  const CarriedScan to = carried(scan, chain_of(run()), Scanner{}, CarryOptions{});
  EXPECT_EQ(to.left_out(), 0u);
  ASSERT_EQ(to.parts.size(), 2u);  // 0.48 s, told in parts of 0.25 s
  const ScanChain chain = chain_of(run());
  std::size_t i = 0;
  double worst_mm = 0;
  for (const CarriedPart& part : to.parts) {
    for (const CarriedPoint& point : part.points) {
      const auto pose = scanner_pose_at(chain, scan.times_s[i], kGap_s);
      const Vec3 at = pose->workpiece_from_scanner * scan.in_scanner[i].cast<double>();
      worst_mm = std::max(worst_mm, (at - point.at).norm());
      ++i;
    }
  }
  EXPECT_EQ(i, scan.in_scanner.size());
  EXPECT_LT(worst_mm, 1e-5);  // the line between two moments 0.1 ms apart
}

TEST(Carried, LeavesOutWhatHasNoPoseAndCountsIt) {
  std::vector<PoseRecord> rows = run();
  for (PoseRecord& each : rows) {
    if (each.time_s > 0.42 && each.time_s < 0.68) each.status = PoseStatus::Lost;
  }
  const Scan scan = line_scan();
  const CarriedScan to = carried(scan, chain_of(rows), Scanner{}, CarryOptions{});
  EXPECT_GT(to.gap, 0u);
  std::size_t kept = 0;
  for (const CarriedPart& part : to.parts) kept += part.points.size();
  EXPECT_EQ(kept + to.left_out(), scan.in_scanner.size());
  EXPECT_EQ(to.outside_run + to.no_pose, 0u);
}

TEST(Carried, GivesEachPointTheScannersNoiseAlongItsAxes) {
  Scan scan;
  scan.time_s = 0.5;
  scan.in_scanner = {Vec3f(0, 0, 300)};
  scan.normals = {Vec3f(0, 0, -1)};
  const CarriedScan to = carried(scan, chain_of(run()), Scanner{}, CarryOptions{});
  const CarriedPoint& point = to.parts.at(0).points.at(0);
  const auto& c = point.scanner_mm2;
  EXPECT_NEAR(c[0] + c[3] + c[5], 2 * 0.012 * 0.012 + 0.025 * 0.025, 1e-9);
  EXPECT_FLOAT_EQ(point.cos_incidence, 1);
  EXPECT_FLOAT_EQ(point.range_mm, 300);
}

TEST(Carried, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto bits = [] {
    const CarriedScan to = carried(line_scan(), chain_of(run()), Scanner{}, CarryOptions{});
    double sum = 0;
    for (const CarriedPart& part : to.parts) {
      for (const CarriedPoint& point : part.points) sum = 1.1 * sum + point.at.sum() + point.scanner_mm2[1];
      sum = std::fmod(sum, 1e6);
    }
    return sum;
  };
  set_thread_count(1);
  const double one = bits();
  set_thread_count(3);
  EXPECT_EQ(one, bits());
  set_thread_count(0);
}

}  // namespace
}  // namespace asterism
