// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asterism/cell/body.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/measurement/pose_record.hpp"

namespace asterism {

/// A poses CSV, measured (with status and sigmas) or true (columns up to `qz`). Needed are frame, body,
/// x_mm … qz; empty pose cells stand for no pose. Quaternions are made unit length; one that is off by
/// more than 0.001 is refused.
[[nodiscard]] std::vector<PoseRecord> read_poses(const std::filesystem::path& file);

/// The lines of poses.json put their full covariances into the records of the same frame and body.
void read_pose_covariances(const std::filesystem::path& file, std::vector<PoseRecord>& poses);

[[nodiscard]] PoseRecord record_of(int frame, double time_s, const BodyPose& pose,
                                   const std::vector<Body>& bodies);

/// Writes rows as they come; the file is whole after finish.
class PoseTable {
 public:
  explicit PoseTable(const std::filesystem::path& file);
  void write(const PoseRecord& pose);
  void flush() { file_.flush(); }
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

/// One JSON object a line, with the full 6×6 covariance (ω rad, δ mm) and the systematic share of it.
[[nodiscard]] std::string json_line(const PoseRecord& pose);

/// TUM trajectory lines "time x y z qx qy qz qw" (seconds, metres) of one body.
void write_tum(const std::filesystem::path& file, const std::vector<PoseRecord>& poses,
               const std::string& body);

}  // namespace asterism
