// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/compare_cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/report/scan_report.hpp"
#include "asterism/workflow/cloud_tables.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPiece = 1U << 18;  // points that are in memory at a time

struct Part {
  std::string name;
  TriangleMesh surface;
  std::vector<ScanRegion> regions;
};

Part part_of(const CompareJob& job) {
  if (job.cell.empty() == job.mesh.empty()) {
    throw InputError("the surface is that of a cell's part or of a mesh: one of --cell and --mesh is needed");
  }
  if (!job.mesh.empty()) {
    MeshScale scale = job.mesh_scale;
    if (!scale.unit && !scale.longest_mm) scale.unit = LengthUnit::Millimetre;
    return {job.mesh.stem().string(), checked_mesh(read_mesh(job.mesh), scale, job.mesh.string()), {}};
  }
  const Cell cell = cell_of(job.cell);
  if (!cell.workpiece) {
    throw InputError(job.cell, "the cell has no part to compare with; give it a [workpiece], or use --mesh");
  }
  return {cell.workpiece->name, *cell.workpiece->surface, cell.scan_task.regions};
}

/// What is odd about the surface, where deviations depend on it.
std::vector<std::string> remarks_on_surface(const MeshFacts& facts) {
  std::vector<std::string> remarks;
  if (facts.boundary_edges > 0) {
    remarks.push_back(
        fmt::format("the surface is open ({} edges of one triangle alone): near its rim the sign of a "
                    "deviation tells the side of the nearest triangle, for there is no outside",
                    facts.boundary_edges));
  }
  if (facts.flipped_edges > 0) {
    remarks.push_back(
        fmt::format("triangles of the surface face opposite ways at {} edges: the signs of "
                    "deviations are not to be trusted there",
                    facts.flipped_edges));
  }
  return remarks;
}

/// A cloud that is smaller or larger than the surface by more than `odd_ratio`, and would fit in another
/// unit.
void check_size(const CompareJob& job, double diagonal_mm, const MeshFacts& facts, double odd_ratio) {
  const double ratio = facts.diagonal_mm() / diagonal_mm;
  if (job.unit || !(diagonal_mm > 0) || (ratio < odd_ratio && ratio > 1 / odd_ratio)) return;
  const auto misfit = [](double sizes) { return std::abs(std::log(sizes)); };
  const double likely = misfit(3);  // a cloud need not hold the whole part
  const std::string sizes = fmt::format("the cloud is {:.4g} mm from corner to corner, the surface {:.4g} mm",
                                        diagonal_mm, facts.diagonal_mm());
  std::size_t best = 0;
  for (std::size_t i = 1; i < length_unit_words().size(); ++i) {
    const auto misfit_of = [&](std::size_t unit) {
      return misfit(ratio / mm_of(static_cast<LengthUnit>(unit)));
    };
    if (misfit_of(i) < misfit_of(best)) best = i;
  }
  if (misfit(ratio / mm_of(static_cast<LengthUnit>(best))) < likely) {
    const std::string& unit = length_unit_words()[best];
    throw InputError(job.cloud.string(),
                     fmt::format("{}; in {} it would fit: say --unit {} (or --unit mm, if "
                                 "it is in mm)",
                                 sizes, unit, unit));
  }
  if (misfit(1000 * ratio) < likely) {
    throw InputError(
        job.cloud.string(),
        sizes + ": a factor of 1000; is the mesh in m? say --mesh-unit m (or --unit mm, if not)");
  }
}

void scale_to_mm(Cloud& cloud, double mm_each) {
  if (mm_each == 1) return;
  for (Vec3& point : cloud.points) point *= mm_each;
}

/// Of up to so many points near the surface, the share whose normal faces against it.
double share_against(const Cloud& cloud, const SurfaceTree& tree, double within_mm) {
  constexpr std::size_t kAsked = 2000;
  const std::size_t step = std::max<std::size_t>(cloud.normals.size() / kAsked, 1);
  std::size_t asked = 0, against = 0;
  for (std::size_t i = 0; i < cloud.normals.size(); i += step) {
    if (cloud.normals[i].isZero()) continue;
    const auto nearest = tree.nearest(cloud.points[i], within_mm);
    if (!nearest) continue;
    ++asked;
    against += nearest->normal.dot(cloud.normals[i].cast<double>()) < 0 ? 1 : 0;
  }
  return asked > 0 ? static_cast<double>(against) / static_cast<double>(asked) : 0;
}

void check_normals(const CompareJob& job, double against) {
  constexpr double kMost = 0.75;
  if (against <= kMost) return;
  throw InputError(
      job.cloud.string(),
      fmt::format("{:.0f} % of the cloud's normals face against the surface's: is the mesh inside "
                  "out (--flip)? If the normals are wrong, say --without-normals",
                  100 * against));
}

void append(Cloud& whole, const Cloud& piece) {
  whole.points.insert(whole.points.end(), piece.points.begin(), piece.points.end());
  whole.normals.insert(whole.normals.end(), piece.normals.begin(), piece.normals.end());
  if (whole.fields.empty()) {
    for (const CloudField& field : piece.fields) whole.fields.push_back({field.name, {}});
  }
  for (std::size_t f = 0; f < piece.fields.size(); ++f) {
    const std::vector<double>& values = piece.fields[f].values;
    whole.fields[f].values.insert(whole.fields[f].values.end(), values.begin(), values.end());
  }
}

