// SPDX-License-Identifier: Apache-2.0
// What it costs to look at one layout of targets over a motion: who sees what, and how accurate the pose is,
// also after any one or two losses. On one core.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "asterism/accuracy/motion_accuracy.hpp"
#include "asterism/accuracy/pose_accuracy.hpp"
#include "asterism/visibility/scene_for_tests.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

constexpr int kPoses = 200;

/// Targets on a ring of two heights.
std::vector<Target> ring(int count) {
  scene::Layout layout;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.1 * (i % 3)) / count;
    layout.push_back({300 * std::cos(angle), 300 * std::sin(angle), 590.0 + 20 * (i % 2)});
  }
  return scene::targets_of(layout);
}

std::string micro(double seconds) { return fmt::format("{:.1f}", 1e6 * seconds); }

}  // namespace

int main() {
  bench::Table table(
      "one layout over 200 poses, 2 cameras; microseconds, one core",
      {"targets", "lens", "points", "visibility", "nominal", "any 1 lost", "any 2 lost", "pose by pose"});
  const std::vector<Vec3> eight = {{520, 0, 560},   {0, 520, 560},    {-520, 0, 560},    {0, -520, 560},
                                   {344, 344, 280}, {-344, 344, 280}, {-344, -344, 280}, {344, -344, 280}};
  for (const bool distorted : {false, true}) {
    StereoRig rig = scene::rig();
    rig.left.coefficients = rig.right.coefficients = distorted ? 5 : 0;
    const std::vector<RigidMotion> poses = scene::motion(rig, kPoses);
    const SeenMotion motion = seen_motion(poses, rig);
    for (const int count : {4, 6, 8, 12, 24}) {
      const std::vector<Target> targets = ring(count);
      const MotionVisibility visibility = visible_targets(targets, motion, WorkingVolume{}, {});
      for (const std::size_t points : {1U, 8U}) {
        std::vector<std::string> row = {fmt::format("{}", count), distorted ? "5 coefficients" : "pinhole",
                                        fmt::format("{}", points)};
        row.push_back(micro(bench::median_seconds(
            [&] { static_cast<void>(visible_targets(targets, motion, WorkingVolume{}, {})); })));
        for (int losses = 0; losses <= 2; ++losses) {
          AccuracyOptions options;
          options.losses = losses;
          row.push_back(micro(bench::median_seconds([&] {
            static_cast<void>(predict_accuracy(targets, motion, visibility, {eight.data(), points}, options));
          })));
        }
        row.push_back(micro(bench::median_seconds(
            [&] {
              for (std::size_t pose = 0; pose < poses.size(); ++pose) {
                const auto one = predict_pose_accuracy(targets, visibility.seen[pose], poses[pose], rig, {});
                if (!one) continue;
                for (std::size_t i = 0; i < points; ++i) {
                  static_cast<void>(error_at_point_mm(poses[pose], one->covariance, eight[i]));
                }
              }
            },
            5)));
        table.row(row);
      }
    }
  }
  table.print_json();
}
