// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_story_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Rotation and translation of the platform in the dynamic scan.
void add_pose_rows(const HeadlineFigures& headline, std::vector<SummaryRow>& rows) {
  if (headline.errors.empty()) return;
  const PoseErrors& platform = headline.errors.front();
  rows.push_back(
      {"Rotation error, " + platform.body, fmt::format("{:.4f}", platform.rotation_deg.mean), "° mean",
       fmt::format("angle between measured and true attitude, {} frames of the moving cell, images; "
                   "the paper: 0.035° (0.055° without its targets), 50 simulated disturbances",
                   platform.found()),
       Verdict::Plain});
  rows.push_back(
      {"Translation error, " + platform.body, fmt::format("{:.4f}", platform.translation_mm.mean), "mm mean",
       "distance at the targets' centroid, the same frames; the paper: 0.162 mm (0.31 mm without), "
       "in its Table 13 0.099 mm",
       Verdict::Plain});
}

void add_coverage_rows(std::span<const ScanRound> rounds, std::vector<SummaryRow>& rows) {
  const auto share = [](const ScanRound& round, double area_mm2) {
    return 100 * area_mm2 / round.plan.surface_mm2;
  };
  const ScanRound& last = rounds.back();
  if (!last.fused.completeness) return;
  const double measured = 100 * last.fused.completeness->share();
  const double coverable = share(last, last.plan.coverable_mm2);
  std::string before;
  for (const ScanRound& round : rounds.first(rounds.size() - 1)) {
    if (round.fused.completeness)
      before += fmt::format("; with the {} {:.1f} %", round.name, 100 * round.fused.completeness->share());
  }
  rows.push_back(
      {"Surface measured", fmt::format("{:.1f}", measured), "% of the whole surface",
       fmt::format("area with three points or more within 5 mm; {:.1f} % can be measured in this cell, "
                   "{:.1f} % from anywhere{}; the paper tells no figure, its Fig. 26 calls it complete",
                   coverable, share(last, last.plan.reachable_mm2), before),
       measured >= 0.97 * coverable ? Verdict::Good : Verdict::Attention});
}

void add_efficiency_rows(std::span<const ScanRound> rounds, const HeadlineFigures& headline,
                         std::vector<SummaryRow>& rows) {
  const ScanPlan& plan = rounds.front().plan;
  rows.push_back({"Views, platform at rest", fmt::format("{}", plan.views.size()), "views",
                  fmt::format("{}; greedy choice: {}", plan.in_words, plan.greedy_views),
                  plan.optimal ? Verdict::Good : Verdict::Plain});
  if (!headline.rings || headline.rings->views.empty()) return;
  const std::size_t stations = headline.rings->views.size();
  const auto needed = views_for_area(rounds, headline.rings->covered_mm2);
  if (!needed) return;
  rows.push_back(
      {"Scanning efficiency",
       fmt::format("{:.0f}", 100.0 * (static_cast<double>(stations) / static_cast<double>(*needed) - 1)),
       "% gained",
       fmt::format("stations on rings that add anything in this cell ({}, {:.0f} % of the surface) over the "
                   "planned views "
                   "that measure as much ({}), "
                   "less 1; the paper: 33.3 %, 96 stations over 72",
                   stations, 100 * headline.rings->covered_mm2 / headline.rings->surface_mm2, *needed),
       Verdict::Plain});
}

void add_cloud_rows(const ScanRound& last, double tolerance_mm, std::vector<SummaryRow>& rows) {
  if (!last.fused.deviation) return;
  const DeviationSummary& whole = last.fused.deviation->whole;
  const double ratio = whole.rms_mm / whole.predicted_rms_mm;
  rows.push_back({"Cloud off the true surface", fmt::format("{:.4f}", whole.rms_mm), "mm RMS",
                  fmt::format("signed distance of {} points; predicted from their covariances {:.4f} mm",
                              whole.points, whole.predicted_rms_mm),
                  ratio <= 1.1 ? Verdict::Good : Verdict::Attention});
  rows.push_back(
      {"Within tolerance", fmt::format("{:.2f}", 100 * whole.in_tolerance), "% of the points",
       fmt::format("±{:g} mm; the part is true to its drawing here, so this is the cloud's own error",
                   tolerance_mm),
       Verdict::Plain});
}

}  // namespace

std::optional<std::size_t> views_for_area(std::span<const ScanRound> rounds, double area_mm2) {
  if (rounds.empty()) return std::nullopt;
  const auto& samples = rounds.front().plan.samples;
  std::vector<const PlannedView*> views;
  for (const ScanRound& round : rounds) {
    require(round.plan.samples.size() == samples.size(), "the rounds' plans have the same samples");
    for (const PlannedView& view : round.plan.views) views.push_back(&view);
  }
  std::vector<std::uint8_t> measured(samples.size(), 0);
  double covered = 0;
  std::size_t taken = 0;
  for (; covered < area_mm2; ++taken) {
    double most = 0;
    const PlannedView* best = nullptr;
    for (const PlannedView* view : views) {
      double area = 0;
      for (const std::uint32_t sample : view->measures) {
        if (measured[sample] == 0) area += samples[sample].area_mm2;
      }
      if (area > most) most = area, best = view;
    }
    if (best == nullptr) return std::nullopt;
    for (const std::uint32_t sample : best->measures) measured[sample] = 1;
    covered += most;
  }
  return taken;
}

std::vector<SummaryRow> story_rows(std::span<const ScanRound> rounds, const HeadlineFigures& headline,
                                   double tolerance_mm) {
  std::vector<SummaryRow> rows;
  add_pose_rows(headline, rows);
  if (headline.least_coverage) {
    rows.push_back(
        {"Field-of-view coefficient", fmt::format("{:.2f}", *headline.least_coverage), "at least",
         "cosine between the platform's axis and the line of sight over the motion (the paper's Fig. "
         "20, undefined there); the paper: always above 0.6",
         *headline.least_coverage > 0.6 ? Verdict::Good : Verdict::Attention});
  }
  if (rounds.empty()) return rows;
  add_efficiency_rows(rounds, headline, rows);
  add_coverage_rows(rounds, rows);
  add_cloud_rows(rounds.back(), tolerance_mm, rows);
  return rows;
}

ScanReport story_report(const Cell& cell, std::span<const ScanRound> rounds,
                        const HeadlineFigures& headline) {
  ScanReport report;
  report.title = "Demo: " + cell.name;
  report.scanner = *cell.scanner;
  report.part = cell.workpiece->name;
  report.surface = *cell.workpiece->surface;
  report.view_s = cell.scan_task.view_s;
  report.turn_s = cell.scan_task.turn_s;
  std::size_t views = 0;
  for (const ScanRound& round : rounds) {
    views += round.plan.views.size();
    report.samples = round.fused.samples;
    report.rounds.push_back(
        {round.name, round.plan, round.fused.cloud, round.fused.completeness, round.fused.deviation});
  }
  if (!rounds.empty()) {
    for (const std::string& remark : rounds.back().fused.remarks) report.remarks.push_back(remark);
  }
  report.subtitle = fmt::format(
      "from where to scan, what the scans came to, what was missing, the platform turned for it: {} views in "
      "{} rounds",
      views, rounds.size());
  report.tolerance_mm = DeviationOptions{}.tolerance_mm;
  report.summary = story_rows(rounds, headline, report.tolerance_mm);
  return report;
}

}  // namespace asterism
