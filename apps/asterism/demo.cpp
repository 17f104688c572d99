// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/demo.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

nlohmann::ordered_json json_of(const DemoResult& result) {
  nlohmann::ordered_json json = {
      {"cell", result.cell},
      {"frames", result.simulated.frames},
      {"simulating_s", result.simulating_s},
      {"tracking_s", result.tracking_s},
      {"verifying_s", result.verifying_s},
      {"verdict", {{"pass", result.verdict.pass}, {"words", result.verdict.words}}},
      {"layouts", result.layouts},
      {"scanning_s", result.scanning_s},
      {"report", result.report.string()},
      {"cell_page", result.cell_page.string()},
      {"layout_page", result.layout_page.string()},
      {"tracking_page", result.tracking_page.string()}};
  for (const SummaryRow& row : result.summary) {
    json["summary"].push_back(
        {{"what", row.label}, {"value", row.value}, {"unit", row.unit}, {"definition", row.note}});
  }
  for (const ScanRound& round : result.scans) {
    nlohmann::ordered_json scans = {{"round", round.name},
                                    {"plan", round.plan.in_words},
                                    {"views", round.plan.views.size()},
                                    {"points", round.fused.cloud.size()}};
    if (round.fused.completeness) scans["measured"] = round.fused.completeness->share();
    json["rounds"].push_back(scans);
  }
  for (const PoseErrors& errors : result.errors) {
    nlohmann::ordered_json body = {{"body", errors.body},
                                   {"found", errors.found()},
                                   {"wrong", errors.wrong},
                                   {"translation_rms_mm", errors.translation_mm.rms},
                                   {"translation_max_mm", errors.translation_mm.max},
                                   {"rotation_rms_deg", errors.rotation_deg.rms},
                                   {"rotation_max_deg", errors.rotation_deg.max}};
    if (errors.honesty) body["nees_over_six"] = errors.honesty->mean_nees / 6;
    json["bodies"].push_back(body);
  }
  return json;
}

std::string text_of(const DemoResult& result) {
  std::string text = fmt::format(
      "\n{}: {} stereo frames simulated in {:.1f} s, tracked in {:.1f} s; verified in {:.1f} s\n\n",
      result.cell, result.simulated.frames, result.simulating_s, result.tracking_s, result.verifying_s);
  text += fmt::format("  {:<10} {:>9} {:>6} {:>20} {:>20} {:>8}\n", "body", "poses", "wrong",
                      "translation mm", "rotation deg", "NEES/6");
  text += fmt::format("  {:<10} {:>9} {:>6} {:>20} {:>20} {:>8}\n", "", "", "", "RMS      max",
                      "RMS      max", "");
  for (const PoseErrors& e : result.errors) {
    text += fmt::format("  {:<10} {:>9} {:>6} {:>11.4f} {:>8.4f} {:>11.5f} {:>8.5f} {:>8}\n", e.body,
                        fmt::format("{}/{}", e.found(), e.truth_frames), e.wrong.size(), e.translation_mm.rms,
                        e.translation_mm.max, e.rotation_deg.rms, e.rotation_deg.max,
                        e.honesty ? fmt::format("{:.2f}", e.honesty->mean_nees / 6) : "");
  }
  text += fmt::format(
      "\n  translation at the targets' centroid; NEES/6 = 1: the stated covariance is honest\n\n"
      "  the cell in motion: {}\n\n",
      result.verdict.words);
  for (const ScanRound& round : result.scans) {
    text += fmt::format("  {}: {}, planned in {:.1f} s; {} points in the cloud{}\n", round.name,
                        round.plan.in_words, round.planning_s, round.fused.cloud.size(),
                        round.fused.completeness ? fmt::format(", {:.1f} % of the surface measured",
                                                               100 * round.fused.completeness->share())
                                                 : "");
  }
  text += "\n";
  for (const SummaryRow& row : result.summary) {
    text += fmt::format("  {:<30} {:>9} {:<24}\n", row.label, row.value, row.unit);
  }
  return text + fmt::format("\n  report: {}\n  the cell in motion: {}\n  layouts: {}\n  frame by frame: {}\n",
                            result.report.string(), result.cell_page.string(), result.layout_page.string(),
                            result.tracking_page.string());
}

void run(const DemoJob& job, const Common& common) {
  DemoJob seeded = job;
  seeded.seed = common.seed;
  const DemoResult result = run_demo(seeded, make_progress(common));
  print_result(common, json_of(result), text_of(result));
}

}  // namespace

void add_demo(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "demo", "The whole story on the built-in cell; needs no input",
                  "asterism demo --out out/demo");
  auto job = std::make_shared<DemoJob>();
  job->out = "out/demo";
  command->add_flag("--quick", job->quick, "a fifth of the frames, few disturbances, no faults");
  command->add_option("--out", job->out, "folder of the results")->capture_default_str();
  on_call(*command, common, [=, &common] { run(*job, common); });
}

}  // namespace asterism::app