void remark_on_place(const CompareJob& job, ComparedCloud& compared) {
  const DeviationSummary& whole = compared.deviation.whole;
  const double within_mm = job.options.deviation.within_mm;
  if (whole.points == 0) {
    throw InputError(job.cloud.string(),
                     fmt::format("not one of {} points lies within {:g} mm of the surface: cloud and surface "
                                 "must stand in one frame (`asterism align` brings them there), or raise "
                                 "--within-mm",
                                 compared.points, within_mm));
  }
  if (whole.beyond > whole.points) {
    compared.remarks.push_back(fmt::format("{} of {} points lie farther than {:g} mm from the surface",
                                           whole.beyond, compared.points, within_mm));
  }
  if (compared.not_finite > 0) {
    compared.remarks.push_back(
        fmt::format("{} points that are no numbers are left out", compared.not_finite));
  }
}

ScanReport report_of(const ComparedCloud& compared, const CompareJob& job) {
  ScanReport report;
  report.title = "Cloud against surface";
  report.subtitle =
      fmt::format("{}, {} points; {}", job.cloud.filename().string(), compared.points, compared.part);
  const DeviationSummary& whole = compared.deviation.whole;
  report.summary = {
      {"Completeness", fmt::format("{:.1f}", 100 * compared.completeness.share()), "% of the area",
       fmt::format("{} areas are missing", compared.completeness.holes.size())},
      {"Deviation", fmt::format("{:.4f}", whole.rms_mm), "mm RMS",
       fmt::format("mean {:.4f} mm", whole.mean_mm)},
      {"In tolerance", fmt::format("{:.1f}", 100 * whole.in_tolerance), "% of the points",
       fmt::format("within ±{:g} mm", job.options.deviation.tolerance_mm)}};
  report.remarks = compared.remarks;
  report.part = compared.part;
  report.surface = compared.surface;
  report.samples = compared.samples;
  report.tolerance_mm = job.options.deviation.tolerance_mm;
  ScanReport::Round round;
  round.name = job.cloud.stem().string();
  round.cloud = compared.cloud;
  round.completeness = compared.completeness;
  round.deviation = compared.deviation;
  report.rounds.push_back(std::move(round));
  report.tables = {deviation_table(compared.deviation, job.options.deviation),
                   hole_table(compared.completeness)};
  report.charts = {deviation_chart(compared.deviation, job.options.deviation)};
  CompareOptions shown = job.options;
  report.options_json = json_of_options(describing(shown)).dump();
  return report;
}

}  // namespace

void describe(CompareOptions& options, OptionVisitor& visit) {
  SectionVisitor deviation("deviation", visit);
  describe(options.deviation, deviation);
  SectionVisitor completeness("completeness", visit);
  describe(options.completeness, completeness);
  visit.integer("samples", options.samples, {100, 5000000},
                "places of the surface that completeness is judged by");
}

ComparedCloud compare_cloud(const CompareJob& job, const Progress& progress) {
  Part part = part_of(job);
  const MeshFacts facts = facts_of(part.surface);
  CloudReader reader(job.cloud);
  ComparedCloud compared;
  compared.part = part.name;
  compared.remarks = remarks_on_surface(facts);
  compared.samples =
      sample_surface(part.surface, static_cast<std::size_t>(job.options.samples), part.regions, job.seed);
  const SurfaceTree tree(part.surface);
  CompletenessCount completeness(compared.samples, job.options.completeness);
  DeviationCount deviation(tree, part.regions, job.options.deviation);
  const double mm_each = job.unit ? mm_of(*job.unit) : 1;
  const bool keep = !job.out.empty() || !job.report.empty();
  std::vector<double> kept_mm;
  Eigen::AlignedBox3d box;
  double against = 0;  // share of the first piece's normals
  for (Cloud piece = reader.next(kPiece); piece.size() > 0; piece = reader.next(kPiece)) {
    scale_to_mm(piece, mm_each);
    if (job.without_normals) piece.normals.clear();
    if (compared.points == 0) against = share_against(piece, tree, job.options.deviation.within_mm);
    for (const Vec3& point : piece.points) box.extend(point);
    compared.points += piece.size();
    completeness.add(piece);
    const std::vector<double> mm = deviation.add(piece);
    if (keep) {
      append(compared.cloud, piece);
      kept_mm.insert(kept_mm.end(), mm.begin(), mm.end());
    }
    progress("comparing", compared.points, std::max(reader.points(), compared.points));
  }
  compared.not_finite = reader.not_finite();
  if (compared.points == 0) throw InputError(job.cloud.string(), "the cloud has not one finite point");
  const double diagonal_mm = box.diagonal().norm();
  constexpr double kOddAnyway = 100, kOddWhereNothingFits = 3;  // a small patch of a large part is no mistake
  check_size(job, diagonal_mm, facts, kOddAnyway);
  compared.completeness = completeness.finish();
  compared.deviation = deviation.finish();
  if (compared.deviation.whole.points == 0) check_size(job, diagonal_mm, facts, kOddWhereNothingFits);
  remark_on_place(job, compared);
  check_normals(job, against);
  compared.surface = std::move(part.surface);
  if (!keep) return compared;
  compared.deviation.mm = kept_mm;
  add_deviation(compared.cloud, std::move(kept_mm));
  if (!job.report.empty()) write_scan_report(job.report, report_of(compared, job));
  if (!job.out.empty()) write_cloud(job.out, compared.cloud);
  return compared;
}

nlohmann::ordered_json summary_of(const ComparedCloud& compared, const CompareJob& job) {
  CompareOptions shown = job.options;
  return {{"cloud", job.cloud.string()},
          {"part", compared.part},
          {"points", compared.points},
          {"not_finite", compared.not_finite},
          {"completeness", json_of(compared.completeness)},
          {"deviation", json_of(compared.deviation, job.options.deviation)},
          {"remarks", compared.remarks},
          {"seed", job.seed},
          {"options", json_of_options(describing(shown))}};
}

}  // namespace asterism
