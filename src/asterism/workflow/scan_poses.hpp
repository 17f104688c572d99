// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/io/scan_folder.hpp"
#include "asterism/measurement/pose_record.hpp"

namespace asterism {

/// The poses that go with a folder of scans, and what was made of them.
struct ScanPoses {
  std::filesystem::path file;
  std::vector<PoseRecord> records;
  std::string reference;         // the body that carries the part; empty: none is known
  bool full_covariance = false;  // poses.json was there
  bool by_number = false;        // the pose of frame n is that of scan n: no times were told
  std::vector<std::string> remarks;
};

/// What the user says of them.
struct ScanPosesWanted {
  std::filesystem::path poses;  // empty: poses.csv in the folder's track/, or in the folder
  std::string reference;        // empty: `platform`
  std::string platform;         // as the cell calls it; empty: "platform"
  double mm_each = 1;           // how many mm the unit of the poses' lengths is
};

/// Reads them, and poses.json beside them where it is there. Where neither poses nor scans tell a time, frame
/// numbers stand for scan numbers; a scan whose body has no pose takes the only body that has. Both are said,
/// and put into `scans`. Throws InputError when there is no file of poses, or the reference is not in it.
[[nodiscard]] ScanPoses poses_of_scans(const std::filesystem::path& folder, const ScanPosesWanted& wanted,
                                       std::vector<ScanEntry>& scans);

}  // namespace asterism
