// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_poses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "asterism/core/result.hpp"
#include "asterism/io/pose_table.hpp"

namespace asterism {
namespace {

std::filesystem::path poses_file(const std::filesystem::path& folder, const std::filesystem::path& told) {
  if (!told.empty()) return std::filesystem::is_directory(told) ? told / "poses.csv" : told;
  for (const auto& file : {folder / "track" / "poses.csv", folder / "poses.csv"}) {
    if (std::filesystem::is_regular_file(file)) return file;
  }
  throw InputError(
      folder.string(),
      "there are no poses: neither track/poses.csv nor poses.csv is there. `asterism track` makes them "
      "from a recording; --poses names a file elsewhere");
}

std::set<std::string> bodies_in(const std::vector<PoseRecord>& records) {
  std::set<std::string> bodies;
  for (const PoseRecord& record : records) bodies.insert(record.body);
  return bodies;
}

/// A body in several rows that all have one time: then times were not told.
bool tells_no_times(const std::vector<PoseRecord>& records) {
  std::map<std::string, std::pair<int, std::set<double>>> of_body;
  for (const PoseRecord& record : records) {
    auto& [rows, times] = of_body[record.body];
    ++rows;
    times.insert(record.time_s);
  }
  return std::any_of(of_body.begin(), of_body.end(), [](const auto& body) {
    return body.second.first > 1 && body.second.second.size() == 1;
  });
}

void match_by_number(ScanPoses& poses, std::vector<ScanEntry>& scans) {
  poses.by_number = true;
  poses.remarks.emplace_back("the poses tell no times: the pose of frame n is taken for scan n");
  for (PoseRecord& record : poses.records) record.time_s = record.frame;
  for (ScanEntry& scan : scans) scan.time_s = scan.scan;
}

void take_the_only_body(ScanPoses& poses, const std::set<std::string>& bodies,
                        std::vector<ScanEntry>& scans) {
  std::set<std::string> carriers = bodies;
  carriers.erase(poses.reference);
  const bool known = std::any_of(scans.begin(), scans.end(),
                                 [&](const ScanEntry& scan) { return bodies.contains(scan.body); });
  if (known || carriers.size() != 1 || scans.empty()) return;
  poses.remarks.push_back(
      fmt::format("no pose tells of body `{}`, which scans.csv names; `{}` is taken for it",
                  scans.front().body, *carriers.begin()));
  for (ScanEntry& scan : scans) scan.body = *carriers.begin();
}

}  // namespace

ScanPoses poses_of_scans(const std::filesystem::path& folder, const ScanPosesWanted& wanted,
                         std::vector<ScanEntry>& scans) {
  ScanPoses poses;
  poses.file = poses_file(folder, wanted.poses);
  poses.records = read_poses(poses.file);
  const std::filesystem::path covariances = poses.file.parent_path() / "poses.json";
  if (std::filesystem::is_regular_file(covariances)) {
    read_pose_covariances(covariances, poses.records);
    poses.full_covariance = true;
  }
  for (PoseRecord& record : poses.records) {
    if (record.tracker_from_body) record.tracker_from_body->translation *= wanted.mm_each;
  }
  const std::set<std::string> bodies = bodies_in(poses.records);
  if (!wanted.reference.empty() && !bodies.contains(wanted.reference)) {
    throw InputError(poses.file.string(),
                     fmt::format("there is no pose of the reference body `{}`; there are: {}",
                                 wanted.reference, fmt::join(bodies, ", ")));
  }
  const std::string platform = wanted.platform.empty() ? "platform" : wanted.platform;
  if (!wanted.reference.empty()) {
    poses.reference = wanted.reference;
  } else if (bodies.contains(platform)) {
    poses.reference = platform;
  }
  if (tells_no_times(poses.records)) match_by_number(poses, scans);
  take_the_only_body(poses, bodies, scans);
  return poses;
}

}  // namespace asterism
