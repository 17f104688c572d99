// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/scan_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/report/cell_json.hpp"
#include "asterism/report/page.hpp"
#include "asterism/report/page_json.hpp"
#include "asterism/report/scan_json.hpp"

namespace asterism {
namespace {

using Json = nlohmann::json;

std::size_t most_drawn(const ScanReport& report) {
  const auto clouds = std::count_if(report.rounds.begin(), report.rounds.end(),
                                    [](const auto& round) { return round.cloud.has_value(); });
  const std::size_t share = kMostDrawn / static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, clouds));
  return std::min(share, kMostDrawnARound);
}

Json of_round(const ScanReport::Round& round, const ScanReport& report, SampleLists& lists) {
  require(!round.deviation || (round.cloud && round.deviation->mm.size() == round.cloud->size()),
          "a round has a deviation a point of its cloud");
  const std::vector<double> none;
  const std::vector<double>& deviation_mm = round.deviation ? round.deviation->mm : none;
  return {{"name", round.name},
          {"plan", round.plan ? json_of_plan(*round.plan, lists) : Json()},
          {"cloud", round.cloud ? json_of_cloud(*round.cloud, deviation_mm, most_drawn(report)) : Json()},
          {"completeness",
           round.completeness ? json_of_completeness(*round.completeness, report.samples, lists) : Json()},
          {"deviation", round.deviation ? json_of_deviation(*round.deviation) : Json()}};
}

Json of_surface(const ScanReport& report, std::vector<std::string>& remarks) {
  if (report.surface.triangles.empty()) return nullptr;
  return json_of_solid_view({report.part, "workpiece", -1, report.surface, {}}, remarks);
}

}  // namespace

std::string scan_report_json(const ScanReport& report) {
  std::vector<std::string> remarks = report.remarks;
  SampleLists lists;
  Json rounds = Json::array(), tables = Json::array(), charts = Json::array();
  for (const auto& round : report.rounds) rounds.push_back(of_round(round, report, lists));
  for (const auto& table : report.tables) tables.push_back(json_of_table(table));
  for (const auto& chart : report.charts) charts.push_back(json_of_chart(chart));
  Json links = Json::array();
  for (const auto& link : report.links) links.push_back({{"text", link.text}, {"href", link.href}});
  const Json surface = of_surface(report, remarks);
  const Json json = {{"schema", "asterism-scan-report/1"},
                     {"title", report.title},
                     {"subtitle", report.subtitle},
                     {"links", links},
                     {"summary", json_of_summary(report.summary)},
                     {"remarks", remarks},
                     {"scanner", json_of_scanner(report.scanner)},
                     {"surface", surface},
                     {"sample_lists", lists.json()},
                     {"rounds", rounds},
                     {"tolerance_mm", digits(report.tolerance_mm, 6)},
                     {"view_s", digits(report.view_s, 6)},
                     {"turn_s", digits(report.turn_s, 6)},
                     {"tables", tables},
                     {"charts", charts},
                     {"options", json_of_stored(report.options_json)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_scan_report(const std::filesystem::path& path, const ScanReport& report) {
  write_file(path, page_with_data(report_page(), scan_report_json(report)));
}

}  // namespace asterism
