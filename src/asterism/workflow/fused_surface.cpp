// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fused_surface.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/surface_tree.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/report/scan_report.hpp"

namespace asterism {
namespace {

/// The surface and what it is called; empty when none is known.
void find_surface(const FuseScansJob& job, const std::optional<Cell>& cell, FusedScans& fused) {
  if (!job.mesh.empty()) {
    fused.part = job.mesh.stem().string();
    fused.surface = checked_mesh(read_mesh(job.mesh), job.mesh_scale, job.mesh.string());
  } else if (cell && cell->workpiece) {
    fused.part = cell->workpiece->name;
    fused.surface = *cell->workpiece->surface;
  }
}

ScanReport report_of(const FusedScans& fused, const FuseScansJob& job) {
  ScanReport report;
  report.title = "Scans in one cloud";
  report.subtitle = fmt::format("{} scans, {} points", fused.scans.size(), fused.cloud.size());
  report.remarks = fused.remarks;
  report.scanner = fused.scanner;
  report.part = fused.part;
  report.surface = fused.surface;
  report.samples = fused.samples;
  report.tolerance_mm = job.options.deviation.tolerance_mm;
  ScanReport::Round round;
  round.name = "all scans";
  round.cloud = fused.cloud;
  round.completeness = fused.completeness;
  round.deviation = fused.deviation;
  report.rounds.push_back(std::move(round));
  report.summary = summary_rows_of(fused);
  report.options_json = summary_of(fused, job)["options"].dump();
  return report;
}

}  // namespace

void judge_by_surface(const FuseScansJob& job, const std::optional<Cell>& cell, FusedScans& fused) {
  find_surface(job, cell, fused);
  if (fused.surface.empty()) return;
  if (fused.frame != "workpiece") {
    if (job.mesh.empty()) {
      fused.surface = {};
      return;  // the cell's part lies elsewhere than the cloud
    }
    fused.remarks.push_back(fmt::format("the surface {} is taken to lie in the cloud's frame ({})",
                                        job.mesh.filename().string(), fused.frame));
  }
  const std::vector<ScanRegion> regions = cell ? cell->scan_task.regions : std::vector<ScanRegion>{};
  fused.samples =
      sample_surface(fused.surface, static_cast<std::size_t>(job.options.samples), regions, job.seed);
  fused.completeness = completeness_of(fused.cloud, fused.samples, job.options.completeness);
  fused.deviation = deviation_of(fused.cloud, SurfaceTree(fused.surface), regions, job.options.deviation);
  fused.cloud.fields.push_back({"deviation_mm", fused.deviation->mm});
}

void write_fused(const FusedScans& fused, const FuseScansJob& job) {
  if (job.out.empty()) return;
  const std::filesystem::path folder = job.out.parent_path();
  if (job.report) write_scan_report(folder / "report.html", report_of(fused, job));
  write_file(folder / "fusion.json", summary_of(fused, job).dump(2) + "\n");
  write_cloud(job.out, fused.cloud);
}

}  // namespace asterism
