// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fuse_scans.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/workflow/fused_surface.hpp"
#include "asterism/workflow/scan_session.hpp"

namespace asterism {
namespace {

std::optional<Cell> cell_of_job(const FuseScansJob& job) {
  if (!job.cell.empty()) return cell_of(job.cell);
  const std::filesystem::path beside = job.scans.front() / "cell.toml";
  if (std::filesystem::is_regular_file(beside)) return read_cell(beside);
  return std::nullopt;
}

/// A scan of one of the sessions.
struct SessionScan {
  const ScanSession* session;
  std::size_t index;  // in it
  int number;         // in the cloud: its own, or one that no other session has

  [[nodiscard]] const ScanEntry& entry() const { return session->source->entries()[index]; }
  [[nodiscard]] const ScanSurvey& survey() const { return session->source->surveys()[index]; }
};

/// All that a fusion runs over.
struct Setup {
  const FuseScansJob& job;
  std::vector<SessionScan> scans;
  Scanner scanner;
  double pose_sigma_mm = 0;                                   // noise that poses are given beyond their own
  std::vector<ScanSpots> spots = {};                          // by scan: what registration compares
  std::vector<std::optional<Registration>> corrections = {};  // by scan: applied where they are there
};

/// A scan's pose as its shape corrects it.
void correct(const Registration& by_shape, ScannerPose& pose) {
  pose.workpiece_from_scanner = motion_of(by_shape) * pose.workpiece_from_scanner;
  pose.noise = covariance_at(by_shape, pose.workpiece_from_scanner.translation);
}

/// Some of a carried part's points, evenly, for registration.
void keep_spots(const CarriedPart& part, std::size_t of, std::size_t most, ScanSpots& spots) {
  const std::size_t stride = std::max<std::size_t>(1, of / most);
  for (std::size_t i = 0; i < part.points.size(); i += stride) {
    const CarriedPoint& point = part.points[i];
    if (point.normal.isZero()) continue;
    const Vec3 n = point.normal.cast<double>();
    const auto& c = point.scanner_mm2;
    Mat3 covariance;
    covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
    spots.spots.push_back({point.at, n, std::max(1e-12, n.dot(covariance * n))});
  }
}

/// How well a part's pose puts its middle point, as the trace of that covariance.
double pose_trace(const CarriedScan& scan, const CarriedPart& part) {
  const CarriedPoint& point = part.points[part.points.size() / 2];
  const ScannerPose& pose = scan.poses[point.pose];
  const Vec3 in_scanner = pose.workpiece_from_scanner.inverse() * point.at;
  return covariance_of_point(pose.workpiece_from_scanner, pose.noise + pose.systematic, in_scanner).trace();
}

/// One scan on its way into the cloud.
void fuse_scan(Setup& setup, std::size_t scan, CloudFusion& fusion, FusedScanRow& row) {
  const SessionScan& of = setup.scans[scan];
  const ScanChain chain = of.session->chain_of(of.index);
  const auto& view = of.session->views.scanner_from_frame[of.index];
  int part = -1;
  double part_from_s = 0, trace = 0;
  of.session->source->each_piece(of.index, [&](const Scan& piece) {
    CarriedScan to =
        carried(view ? seen_from(*view, piece) : piece, chain, setup.scanner, setup.job.options.carrying);
    row.no_pose += to.no_pose;
    row.outside_run += to.outside_run;
    row.gap += to.gap;
    for (ScannerPose& pose : to.poses) {
      pose.noise.bottomRightCorner<3, 3>().diagonal().array() += setup.pose_sigma_mm * setup.pose_sigma_mm;
      if (!setup.corrections.empty() && setup.corrections[scan]) correct(*setup.corrections[scan], pose);
    }
    for (const CarriedPart& each : to.parts) {
      // A large scan comes in pieces: what lies within one part's time goes on with it.
      const bool goes_on =
          part >= 0 && std::abs(each.from_s - part_from_s) < setup.job.options.carrying.independent_s;
      if (!goes_on) {
        ++part;
        part_from_s = each.from_s;
        trace += pose_trace(to, each);
      }
      fusion.add(row.scan, part, to.poses, each.points);
      row.used += each.points.size();
      ScanSpots& spots = setup.spots[scan];
      keep_spots(each, of.survey().points,
                 static_cast<std::size_t>(setup.job.options.registration.most_spots), spots);
      spots.noise = to.poses[each.points.front().pose].noise;
      spots.origin = to.poses[each.points.front().pose].workpiece_from_scanner.translation;
    }
  });
  row.sigma_mm = part >= 0 ? std::sqrt(trace / (3 * (part + 1))) : 0;
}

FusedCloud fuse_all(Setup& setup, FusedScans& result, const Progress& progress) {
  const CloudFusionOptions& options = setup.job.options.fusion;
  CloudFusion fusion(options);
  result.scans.clear();
  setup.spots.assign(setup.scans.size(), {});
  for (std::size_t i = 0; i < setup.scans.size(); ++i) {
    const ScanEntry& entry = setup.scans[i].entry();
    const ScanSurvey& survey = setup.scans[i].survey();
    FusedScanRow row;
    row.scan = setup.scans[i].number;
    row.file = entry.file;
    row.body = entry.body;
    row.points = survey.points + survey.not_finite;
    row.not_finite = survey.not_finite;
    row.outliers = survey.outliers;
    fuse_scan(setup, i, fusion, row);
    result.scans.push_back(row);
    progress("fusing scans", i + 1, setup.scans.size());
  }
  return fusion.cloud();
}

void remark_on(const FuseScansJob& job, const std::string& poses, FusedScans& result) {
  std::size_t left_out = 0, whole = 0;
  for (const FusedScanRow& row : result.scans) {
    left_out += row.no_pose + row.outside_run + row.gap;
    whole += row.used == 0 ? 1 : 0;
  }
  if (left_out > 0) {
    result.remarks.push_back(
        fmt::format("{} points of {} have no pose at their time in {} and are left out{}", left_out,
                    result.fused.points_in + left_out, poses,
                    whole > 0 ? fmt::format("; {} scans are left out altogether", whole) : ""));
  }
  constexpr double kMany = 0.05;
  const auto refused = static_cast<double>(result.fused.outliers);
  if (refused > kMany * static_cast<double>(result.fused.points_in)) {
    result.remarks.push_back(
        fmt::format("{:.1f} % of the points were refused since others of their voxel contradict them: "
                    "some poses are worse than they say, or the part moved on its platform",
                    100 * refused / static_cast<double>(result.fused.points_in)));
  }
  constexpr double kWorse = 2;
  if (result.fused.shared > 100 && result.fused.disagreement > kWorse) {
    result.remarks.push_back(
        fmt::format("overlapping scans lie {:.1f} times as far apart as their covariances say",
                    std::sqrt(result.fused.disagreement)));
  }
  if (job.options.fusion.min_points > 1 && result.fused.few > 0) {
    result.remarks.push_back(fmt::format("{} points lie in voxels of fewer than {} and are left out",
                                         result.fused.few, job.options.fusion.min_points));
  }
}

void refuse_nothing_fused(const FusedScans& result, const std::vector<ScanSession>& sessions,
                          const std::string& poses) {
  if (!result.fused.points.empty()) return;
  std::set<std::string> bodies;
  for (const ScanSession& session : sessions) {
    for (const PoseRecord& record : session.poses.records) bodies.insert(record.body);
  }
  std::size_t no_pose = 0, outside = 0, gap = 0;
  for (const FusedScanRow& row : result.scans) {
    no_pose += row.no_pose;
    outside += row.outside_run;
    gap += row.gap;
  }
  throw MeasurementError(fmt::format(
      "not one point has a pose at its time: {} of a body without poses in {} (there are: {}), {} before or "
      "after the run, {} while the tracker had lost the body",
      no_pose, poses, fmt::join(bodies, ", "), outside, gap));
}

/// Without covariances a pose may be turned as much as moves the scan's rim by what scans lie apart.
void guess_turns(Setup& setup) {
  for (std::size_t i = 0; i < setup.spots.size(); ++i) {
    ScanSpots& scan = setup.spots[i];
    if (scan.spots.empty()) continue;
    scan.origin.setZero();
    for (const SurfaceSpot& spot : scan.spots)
      scan.origin += spot.at / static_cast<double>(scan.spots.size());
    const double sigma_rad = setup.pose_sigma_mm / (0.3 * setup.scans[i].survey().across_mm);
    scan.noise.setZero();
    scan.noise.topLeftCorner<3, 3>().diagonal().setConstant(sigma_rad * sigma_rad);
    scan.noise.bottomRightCorner<3, 3>().diagonal().setConstant(setup.pose_sigma_mm * setup.pose_sigma_mm);
  }
}

/// Holds each scan against the others by its shape; corrects poses where that is asked for.
void check_by_shape(const FuseScansJob& job, Setup& setup, FusedScans& result, const Progress& progress) {
  std::vector<std::optional<Registration>> judged = register_scans(setup.spots, job.options.registration);
  if (job.refine) {
    setup.corrections = judged;
    for (auto& correction : setup.corrections) {
      if (correction && correction->degrees == 0) correction.reset();
    }
    result.fused = fuse_all(setup, result, progress);
    result.remarks.emplace_back("poses were corrected by the scans' shape (--refine)");
  }
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (judged[i] && judged[i]->disagrees) {
      result.remarks.push_back(
          fmt::format("scan {}: its shape disagrees with its tracked pose by {:.2f} mm and {:.2f}° "
                      "(χ² {:.0f} on {})",
                      result.scans[i].scan, judged[i]->shift_mm, judged[i]->turn_deg, judged[i]->chi2,
                      judged[i]->degrees));
    }
    result.scans[i].by_shape = std::move(judged[i]);
  }
}

/// How far scans lie apart beyond what is stated, as noise of each one's pose.
double told_pose_sigma(const FusedCloud& fused) {
  return std::sqrt(std::max(0.0, fused.apart_mm * fused.apart_mm - fused.stated_mm * fused.stated_mm));
}

/// All scans in one row; a session whose numbers are taken is numbered on from the highest.
std::vector<SessionScan> scans_of(const std::vector<ScanSession>& sessions, FusedScans& result) {
  std::vector<SessionScan> scans;
  std::set<int> taken;
  const auto by_number = [](const ScanEntry& a, const ScanEntry& b) { return a.scan < b.scan; };
  for (const ScanSession& session : sessions) {
    const auto& entries = session.source->entries();
    const bool free = std::none_of(entries.begin(), entries.end(),
                                   [&](const ScanEntry& entry) { return taken.contains(entry.scan); });
    const int lowest = std::min_element(entries.begin(), entries.end(), by_number)->scan;
    const int shift = free ? 0 : *taken.rbegin() + 1 - lowest;
    if (!free) {
      result.remarks.push_back(fmt::format("scans of {} have numbers that are taken: {} is added to them",
                                           session.poses.file.parent_path().string(), shift));
    }
    for (std::size_t i = 0; i < entries.size(); ++i) scans.push_back({&session, i, entries[i].scan + shift});
    for (const ScanEntry& entry : entries) taken.insert(entry.scan + shift);
  }
  return scans;
}

std::vector<ScanSession> sessions_of(const FuseScansJob& job, const std::optional<Cell>& cell,
                                     FusedScans& result, const Progress& progress) {
  std::vector<ScanSession> sessions;
  for (const std::filesystem::path& folder : job.scans) {
    sessions.push_back(open_session(job, folder, cell, progress));
    const ScanSession& session = sessions.back();
    if (session.frame != sessions.front().frame) {
      throw InputError(folder.string(),
                       fmt::format("its cloud would be in the frame of `{}`, that of {} in `{}`; "
                                   "give --reference or --alignment for both",
                                   session.frame, job.scans.front().string(), sessions.front().frame));
    }
    for (const std::string& remark : session.remarks) {
      if (std::find(result.remarks.begin(), result.remarks.end(), remark) == result.remarks.end())
        result.remarks.push_back(remark);
    }
  }
  result.frame = sessions.front().frame;
  return sessions;
}

}  // namespace

