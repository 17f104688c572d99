// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asterism/core/result.hpp"
#include "asterism/io/alignment_file.hpp"
#include "asterism/io/hand_eye_file.hpp"
#include "asterism/io/scan_folder.hpp"
#include "asterism/workflow/poses_by_frame.hpp"

namespace asterism {
namespace {

/// Where the part is on its reference, and what the cloud's frame is called.
void align(const FuseScansJob& job, const std::optional<Cell>& cell, const ScanPoses& poses, ScanChain& chain,
           ScanSession& result) {
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
                                           ScanSession& result) {
  ScanChain chain;
  align(job, cell, poses, chain, result);
  const bool predicted = job.options.carrying.use_predicted;
  if (!poses.reference.empty()) chain.reference = track_of(poses.records, poses.reference, predicted);
  if (cell && cell->scanner) {
    chain.body_from_scanner = cell->scanner->body_from_scanner;
    chain.of_body_from_scanner =
        covariance_of(StatedSigma{cell->scanner->place_sigma_mm, cell->scanner->place_sigma_deg});
  } else if (job.hand_eye.empty()) {
    result.remarks.emplace_back(
        "no scanner is known (--cell): its frame is taken as that of its body, and its "
        "noise as what the scans themselves tell");
  }
  if (!job.hand_eye.empty()) {
    const KnownMotion measured = read_hand_eye(job.hand_eye);
    chain.body_from_scanner = measured.motion;
    chain.of_body_from_scanner = measured.covariance;
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

}  // namespace

ScanChain ScanSession::chain_of(std::size_t scan) const {
  ScanChain chain = chains.at(source->entries()[scan].body);
  if (const auto& view = views.scanner_from_frame[scan]) {
    chain.body_from_scanner = chain.body_from_scanner * view->inverse();
  }
  return chain;
}

bool ScanSession::covariance_known() const {
  return std::all_of(chains.begin(), chains.end(), [](const auto& chain) {
    return chain.second.scanner.covariance_known &&
           (!chain.second.reference || chain.second.reference->covariance_known);
  });
}

ScanSession open_session(const FuseScansJob& job, const std::filesystem::path& folder,
                         const std::optional<Cell>& cell, const Progress& progress) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder.string(), "is no folder; one with scans.csv and poses is needed");
  }
  std::vector<ScanEntry> entries = read_scan_entries(folder);
  if (entries.empty()) throw InputError((folder / "scans.csv").string(), "names no scan");
  const std::string platform = cell && cell->platform ? cell->platform->body : "";
  ScanSession session;
  session.poses = poses_of_scans(folder, {job.poses, job.reference, platform, job.poses_mm_each}, entries);
  session.remarks = session.poses.remarks;
  session.chains = chains_of(job, cell, session.poses, entries, session);
  const std::optional<Scanner> scanner = cell ? cell->scanner : std::nullopt;
  session.source.emplace(folder, entries, job.scans_mm_each, scanner, job.options.surface, progress);
  session.views =
      views_of(session.source->surveys(), places_of(*session.source, session.chains, job.options.carrying));
  session.remarks.insert(session.remarks.end(), session.views.remarks.begin(), session.views.remarks.end());
  return session;
}

}  // namespace asterism
