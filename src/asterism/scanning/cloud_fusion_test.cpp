// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/cloud_fusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

Mat6 diagonal(double rad, double mm) {
  Mat6 m = Mat6::Zero();
  m.diagonal() << rad * rad, rad * rad, rad * rad, mm * mm, mm * mm, mm * mm;
  return m;
}

/// Looks along −z at the plane z = 0 from `at`.
ScannerPose looking_down(const Vec3& at, double rad, double mm) {
  return {{Quaternion(0, 1, 0, 0), at}, diagonal(rad, mm), Mat6::Zero()};
}

constexpr float kSigma_mm = 0.025F;

CarriedPoint point_at(const Vec3& at, const Vec3f& normal = Vec3f::UnitZ(), float sigma_mm = kSigma_mm) {
  const float v = sigma_mm * sigma_mm;
  return {at, normal, {v, 0, 0, v, 0, v}, 300, 1, 0};
}

Vec3 normal_draw(RandomStream& random) {
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

FusedCloud fused_of(const std::vector<CarriedPoint>& points, const CloudFusionOptions& options = {}) {
  CloudFusion fusion(options);
  const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 0, 0)};
  fusion.add(1, 0, poses, points);
  return fusion.cloud();
}

TEST(CloudFusion, AveragesThePointsOfAVoxelThatFaceOneWay) {
  const FusedCloud fused = fused_of({point_at({0.2, 0.5, 0.1}), point_at({0.6, 0.5, 0.3})});
  ASSERT_EQ(fused.points.size(), 1u);
  const FusedPoint& point = fused.points[0];
  EXPECT_LT((point.at - Vec3(0.4, 0.5, 0.2)).norm(), 1e-6);  // single precision about the voxel's centre
  EXPECT_NEAR(point.covariance(2, 2), 0.025 * 0.025 / 2, 1e-9);
  EXPECT_EQ(point.points, 2u);
  EXPECT_EQ(point.scans, 1u);
  EXPECT_EQ(point.scan, 1);
  EXPECT_FLOAT_EQ(point.range_mm, 300);
}

TEST(CloudFusion, KeepsTheTwoSidesOfAThinWallApart) {
  const FusedCloud fused = fused_of({point_at({0.5, 0.5, 0.4}), point_at({0.5, 0.5, 0.6}, -Vec3f::UnitZ())});
  EXPECT_EQ(fused.points.size(), 2u);
}

TEST(CloudFusion, WeighsByTheNoiseAlongTheNormalAndStaysOnThePlane) {
  // One point noisy, one good, aside of each other on the plane z = 0.5: their mean lies on it.
  const FusedCloud fused =
      fused_of({point_at({0.2, 0.2, 0.5}), point_at({0.8, 0.8, 0.5}, Vec3f::UnitZ(), 0.1F)});
  ASSERT_EQ(fused.points.size(), 1u);
  EXPECT_NEAR(fused.points[0].at.z(), 0.5, 1e-6);
  // 16 to 1: 1/(1/v + 1/16v).
  EXPECT_NEAR(fused.points[0].covariance(2, 2), 0.025 * 0.025 * 16 / 17, 1e-9);
}

TEST(CloudFusion, StatesItsCovarianceHonestly) {
  // 2,000 draws of three scans of one place, five points each: pose noise common to a scan's points.
  constexpr int kDraws = 2000;
  double nees = 0, square = 0, predicted = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random(5, static_cast<std::uint64_t>(draw));
    const Vec3 truth(100.5, -40.5, 0.5);
    CloudFusion fusion({});
    for (int scan = 0; scan < 3; ++scan) {
      const Vec3 from(100.0 * scan, 50, 300);
      const double rad = 1e-4, mm = 0.01 * (1 + scan);
      const std::vector<ScannerPose> poses = {looking_down(from, rad, mm)};
      const Vec3 turn = rad * normal_draw(random);
      const Vec3 shift = turn.cross(truth - from) + mm * normal_draw(random);
      std::vector<CarriedPoint> points;
      for (int i = 0; i < 5; ++i) {
        points.push_back(point_at(truth + shift + kSigma_mm * normal_draw(random)));
      }
      fusion.add(scan, 0, poses, points);
    }
    const FusedCloud fused = fusion.cloud();
    ASSERT_EQ(fused.points.size(), 1u);
    const Vec3 error = fused.points[0].at - truth;
    const MatX covariance = fused.points[0].covariance;
    nees += error.dot(Vec3(*solve_positive(covariance, VecX(error)))) / kDraws;
    square += error.z() * error.z();
    predicted += covariance(2, 2);
  }
  EXPECT_NEAR(nees, 3, 0.17);  // three sigmas: 3 √(6/2000)
  EXPECT_LT(std::sqrt(square / predicted), 1.1);
  EXPECT_GT(std::sqrt(square / predicted), 0.9);
}

