// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fuse_scans.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/alignment_file.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/workflow/fused_surface.hpp"
#include "asterism/workflow/scan_poses.hpp"
#include "asterism/workflow/scan_source.hpp"
#include "asterism/workflow/scan_views.hpp"

namespace asterism {
namespace {

std::optional<Cell> cell_of_job(const FuseScansJob& job) {
  if (!job.cell.empty()) return cell_of(job.cell);
  const std::filesystem::path beside = job.scans / "cell.toml";
  if (std::filesystem::is_regular_file(beside)) return read_cell(beside);
  return std::nullopt;
}

Mat6 place_covariance(const Scanner& scanner) {
  Mat6 covariance = Mat6::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(std::pow(rad_from_deg(scanner.place_sigma_deg), 2));
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(std::pow(scanner.place_sigma_mm, 2));
  return covariance;
}

/// Where the part is on its reference, and what the cloud's frame is called.
void align(const FuseScansJob& job, const std::optional<Cell>& cell, const ScanPoses& poses, ScanChain& chain,
           FusedScans& result) {
  if (poses.reference.empty()) {
    result.frame = "tracker";
    result.remarks.emplace_back(
        "no body is known to carry the part (--reference): the cloud is in the tracker's "
        "frame, and right only while the part stood still");
    return;
  }
  result.frame = poses.reference;
  if (!job.alignment.empty()) {
    const Alignment alignment = read_alignment(job.alignment);
    chain.reference_from_workpiece = alignment.platform_from_workpiece;
    chain.of_reference_from_workpiece = alignment.covariance;
    for (const std::string& motion : alignment.not_determined) {
      result.remarks.push_back(fmt::format("the alignment leaves free: {}", motion));
    }
    result.frame = "workpiece";
  } else if (cell && cell->workpiece && cell->workpiece->body == poses.reference) {
    chain.reference_from_workpiece = cell->workpiece->carrier_from_solid;
    result.frame = "workpiece";
    result.remarks.emplace_back(
        "the part's place on the platform is the cell's, taken as exact; `asterism align` "
        "measures it");
  } else {
    result.remarks.push_back(fmt::format(
        "no alignment is known (--alignment): the cloud is in the frame of `{}`", poses.reference));
  }
}

/// The chains of all scans, by the body that carries each.
std::map<std::string, ScanChain> chains_of(const FuseScansJob& job, const std::optional<Cell>& cell,
                                           const ScanPoses& poses, const std::vector<ScanEntry>& scans,
                                           FusedScans& result) {
  ScanChain chain;
  align(job, cell, poses, chain, result);
  const bool predicted = job.options.carrying.use_predicted;
  if (!poses.reference.empty()) chain.reference = track_of(poses.records, poses.reference, predicted);
  if (cell && cell->scanner) {
    chain.body_from_scanner = cell->scanner->body_from_scanner;
    chain.of_body_from_scanner = place_covariance(*cell->scanner);
  } else {
    result.remarks.emplace_back(
        "no scanner is known (--cell): its frame is taken as that of its body, and its "
        "noise as what the scans themselves tell");
  }
  std::map<std::string, ScanChain> chains;
  bool covariance = !chain.reference || chain.reference->covariance_known;
  for (const ScanEntry& scan : scans) {
    ScanChain& own = chains.try_emplace(scan.body, chain).first->second;
    if (own.scanner.body.empty()) own.scanner = track_of(poses.records, scan.body, predicted);
    covariance = covariance && own.scanner.covariance_known;
  }
  if (!covariance)
    result.remarks.emplace_back(
        "poses come without covariance: their noise is taken from how far "
        "scans lie apart where they overlap");
  return chains;
}

/// All that a fusion runs over.
struct Setup {
  const FuseScansJob& job;
  const ScanSource& source;
  const std::map<std::string, ScanChain>& chains;
  const ScanViews& views;
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

ScanChain chain_of(const Setup& setup, std::size_t scan) {
  ScanChain chain = setup.chains.at(setup.source.entries()[scan].body);
  if (const auto& view = setup.views.scanner_from_frame[scan]) {
    chain.body_from_scanner = chain.body_from_scanner * view->inverse();
  }
  return chain;
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
  const ScanChain chain = chain_of(setup, scan);
  const auto& view = setup.views.scanner_from_frame[scan];
  int part = -1;
  double part_from_s = 0, trace = 0;
  setup.source.each_piece(scan, [&](const Scan& piece) {
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
      keep_spots(each, setup.source.surveys()[scan].points,
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
  setup.spots.assign(setup.source.entries().size(), {});
  for (std::size_t i = 0; i < setup.source.entries().size(); ++i) {
    const ScanEntry& entry = setup.source.entries()[i];
    const ScanSurvey& survey = setup.source.surveys()[i];
    FusedScanRow row;
    row.scan = entry.scan;
    row.file = entry.file;
    row.body = entry.body;
    row.points = survey.points + survey.not_finite;
    row.not_finite = survey.not_finite;
    row.outliers = survey.outliers;
    fuse_scan(setup, i, fusion, row);
    result.scans.push_back(row);
    progress("fusing scans", i + 1, setup.source.entries().size());
  }
  return fusion.cloud();
}

/// Where each scan's frame is on the part at its middle moment, where that is told.
std::vector<std::optional<RigidMotion>> places_of(const ScanSource& source,
                                                  const std::map<std::string, ScanChain>& chains,
                                                  const CarryOptions& options) {
  std::vector<std::optional<RigidMotion>> places;
  for (std::size_t i = 0; i < source.entries().size(); ++i) {
    std::optional<double> time_s = source.entries()[i].time_s;
    source.each_piece(i, [&](const Scan& piece) {
      if (!piece.times_s.empty() || !time_s) time_s = piece.time_of(piece.in_scanner.size() / 2);
    });
    places.emplace_back();
    if (!time_s) continue;
    const auto pose = scanner_pose_at(chains.at(source.entries()[i].body), *time_s, options.largest_gap_s);
    if (pose) places.back() = pose->workpiece_from_scanner;
  }
  return places;
}

void remark_on(const FuseScansJob& job, const ScanPoses& poses, FusedScans& result) {
  std::size_t left_out = 0, whole = 0;
  for (const FusedScanRow& row : result.scans) {
    left_out += row.no_pose + row.outside_run + row.gap;
    whole += row.used == 0 ? 1 : 0;
  }
  if (left_out > 0) {
    result.remarks.push_back(
        fmt::format("{} points of {} have no pose at their time in {} and are left out{}", left_out,
                    result.fused.points_in + left_out, poses.file.string(),
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

void refuse_nothing_fused(const FusedScans& result, const ScanPoses& poses) {
  if (!result.fused.points.empty()) return;
  std::set<std::string> bodies;
  for (const PoseRecord& record : poses.records) bodies.insert(record.body);
  std::size_t no_pose = 0, outside = 0, gap = 0;
  for (const FusedScanRow& row : result.scans) {
    no_pose += row.no_pose;
    outside += row.outside_run;
    gap += row.gap;
  }
  throw MeasurementError(fmt::format(
      "not one point has a pose at its time: {} of a body without poses in {} (there are: {}), {} before or "
      "after the run, {} while the tracker had lost the body",
      no_pose, poses.file.string(), fmt::join(bodies, ", "), outside, gap));
}

/// Without covariances a pose may be turned as much as moves the scan's rim by what scans lie apart.
void guess_turns(Setup& setup) {
  for (std::size_t i = 0; i < setup.spots.size(); ++i) {
    ScanSpots& scan = setup.spots[i];
    if (scan.spots.empty()) continue;
    scan.origin.setZero();
    for (const SurfaceSpot& spot : scan.spots)
      scan.origin += spot.at / static_cast<double>(scan.spots.size());
    const double sigma_rad = setup.pose_sigma_mm / (0.3 * setup.source.surveys()[i].across_mm);
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

}  // namespace

FusedScans fuse_scans(const FuseScansJob& job, const Progress& progress) {
  FusedScans result;
  if (!std::filesystem::is_directory(job.scans)) {
    throw InputError(job.scans.string(), "is no folder; one with scans.csv and poses is needed");
  }
  const std::optional<Cell> cell = cell_of_job(job);
  std::vector<ScanEntry> entries = read_scan_entries(job.scans);
  if (entries.empty()) throw InputError((job.scans / "scans.csv").string(), "names no scan");
  const std::string platform = cell && cell->platform ? cell->platform->body : "";
  const ScanPoses poses =
      poses_of_scans(job.scans, {job.poses, job.reference, platform, job.poses_mm_each}, entries);
  result.remarks = poses.remarks;
  const auto chains = chains_of(job, cell, poses, entries, result);
  const std::optional<Scanner> scanner = cell ? cell->scanner : std::nullopt;
  const ScanSource source(job.scans, entries, job.scans_mm_each, scanner, job.options.surface, progress);
  const ScanViews views = views_of(source.surveys(), places_of(source, chains, job.options.carrying));
  result.remarks.insert(result.remarks.end(), views.remarks.begin(), views.remarks.end());

  Setup setup{job, source, chains, views, source.scanner(), 0};
  if (views.stand_off_mm > 0) setup.scanner.stand_off_mm = views.stand_off_mm;
  result.fused = fuse_all(setup, result, progress);
  refuse_nothing_fused(result, poses);
  const bool exact = std::any_of(chains.begin(), chains.end(), [](const auto& chain) {
    return !chain.second.scanner.covariance_known ||
           (chain.second.reference && !chain.second.reference->covariance_known);
  });
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
