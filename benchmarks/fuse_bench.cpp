// SPDX-License-Identifier: Apache-2.0
// How many points a second are carried and fused, and how that compares with Open3D's voxel_down_sample of
// the same points in the same run (where libopen3d is found).
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/scanning/carrying.hpp"
#include "bench.hpp"

#ifdef ASTERISM_WITH_OPEN3D
#include <open3d/geometry/PointCloud.h>
#endif

namespace {

using namespace asterism;

double seconds_of(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A curved patch of 350 × 310 mm at 300 mm, line by line, with normals and times.
Scan patch(int number, int lines, int points_a_line) {
  Scan scan;
  scan.number = number;
  RandomStream random(1, static_cast<std::uint64_t>(number));
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < points_a_line; ++i) {
      const double x = -175 + 350.0 * line / lines, y = -155 + 310.0 * i / points_a_line;
      const double z = 300 + 20 * std::sin(x / 60) + 0.025 * random.normal();
      scan.in_scanner.emplace_back(Vec3(x, y, z).cast<float>());
      scan.normals.emplace_back(Vec3(std::cos(x / 60) / 3, 0, -1).normalized().cast<float>());
      scan.times_s.push_back(number + 0.1 + 0.5 * line / lines);
    }
  }
  return scan;
}

ScanChain chain_of(int scans) {
  std::vector<PoseRecord> rows;
  for (int i = 0; i <= 20 * (scans + 1); ++i) {
    const double t = 0.05 * i;
    for (const char* body : {"scanner", "platform"}) {
      PoseRecord row;
      row.frame = i;
      row.time_s = t;
      row.body = body;
      row.tracker_from_body = RigidMotion{exp_rotation({0.1, 0.002 * t, 0}), {40 * t, 5 * t, 2000}};
      row.covariance = 1e-4 * Mat6::Identity();
      rows.push_back(row);
    }
  }
  ScanChain chain;
  chain.scanner = track_of(rows, "scanner");
  chain.body_from_scanner = {exp_rotation({0, 0.3, 0}), {0, 0, 50}};
  chain.reference = track_of(rows, "platform");
  return chain;
}

}  // namespace

int main() {
  constexpr int kScans = 10, kLines = 1000, kPoints = 500;
  const ScanChain chain = chain_of(kScans);
  std::vector<Scan> scans;
  for (int i = 0; i < kScans; ++i) scans.push_back(patch(i, kLines, kPoints));
  const double points = static_cast<double>(kScans) * kLines * kPoints;
  std::vector<CarriedScan> carried_scans(scans.size());
  FusedCloud fused;
  double carry_s = 1e9, fuse_s = 1e9, peer_s = 1e9;
  std::size_t peer_points = 0, bytes = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    carry_s = std::min(carry_s, seconds_of([&] {
                         for (std::size_t i = 0; i < scans.size(); ++i) {
                           carried_scans[i] = carried(scans[i], chain, Scanner{}, CarryOptions{});
                         }
                       }));
    fuse_s = std::min(fuse_s, seconds_of([&] {
                        CloudFusion fusion({});
                        for (const CarriedScan& scan : carried_scans) {
                          int part = 0;
                          for (const CarriedPart& each : scan.parts)
                            fusion.add(scan.scan, part++, scan.poses, each.points);
                        }
                        fused = fusion.cloud();
                        bytes = fusion.memory_bytes();
                      }));
#ifdef ASTERISM_WITH_OPEN3D
    open3d::geometry::PointCloud cloud;
    for (const CarriedScan& scan : carried_scans) {
      for (const CarriedPart& part : scan.parts) {
        for (const CarriedPoint& point : part.points) {
          cloud.points_.push_back(point.at);
          cloud.normals_.push_back(point.normal.cast<double>());
        }
      }
    }
    peer_s = std::min(peer_s, seconds_of([&] { peer_points = cloud.VoxelDownSample(1)->points_.size(); }));
#endif
  }
  bench::Table table("fusing scans: 5 million points, voxels of 1 mm",
                     {"step", "million points/s", "points out"});
  const auto rate = [&](double seconds) { return fmt::format("{:.2f}", points / seconds / 1e6); };
  table.row({"carry", rate(carry_s), fmt::format("{:.0f}", points)});
  table.row({"fuse", rate(fuse_s), fmt::format("{}", fused.points.size())});
  table.row({"carry and fuse", rate(carry_s + fuse_s), fmt::format("{}", fused.points.size())});
  if (peer_points > 0) {
    table.row({"Open3D voxel_down_sample", rate(peer_s), fmt::format("{}", peer_points)});
    table.row({"fuse, of Open3D's time", fmt::format("{:.2f}", fuse_s / peer_s), ""});
  }
  table.row({"memory of the fusion, MB", fmt::format("{:.0f}", static_cast<double>(bytes) / 1e6), ""});
  table.print_json();
}