TEST(CloudFusion, NeverAveragesWhatIsSystematic) {
  CloudFusion fusion({});
  for (int scan = 0; scan < 5; ++scan) {
    ScannerPose pose = looking_down({0, 0, 300}, 0, 0.01);
    pose.systematic = diagonal(0, 0.02);
    const std::vector<CarriedPoint> points(100, point_at({0.5, 0.5, 0.5}));
    fusion.add(scan, 0, std::vector{pose}, points);
  }
  const FusedCloud fused = fusion.cloud();
  ASSERT_EQ(fused.points.size(), 1u);
  const double expected = 0.02 * 0.02 + (0.01 * 0.01 + 0.025 * 0.025 / 100) / 5;
  EXPECT_NEAR(fused.points[0].covariance(2, 2), expected, 1e-8);
  EXPECT_EQ(fused.points[0].scans, 5u);
}

/// Scans of one place, one of them off by 0.3 mm: which survive must not depend on who came first.
TEST(CloudFusion, RefusesTheScanThatTheOthersContradictWhoeverCameFirst) {
  for (int wrong = 0; wrong < 4; ++wrong) {
    CloudFusion fusion({});
    for (int scan = 0; scan < 4; ++scan) {
      const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 0, 0.01)};
      const std::vector<CarriedPoint> points(3, point_at({0.5, 0.5, scan == wrong ? 0.8 : 0.5}));
      fusion.add(scan, 0, poses, points);
    }
    const FusedCloud fused = fusion.cloud();
    ASSERT_EQ(fused.points.size(), 1u);
    EXPECT_NEAR(fused.points[0].at.z(), 0.5, 1e-6) << wrong;
    EXPECT_EQ(fused.outliers, 3u);
    EXPECT_EQ(fused.points[0].scans, 3u);
  }
}

TEST(CloudFusion, KeepsMoreScansThanItCanHoldApart) {
  CloudFusion fusion({});
  for (int scan = 0; scan < 40; ++scan) {
    const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 0, 0.01)};
    for (int part = 0; part < 2; ++part) {
      fusion.add(scan, part, poses, std::vector<CarriedPoint>(2, point_at({0.5, 0.5, 0.5})));
    }
  }
  const FusedCloud fused = fusion.cloud();
  ASSERT_EQ(fused.points.size(), 1u);
  EXPECT_EQ(fused.points[0].points, 160u);
  EXPECT_EQ(fused.points[0].scans, 40u);
  EXPECT_NEAR(fused.points[0].covariance(2, 2), (0.01 * 0.01 + 0.025 * 0.025 / 2) / 80, 1e-9);
}

TEST(CloudFusion, TellsWhenScansDisagreeByMoreThanTheyState) {
  const auto disagreement = [](double shift_mm) {
    CloudFusion fusion({.voxel_mm = 1, .outlier_p = 0});
    for (int scan = 0; scan < 2; ++scan) {
      const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 0, 0)};
      std::vector<CarriedPoint> points;
      RandomStream random(3, static_cast<std::uint64_t>(scan));
      for (int i = 0; i < 2000; ++i) {
        const double z = 0.5 + kSigma_mm * random.normal() + shift_mm * scan;
        points.push_back(point_at({i + 0.5, 0.5, z}));
      }
      fusion.add(scan, 0, poses, points);
    }
    return fusion.cloud().disagreement;
  };
  EXPECT_NEAR(disagreement(0), 1, 0.15);  // the median of 2,000: 3 · 1.25 · 1.1 / √2000 and a little
  EXPECT_GT(disagreement(0.2), 20);
}

