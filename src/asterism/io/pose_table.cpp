// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/pose_table.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "asterism/core/result.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/pose_columns.hpp"

namespace asterism {
namespace {

Mat6 matrix_of(const nlohmann::json& rows) {
  Mat6 matrix;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows.at(i).at(j).get<double>();
    }
  }
  return matrix;
}

nlohmann::ordered_json rows_of(const Mat6& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vec6 row = matrix.row(i);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

}  // namespace

std::vector<PoseRecord> read_poses(const std::filesystem::path& file) {
  const CsvTable table(file, {"frame", "body", "x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"});
  std::vector<PoseRecord> poses(table.rows());
  std::map<std::pair<int, std::string>, std::size_t> seen;
  for (std::size_t row = 0; row < poses.size(); ++row) {
    PoseRecord& pose = poses[row];
    pose.frame = table.integer(row, "frame");
    pose.time_s = table.optional_number(row, "time_s").value_or(0);
    pose.body = table.text(row, "body");
    if (pose.body.empty()) table.refuse(row, "body", "is empty; a name is needed");
    if (!seen.emplace(std::pair(pose.frame, pose.body), row).second) {
      table.refuse(row, "frame", fmt::format("frame {} of body `{}` is given twice", pose.frame, pose.body));
    }
    try {
      if (table.has("status")) pose.status = status_of_text(table.text(row, "status"));
    } catch (const InputError& error) {
      table.refuse(row, "status", error.what());
    }
    const bool trusted = pose.status != PoseStatus::Ambiguous && pose.status != PoseStatus::Lost;
    if (trusted && !table.text(row, "x_mm").empty()) pose.tracker_from_body = motion_of(table, row);
    if (pose.tracker_from_body) pose.covariance = covariance_of(table, row);
    pose.targets = table.optional_integer(row, "targets").value_or(0);
    pose.rms_px = table.optional_number(row, "rms_px").value_or(0);
  }
  return poses;
}

void read_pose_covariances(const std::filesystem::path& file, std::vector<PoseRecord>& poses) {
  std::map<std::pair<int, std::string>, PoseRecord*> by_frame;
  for (PoseRecord& pose : poses) by_frame[{pose.frame, pose.body}] = &pose;
  std::istringstream lines(read_file(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty()) continue;
    const std::string where = fmt::format("{}:{}", file.string(), number);
    try {
      const auto json = nlohmann::json::parse(line);
      const auto found = by_frame.find({json.at("frame").get<int>(), json.at("body").get<std::string>()});
      if (found == by_frame.end() || !json.contains("covariance")) continue;
      found->second->covariance = matrix_of(json.at("covariance"));
      if (json.contains("systematic")) found->second->systematic = matrix_of(json.at("systematic"));
    } catch (const nlohmann::json::exception&) {
      throw InputError(where, "is no JSON object with frame, body and a 6×6 covariance");
    }
  }
}

PoseRecord record_of(int frame, double time_s, const BodyPose& pose, const std::vector<Body>& bodies) {
  PoseRecord record;
  record.frame = frame;
  record.time_s = time_s;
  record.body = bodies.at(static_cast<std::size_t>(pose.body)).name;
  record.status = pose.status;
  record.targets = pose.targets;
  record.rms_px = pose.rms_px;
  if (pose.estimate) {
    record.tracker_from_body = pose.estimate->tracker_from_body;
    record.covariance = pose.estimate->covariance;
    record.systematic = pose.estimate->systematic;
  }
  return record;
}

PoseTable::PoseTable(const std::filesystem::path& file) : file_(file, OutputFile::Unfinished::Keep) {
  file_.write(
      "frame,time_s,body,status,x_mm,y_mm,z_mm,qw,qx,qy,qz,targets,rms_px,sigma_x_mm,sigma_y_mm,sigma_z_mm,"
      "sigma_rx_deg,sigma_ry_deg,sigma_rz_deg\n");
}

void PoseTable::write(const PoseRecord& pose) {
  file_.write(
      fmt::format("{},{},{},{},", pose.frame, pose.time_s, csv_cell(pose.body), text_of(pose.status)));
  if (pose.tracker_from_body) {
    file_.write(pose_cells(*pose.tracker_from_body) + ",");
  } else {
    file_.write(",,,,,,,");
  }
  file_.write(fmt::format("{},{:.5f}", pose.targets, pose.rms_px));
  if (pose.tracker_from_body && pose.covariance) {
    file_.write("," + sigma_cells(*pose.covariance) + "\n");
  } else {
    file_.write(",,,,,,\n");
  }
}

std::string json_line(const PoseRecord& pose) {
  nlohmann::ordered_json json = {{"frame", pose.frame},
                                 {"time_s", pose.time_s},
                                 {"body", pose.body},
                                 {"status", std::string(text_of(pose.status))}};
  if (const auto& motion = pose.tracker_from_body) {
    const Quaternion& q = motion->rotation;
    json["translation_mm"] = {motion->translation.x(), motion->translation.y(), motion->translation.z()};
    json["quaternion_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  }
  if (pose.tracker_from_body && pose.covariance) {
    json["covariance"] = rows_of(*pose.covariance);
    if (pose.systematic) json["systematic"] = rows_of(*pose.systematic);
  }
  return json.dump();
}

void write_tum(const std::filesystem::path& file, const std::vector<PoseRecord>& poses,
               const std::string& body) {
  constexpr double kMetresPerMm = 1e-3;
  std::string text;
  for (const PoseRecord& pose : poses) {
    if (pose.body != body || !pose.tracker_from_body) continue;
    const Vec3 t = kMetresPerMm * pose.tracker_from_body->translation;
    const Quaternion& q = pose.tracker_from_body->rotation;
    text += fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} {:.12f} {:.12f} {:.12f} {:.12f}\n", pose.time_s, t.x(),
                        t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  write_file(file, text);
}

}  // namespace asterism
