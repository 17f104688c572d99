// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/simulate_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "asterism/core/output_file.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/reading_table.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/io/rig_file.hpp"
#include "asterism/io/scan_folder.hpp"
#include "asterism/simulation/read_out.hpp"
#include "asterism/simulation/scan.hpp"

namespace asterism {
namespace {

constexpr double kWhole = 0.98;

std::string line_of_target(int frame, const TargetTruth& t, const std::vector<Body>& bodies) {
  const Body& body = bodies[static_cast<std::size_t>(t.body)];
  return fmt::format(
      "{},{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{:.3f},{:.3f},{:.4f},{},{:.4f},{:.3f},{:.5f},{:."
      "5f},{:.5f}\n",
      frame, t.side == Side::Left ? "cam0" : "cam1", csv_cell(body.name),
      csv_cell(body.targets[static_cast<std::size_t>(t.target)].id), t.centre_px.x(), t.centre_px.y(),
      t.image.centre.x(), t.image.centre.y(), t.image.semi_major, t.image.semi_minor,
      deg_from_rad(t.image.angle_rad), deg_from_rad(t.incidence_rad), t.brightness, t.in_image ? 1 : 0,
      t.visible, t.blur_px, t.in_camera.x(), t.in_camera.y(), t.in_camera.z());
}

std::string line_of_pose(int frame, double time_s, const std::string& body, const RigidMotion& pose) {
  const double sign = pose.rotation.w() < 0 ? -1 : 1;
  const Quaternion& q = pose.rotation;
  return fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f}\n", frame, time_s,
                     csv_cell(body), pose.translation.x(), pose.translation.y(), pose.translation.z(),
                     sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z());
}

/// The tables of a recording, written frame by frame in order.
class TruthTables {
 public:
  TruthTables(const std::filesystem::path& folder, std::vector<Body> bodies, bool centres)
      : bodies_(std::move(bodies)),
        frames_(folder / "frames.csv"),
        poses_(folder / "truth_poses.csv"),
        targets_(folder / "truth_targets.csv") {
    if (centres) centres_.emplace(folder / "centres.csv");
    frames_.write("frame,time_s,left,right\n");
    poses_.write("frame,time_s,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n");
    targets_.write(
        "frame,camera,body,target,u_centre,v_centre,u_centroid,v_centroid,a_px,b_px,angle_deg,incidence_deg,"
        "brightness,in_image,visible,blur_px,x_c_mm,y_c_mm,z_c_mm\n");
  }

  void write(const SimulatedFrame& made, const FrameEntry& entry, SimulatedRecording& counts) {
    frames_.write(fmt::format("{},{},{},{}\n", made.frame, made.time_s, entry.left, entry.right));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      poses_.write(line_of_pose(made.frame, made.time_s, bodies_[i].name, made.truth.tracker_from_body[i]));
    }
    for (const TargetTruth& target : made.truth.targets) {
      targets_.write(line_of_target(made.frame, target, bodies_));
      ++(target.visible >= kWhole ? counts.targets_seen : counts.targets_hidden);
    }
    if (centres_) centres_->write(made.centres, "", "");
    ++counts.frames;
  }

  void finish() {
    poses_.finish();
    targets_.finish();
    if (centres_) centres_->finish();
    frames_.finish();
  }

 private:
  std::vector<Body> bodies_;
  OutputFile frames_, poses_, targets_;
  std::optional<CentreTable> centres_;
};

FrameEntry write_images(const SimulateJob& job, const SimulatedFrame& made) {
  FrameEntry entry{made.frame, made.time_s, "", ""};
  const std::string name =
      fmt::format("{:04}.{}", made.frame, job.format == PictureFormat::Pgm ? "pgm" : "png");
  if (made.image.left) {
    entry.left = "left/" + name;
    write_image(job.out / entry.left, *made.image.left);
  }
  if (made.image.right) {
    entry.right = "right/" + name;
    write_image(job.out / entry.right, *made.image.right);
  }
  return entry;
}