TEST(CloudFusion, GrowsWithItsVoxelsNotWithItsPoints) {
  CloudFusion fusion({});
  const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 0, 0)};
  std::vector<std::size_t> bytes;
  for (int scan = 0; scan < 24; ++scan) {
    std::vector<CarriedPoint> points;
    RandomStream random(9, static_cast<std::uint64_t>(scan));
    for (int i = 0; i < 20000; ++i)
      points.push_back(point_at({random.uniform(0, 20), random.uniform(0, 20), 0.5}));
    fusion.add(scan, 0, poses, points);
    bytes.push_back(fusion.memory_bytes());
  }
  EXPECT_EQ(bytes.back(), bytes[12]);
  EXPECT_LT(bytes.back(), 2000000u);  // 400 voxels, eight parts each, and what 64 shares take at least
  const FusedCloud fused = fusion.cloud();
  EXPECT_EQ(fused.points.size(), 400u);
  EXPECT_EQ(fused.points_in, 480000u);
}

TEST(CloudFusion, GivesTheSameBitsOnAnyNumberOfThreadsAndInPieces) {
  const auto bits = [](std::size_t pieces) {
    CloudFusion fusion({});
    for (int scan = 0; scan < 3; ++scan) {
      const std::vector<ScannerPose> poses = {looking_down({0, 0, 300}, 1e-4, 0.01)};
      std::vector<CarriedPoint> points;
      RandomStream random(4, static_cast<std::uint64_t>(scan));
      for (int i = 0; i < 30000; ++i) {
        points.push_back(
            point_at({random.uniform(0, 60), random.uniform(0, 60), 0.5 + 0.02 * random.normal()}));
      }
      for (std::size_t i = 0; i < pieces; ++i) {
        const std::size_t from = i * points.size() / pieces, to = (i + 1) * points.size() / pieces;
        fusion.add(scan, 0, poses, std::span(points).subspan(from, to - from));
      }
    }
    double sum = 0;
    for (const FusedPoint& point : fusion.cloud().points) {
      sum = std::fmod(1.1 * sum + point.at.sum() + point.covariance(0, 1) + point.points, 1e6);
    }
    return sum;
  };
  set_thread_count(1);
  const double one = bits(1);
  set_thread_count(3);
  EXPECT_EQ(one, bits(1));
  EXPECT_EQ(one, bits(4));
  set_thread_count(0);
}

TEST(CloudFusion, LeavesOutVoxelsOfTooFewPoints) {
  const FusedCloud fused =
      fused_of({point_at({0.5, 0.5, 0.5}), point_at({9.5, 0.5, 0.5}), point_at({9.5, 0.5, 0.5})},
               {.voxel_mm = 1, .outlier_p = 0.001, .min_points = 2});
  EXPECT_EQ(fused.points.size(), 1u);
  EXPECT_EQ(fused.few, 1u);
}

TEST(CloudFusion, RefusesACloudThatIsTooWideForItsVoxels) {
  EXPECT_TELLS(input_error_of([] {
                 return fused_of({point_at({3e6, 0, 0})}).points_in;
               }),
               "too far for voxels of 1 mm");
}

TEST(CloudOf, TellsEachPointsFiguresAndNoNormalsWhereNoneIsKnown) {
  const Cloud with = cloud_of(fused_of({point_at({0.5, 0.5, 0.5})}));
  ASSERT_EQ(with.normals.size(), 1u);
  EXPECT_NEAR(with.field("sigma_mm")->at(0), 0.025, 1e-6);
  EXPECT_EQ(with.field("scan")->at(0), 1);
  const Cloud without = cloud_of(fused_of({point_at({0.5, 0.5, 0.5}, Vec3f::Zero())}));
  EXPECT_TRUE(without.normals.empty());
  EXPECT_TRUE(cloud_of(FusedCloud{}).points.empty());
}

}  // namespace
}  // namespace asterism
