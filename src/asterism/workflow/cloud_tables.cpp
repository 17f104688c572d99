// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/cloud_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;
using Value = ReportTable::Value;

Value rounded(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const DeviationSummary& summary) {
  Json json = {{"points", summary.points}, {"beyond", summary.beyond}};
  if (!summary.region.empty()) json["region"] = summary.region;
  if (summary.points == 0) return json;
  json.update({{"mean_mm", summary.mean_mm},
               {"rms_mm", summary.rms_mm},
               {"sigma_mm", summary.sigma_mm},
               {"p05_mm", summary.p05_mm},
               {"median_mm", summary.median_mm},
               {"p95_mm", summary.p95_mm},
               {"lowest_mm", summary.lowest_mm},
               {"highest_mm", summary.highest_mm},
               {"in_tolerance", summary.in_tolerance},
               {"below", summary.below},
               {"above", summary.above}});
  if (summary.predicted_rms_mm > 0) json["predicted_rms_mm"] = summary.predicted_rms_mm;
  return json;
}

std::vector<Value> row_of(const DeviationSummary& summary, bool predicted) {
  std::vector<Value> row = {summary.region.empty() ? "whole" : summary.region,
                            static_cast<double>(summary.points), static_cast<double>(summary.beyond)};
  const bool any = summary.points > 0;
  const auto add = [&](double value, int decimals) {
    row.push_back(any ? rounded(value, decimals) : Value{});
  };
  add(summary.mean_mm, 4);
  add(summary.sigma_mm, 4);
  add(summary.rms_mm, 4);
  if (predicted) row.push_back(summary.predicted_rms_mm > 0 ? rounded(summary.predicted_rms_mm, 4) : Value{});
  add(summary.p05_mm, 4);
  add(summary.median_mm, 4);
  add(summary.p95_mm, 4);
  add(100 * summary.in_tolerance, 2);
  return row;
}

}  // namespace

ReportTable deviation_table(const Deviation& deviation, const DeviationOptions& options) {
  ReportTable table;
  table.id = "deviation";
  table.title = "Deviation from the surface, outside positive";
  table.note = fmt::format("Points farther off than {:g} mm are counted and left out.", options.within_mm);
  const bool predicted = deviation.whole.predicted_rms_mm > 0;
  table.columns = {"region", "points", "beyond", "mean (mm)", "sigma (mm)", "RMS (mm)"};
  if (predicted) table.columns.emplace_back("predicted RMS (mm)");
  for (const char* name : {"5 % (mm)", "median (mm)", "95 % (mm)"}) table.columns.emplace_back(name);
  table.columns.push_back(fmt::format("within ±{:g} mm (%)", options.tolerance_mm));
  table.rows.push_back(row_of(deviation.whole, predicted));
  for (const DeviationSummary& region : deviation.regions) table.rows.push_back(row_of(region, predicted));
  return table;
}

ReportTable hole_table(const Completeness& completeness, std::size_t most) {
  ReportTable table;
  table.id = "holes";
  table.title = "Areas that are missing";
  table.columns = {"area (mm²)", "share (%)", "across (mm)", "centre (mm)", "faces"};
  const std::size_t shown = std::min(most, completeness.holes.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Hole& hole = completeness.holes[i];
    const Vec3 &c = hole.centre, &n = hole.normal;
    table.rows.push_back(
        {rounded(hole.area_mm2, 0), rounded(100 * hole.area_mm2 / completeness.surface_mm2, 2),
         rounded(hole.across_mm, 0), fmt::format("{:.0f} {:.0f} {:.0f}", c.x(), c.y(), c.z()),
         n.isZero() ? "all ways" : fmt::format("{:.2f} {:.2f} {:.2f}", n.x(), n.y(), n.z())});
  }
  if (shown < completeness.holes.size()) {
    table.note = fmt::format("The largest {} of {}.", shown, completeness.holes.size());
  }
  return table;
}

ReportChart deviation_chart(const Deviation& deviation, const DeviationOptions& options) {
  ReportChart chart;
  chart.id = "deviation";
  chart.title = "Deviation from the surface";
  chart.note = fmt::format("{:.2f} % of the points lie within ±{:g} mm.", 100 * deviation.whole.in_tolerance,
                           options.tolerance_mm);
  chart.x_label = "deviation (mm)";
  chart.y_label = "share of the points (%)";
  ReportChart::Curve& curve = chart.curves.emplace_back();
  curve.name = "points";
  const auto count = static_cast<double>(std::max<std::size_t>(deviation.whole.points, 1));
  for (std::size_t bin = 0; bin < deviation.histogram.size(); ++bin) {
    curve.x.push_back((static_cast<double>(bin) + 0.5) * deviation.bin_mm - options.histogram_mm);
    curve.y.push_back(100 * static_cast<double>(deviation.histogram[bin]) / count);
  }
  return chart;
}

Json json_of(const Deviation& deviation, const DeviationOptions& options) {
  Json json = json_of(deviation.whole);
  json["tolerance_mm"] = options.tolerance_mm;
  json["within_mm"] = options.within_mm;
  json["histogram"] = {
      {"from_mm", -options.histogram_mm}, {"bin_mm", deviation.bin_mm}, {"counts", deviation.histogram}};
  json["regions"] = Json::array();
  for (const DeviationSummary& region : deviation.regions) json["regions"].push_back(json_of(region));
  return json;
}

Json json_of(const Completeness& completeness) {
  Json json = {{"share", completeness.share()},
               {"surface_mm2", completeness.surface_mm2},
               {"measured_mm2", completeness.measured_mm2},
               {"holes", Json::array()}};
  for (const Hole& hole : completeness.holes) {
    json["holes"].push_back({{"area_mm2", hole.area_mm2},
                             {"across_mm", hole.across_mm},
                             {"centre_mm", json_of(hole.centre)},
                             {"normal", json_of(hole.normal)}});
  }
  return json;
}

}  // namespace asterism