void make_folders(const SimulateJob& job) {
  std::error_code error;
  std::filesystem::create_directories(job.out, error);
  // What an earlier run left would make a recording of two halves.
  for (const char* old : {"frames.csv", "centres.csv", "read_out.csv", "scans.csv"})
    std::filesystem::remove(job.out / old, error);
  if (job.options.level == SimulationLevel::Centres) return;
  for (const char* side : {"left", "right"}) std::filesystem::create_directories(job.out / side, error);
  if (error) throw InputError(job.out.string(), "cannot be made: " + error.message());
}

/// Where the light of each point truly fell, in the workpiece's frame, point by point as in the scan.
Cloud truth_of(const SimulatedScan& made) {
  Cloud truth;
  for (const Vec3f& point : made.true_in_workpiece) truth.points.emplace_back(point.cast<double>());
  truth.fields.push_back({"outlier", {made.outlier.begin(), made.outlier.end()}});
  return truth;
}

void write_scans(const Cell& cell, const SimulateJob& job, SimulatedRecording& counts,
                 const Progress& progress) {
  if (cell.passes.empty()) return;
  const Stage stage = stage_of(cell);
  std::vector<ScanEntry> entries;
  for (const ScanPass& pass : cell.passes) {
    const SimulatedScan made = simulate_scan(stage, pass, job.options.seed);
    write_scan(job.out, made.scan);
    write_cloud(job.out / ("truth_" + entry_of(made.scan).file), truth_of(made),
                CloudFormat::BinaryLittleEndian, Coordinates::Single);
    entries.push_back(entry_of(made.scan));
    ++counts.scans;
    counts.scan_points += made.scan.in_scanner.size();
    progress("simulating scans", counts.scans, cell.passes.size());
  }
  write_scan_entries(job.out, entries);
}

void count_faults(const Cell& cell, SimulatedRecording& counts) {
  const double last_s = (cell.timing.frames - 1) / cell.timing.rate_hz;
  std::set<std::pair<std::string, std::string>> fallen, knocked;
  for (const TargetFault& fault : cell.faults) {
    if (fault.time_s > last_s) continue;
    (fault.kind == FaultKind::FallsOff ? fallen : knocked).emplace(fault.body, fault.target);
  }
  for (const auto& target : fallen) knocked.erase(target);
  counts.fallen = fallen.size();
  counts.knocked = knocked.size();
}

}  // namespace

SimulatedRecording simulate_recording(const Cell& cell, const SimulateJob& job, const Progress& progress) {
  const Simulator simulator(cell, job.options);
  const bool images = job.options.level == SimulationLevel::Images;
  make_folders(job);
  write_rig(job.out / "rig.yaml", cell.rig);
  write_bodies(job.out / "bodies.toml", bodies_of(cell));
  write_cell(job.out / "cell.toml", cell);
  if (cell.platform) write_readings(job.out / "read_out.csv", simulate_read_out(cell, job.options.seed));
  TruthTables tables(job.out, bodies_of(cell), !images);
  SimulatedRecording counts;
  constexpr std::size_t kBatch = 8;  // frames in memory at once
  const auto total = static_cast<std::size_t>(cell.timing.frames);
  const char* doing = images ? "rendering images" : "simulating centres";
  for (std::size_t first = 0; first < total; first += kBatch) {
    const std::size_t count = std::min(kBatch, total - first);
    std::vector<SimulatedFrame> made(count);
    std::vector<FrameEntry> entries(count);
    parallel_for(count, [&](std::size_t i) {
      made[i] = simulator.frame(static_cast<int>(first + i));
      entries[i] = write_images(job, made[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      tables.write(made[i], entries[i], counts);
      if (images) counts.lost += (entries[i].left.empty() ? 1U : 0U) + (entries[i].right.empty() ? 1U : 0U);
    }
    progress(doing, first + count, total);
  }
  write_scans(cell, job, counts, progress);
  tables.finish();
  count_faults(cell, counts);
  return counts;
}

}  // namespace asterism
