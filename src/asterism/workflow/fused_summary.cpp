// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/io/options_file.hpp"
#include "asterism/workflow/cloud_tables.hpp"
#include "asterism/workflow/fuse_scans.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Registration& found) {
  return {{"pairs", found.pairs},
          {"shift_mm", found.shift_mm},
          {"turn_deg", found.turn_deg},
          {"chi2", found.chi2},
          {"degrees_of_freedom", found.degrees},
          {"disagrees", found.disagrees},
          {"before_mm", found.before_mm},
          {"rms_mm", found.rms_mm},
          {"not_determined", found.free}};
}

Json json_of(const FusedScanRow& row) {
  Json json = {{"scan", row.scan},
               {"file", row.file},
               {"body", row.body},
               {"points", row.points},
               {"used", row.used},
               {"not_finite", row.not_finite},
               {"outliers", row.outliers},
               {"no_pose", row.no_pose},
               {"outside_run", row.outside_run},
               {"gap", row.gap},
               {"pose_sigma_mm", row.sigma_mm}};
  if (row.by_shape) json["registration"] = json_of(*row.by_shape);
  return json;
}

/// Sums over all scans.
struct Totals {
  std::size_t points = 0, not_finite = 0, outliers = 0, no_pose = 0, outside_run = 0, gap = 0, used = 0;
};
Totals totals_of(const FusedScans& fused) {
  Totals totals;
  for (const FusedScanRow& row : fused.scans) {
    totals.points += row.points;
    totals.not_finite += row.not_finite;
    totals.outliers += row.outliers;
    totals.no_pose += row.no_pose;
    totals.outside_run += row.outside_run;
    totals.gap += row.gap;
    totals.used += row.used;
  }
  return totals;
}

double rms_of(const std::vector<double>* values) {
  if (values == nullptr || values->empty()) return 0;
  double sum = 0;
  for (const double value : *values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values->size()));
}

}  // namespace

void describe(FuseScansOptions& options, OptionVisitor& visit) {
  const auto part = [&](const char* name, auto& inner) {
    SectionVisitor section(name, visit);
    describe(inner, section);
  };
  part("carrying", options.carrying);
  part("surface", options.surface);
  part("fusion", options.fusion);
  part("registration", options.registration);
  part("completeness", options.completeness);
  part("deviation", options.deviation);
  visit.integer("samples", options.samples, {100, 1000000},
                "places of the surface that completeness is judged by");
}

nlohmann::ordered_json summary_of(const FusedScans& fused, const FuseScansJob& job) {
  const Totals totals = totals_of(fused);
  FuseScansOptions options = job.options;
  Json json = {{"schema", "asterism-fusion/1"},
               {"frame", fused.frame},
               {"cloud", job.out.filename().string()},
               {"points", fused.cloud.size()},
               {"points_read", totals.points},
               {"points_used", fused.fused.points_in},
               {"left_out",
                {{"not_finite", totals.not_finite},
                 {"no_pose", totals.no_pose},
                 {"outside_run", totals.outside_run},
                 {"gap", totals.gap},
                 {"outliers_in_scan", totals.outliers},
                 {"outliers_in_voxel", fused.fused.outliers},
                 {"few_in_voxel", fused.fused.few}}},
               {"sigma_rms_mm", rms_of(fused.cloud.field("sigma_mm"))},
               {"agreement",
                {{"shared_voxels", fused.fused.shared},
                 {"disagreement", fused.fused.disagreement},
                 {"apart_mm", fused.fused.apart_mm},
                 {"stated_mm", fused.fused.stated_mm}}},
               {"scanner",
                {{"depth_sigma_mm", fused.scanner.depth_sigma_mm},
                 {"lateral_sigma_mm", fused.scanner.lateral_sigma_mm},
                 {"stand_off_mm", fused.scanner.stand_off_mm},
                 {"pose_sigma_mm", fused.pose_sigma_mm}}},
               {"remarks", fused.remarks}};
  for (const FusedScanRow& row : fused.scans) json["scans"].push_back(json_of(row));
  if (fused.completeness) json["completeness"] = json_of(*fused.completeness);
  if (fused.deviation) json["deviation"] = json_of(*fused.deviation, job.options.deviation);
  json["options"] = json_of_options(describing(options));
  return json;
}

std::vector<SummaryRow> summary_rows_of(const FusedScans& fused) {
  const Totals totals = totals_of(fused);
  std::vector<SummaryRow> rows = {
      {"Points of the cloud", fmt::format("{}", fused.cloud.size()), "",
       fmt::format("of {} measured in {} scans", totals.used, fused.scans.size()), Verdict::Plain},
      {"Uncertainty of a point, predicted", fmt::format("{:.4f}", rms_of(fused.cloud.field("sigma_mm"))),
       "mm RMS", "one standard deviation along the normal", Verdict::Plain}};
  const std::size_t left_out = totals.no_pose + totals.outside_run + totals.gap;
  rows.push_back({"Left out for want of a pose", fmt::format("{}", left_out), "points",
                  "nothing is extrapolated", left_out > 0 ? Verdict::Attention : Verdict::Good});
  rows.push_back({"Outliers", fmt::format("{}", totals.outliers + fused.fused.outliers), "points",
                  "refused by their own scan's neighbours or by other scans", Verdict::Plain});
  if (const auto& completeness = fused.completeness) {
    rows.push_back({"Surface measured", fmt::format("{:.1f}", 100 * completeness->share()), "%",
                    fmt::format("{} holes", completeness->holes.size()), Verdict::Plain});
  }
  if (const auto& deviation = fused.deviation) {
    rows.push_back(
        {"Deviation from the surface", fmt::format("{:.4f}", deviation->whole.rms_mm), "mm RMS",
         fmt::format("predicted from the points' covariances: {:.4f}", deviation->whole.predicted_rms_mm),
         Verdict::Plain});
  }
  return rows;
}

std::string text_of(const FusedScans& fused) {
  std::string text = fmt::format("{} points in the frame of {}\n\n", fused.cloud.size(), fused.frame);
  for (const SummaryRow& row : summary_rows_of(fused)) {
    text += fmt::format("  {:<36} {:>10} {:<7} {}\n", row.label, row.value, row.unit, row.note);
  }
  text += fmt::format("\n  {:>5} {:>9} {:>9} {:>8} {:>8} {:>9}\n", "scan", "points", "used", "no pose",
                      "outlier", "pose mm");
  for (const FusedScanRow& row : fused.scans) {
    text += fmt::format("  {:>5} {:>9} {:>9} {:>8} {:>8} {:>9.4f}\n", row.scan, row.points, row.used,
                        row.no_pose + row.outside_run + row.gap, row.outliers, row.sigma_mm);
  }
  if (fused.completeness && !fused.completeness->holes.empty()) {
    text += "\n  largest holes: area mm², centre\n";
    constexpr std::size_t kShown = 5;
    for (std::size_t i = 0; i < std::min(kShown, fused.completeness->holes.size()); ++i) {
      const Hole& hole = fused.completeness->holes[i];
      text += fmt::format("  {:>10.0f}  ({:.0f}, {:.0f}, {:.0f})\n", hole.area_mm2, hole.centre.x(),
                          hole.centre.y(), hole.centre.z());
    }
  }
  for (const std::string& remark : fused.remarks) text += fmt::format("\n  {}\n", remark);
  return text;
}

}  // namespace asterism
