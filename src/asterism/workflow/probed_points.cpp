// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/probed_points.hpp"

#include <fmt/format.h>

#include "asterism/core/result.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

/// From the tracker's frame to the platform's at that moment.
void carry(const KnownMotion& tracker_from_platform, ProbedPoint& point) {
  const RigidMotion& motion = tracker_from_platform.motion;
  point.in_platform = motion.inverse() * point.in_platform;
  const Mat3 of_pose = covariance_of_point(motion, tracker_from_platform.covariance, point.in_platform);
  const Mat3 back = motion.rotation.conjugate().toRotationMatrix();
  point.covariance = back * (point.covariance + of_pose) * back.transpose();
}

}  // namespace

std::vector<ProbedPoint> read_probed(const ProbedFile& file) {
  std::vector<std::string> columns = {"x_mm", "y_mm", "z_mm"};
  std::map<int, KnownMotion> platform;
  if (!file.poses.empty()) {
    columns.emplace_back("frame");
    platform = poses_by_frame(read_poses(file.poses), file.platform, file.stated, file.poses);
  }
  const CsvTable table(file.points, columns);
  std::vector<ProbedPoint> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double sigma = table.optional_number(row, "sigma_mm").value_or(file.sigma_mm);
    if (!(sigma > 0)) table.refuse(row, "sigma_mm", "must be positive");
    const Vec3 at(table.number(row, "x_mm"), table.number(row, "y_mm"), table.number(row, "z_mm"));
    ProbedPoint point{table.text(row, "name"), at, sigma * sigma * Mat3::Identity()};
    if (!file.poses.empty()) {
      const auto pose = platform.find(static_cast<int>(table.number(row, "frame")));
      if (pose == platform.end())
        table.refuse(row, "frame",
                     fmt::format("`{}` was not measured in it, by {}", file.platform, file.poses.string()));
      carry(pose->second, point);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace asterism