FusedScans fuse_scans(const FuseScansJob& job, const Progress& progress) {
  require(!job.scans.empty(), "there is a folder of scans");
  FusedScans result;
  const std::optional<Cell> cell = cell_of_job(job);
  const std::vector<ScanSession> sessions = sessions_of(job, cell, result, progress);
  const std::string poses = sessions.front().poses.file.string() + (sessions.size() > 1 ? ", …" : "");

  Setup setup{job, scans_of(sessions, result), sessions.front().source->scanner()};
  if (const double set = sessions.front().views.stand_off_mm; set > 0) setup.scanner.stand_off_mm = set;
  result.fused = fuse_all(setup, result, progress);
  refuse_nothing_fused(result, sessions, poses);
  const bool exact = std::any_of(sessions.begin(), sessions.end(),
                                 [](const ScanSession& session) { return !session.covariance_known(); });
  if (exact && result.fused.shared > 0) {
    setup.pose_sigma_mm = told_pose_sigma(result.fused);
    result.fused = fuse_all(setup, result, progress);
  }
  if (exact) guess_turns(setup);
  if (setup.spots.size() > 1) check_by_shape(job, setup, result, progress);
  result.pose_sigma_mm = setup.pose_sigma_mm;
  result.scanner = setup.scanner;
  result.cloud = cloud_of(result.fused);
  remark_on(job, poses, result);
  judge_by_surface(job, cell, result);
  write_fused(result, job);
  return result;
}

}  // namespace asterism
