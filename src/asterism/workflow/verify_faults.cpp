// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asterism/workflow/verify_cell.hpp"

namespace asterism {
namespace {

using Value = ReportTable::Value;

double count_of(std::size_t count) { return static_cast<double>(count); }

Value rounded(double value, int decimals) {
  if (!std::isfinite(value)) return std::monostate{};
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

std::vector<Value> row_of(const FaultOutcome& fault) {
  const Outcome& outcome = fault.measured;
  std::vector<Value> row = {fault.fault,
                            count_of(fault.runs),
                            count_of(outcome.frames),
                            count_of(outcome.kept + outcome.rough),
                            count_of(outcome.flagged),
                            count_of(outcome.lost),
                            count_of(outcome.too_sure),
                            count_of(outcome.wrong),
                            outcome.seen > 0 ? rounded(outcome.rms_mm(), 4) : Value(std::monostate{}),
                            outcome.seen > 0 ? rounded(outcome.max_mm, 4) : Value(std::monostate{})};
  std::string knocked;
  if (fault.knocks > 0) {
    knocked = fmt::format("named in {} of {} runs, in doubt in {}, another accused in {}", fault.found,
                          fault.knocks, fault.undecided, fault.accused_wrong);
  }
  row.emplace_back(knocked);
  row.emplace_back(fault.worst);
  return row;
}

/// A road's errors while blind and after.
std::vector<Value> row_of(double occlusion_s, const std::string& name, const FusionRoad& road) {
  return {rounded(occlusion_s, 3),       name,
          count_of(road.frames),         count_of(road.lost),
          rounded(road.rms_mm, 3),       rounded(road.p95_mm, 3),
          rounded(road.stated_mm, 3),    rounded(road.nees / 6, 3),
          rounded(road.after_rms_mm, 4), rounded(road.back_s, 3)};
}

std::string offset_words(const FusionOffset& offset) {
  if (offset.told == 0) return "The time offset between the two could not be told.";
  return fmt::format(
      "The time offset between the two, told from the frames with sight in {} runs: {:.5f} s with σ {:.5f} "
      "s, "
      "truly {:.5f} s; errors are {:.2f} of their σ.",
      offset.told, offset.mean_s, offset.sigma_s, offset.true_s, offset.rms_in_sigma);
}

}  // namespace

ReportTable table_of(const RobustnessTable& robustness) {
  ReportTable table{
      "faults",
      "Faults and what becomes of the pose",
      fmt::format(
          "Frames at the level of centres, {} of them a run; rows of lamps, backlight and glints are made of "
          "images. Kept: measured, and right or known to be rough; flagged: AMBIGUOUS or PREDICTED; too "
          "sure: right, but farther off than its covariance allows; wrong: farther off than {} mm or {}° "
          "and not known to be.",
          robustness.options.frames, robustness.options.wrong_mm, robustness.options.wrong_deg),
      {"fault", "runs", "frames", "kept", "flagged", "lost", "too sure", "wrong", "RMS (mm)", "max (mm)",
       "knocked target", "worst case"},
      {},
      {}};
  for (const FaultOutcome& fault : robustness.rows) {
    table.rows.push_back(row_of(fault));
    const bool wrong = fault.measured.wrong > 0 || fault.accused_wrong > 0;
    const bool less = fault.measured.lost + fault.measured.flagged + fault.measured.too_sure > 0;
    table.verdicts.push_back(wrong ? Verdict::Bad : less ? Verdict::Attention : Verdict::Good);
  }
  return table;
}

ReportTable table_of(const FusionStudy& fusion) {
  ReportTable table{
      "fusion",
      "Both cameras blind: with the tracker alone, and with the platform's read-out",
      fmt::format(
          "{} runs; errors at {}. The read-out's model is an assumption: {}° about each axis, {} mm along "
          "each, jumps in {} % of readings, {} Hz. {}",
          fusion.runs, fusion.point, fusion.read_out.rotation_sigma_deg, fusion.read_out.translation_sigma_mm,
          100 * fusion.read_out.jump_share, fusion.read_out.rate_hz, offset_words(fusion.offset)),
      {"occlusion (s)", "filter", "blind frames", "lost", "RMS (mm)", "95 % (mm)", "stated (mm)", "NEES / 6",
       "RMS after (mm)", "back after (s)"},
      {},
      {}};
  for (const FusionSpell& spell : fusion.spells) {
    table.rows.push_back(row_of(spell.occlusion_s, "tracker alone", spell.alone));
    table.rows.push_back(row_of(spell.occlusion_s, "with read-out", spell.with_read_out));
  }
  return table;
}

ReportChart chart_of(const FusionStudy& fusion) {
  ReportChart chart{
      "fusion-time",
      fmt::format("Through an occlusion of {} s", fusion.drawn.occlusion_s),
      fmt::format("RMS over {} runs and the band of 95 % of them, at {}. Both cameras are blind from "
                  "{:.2f} s on.",
                  fusion.runs, fusion.point, fusion.drawn.from_s),
      "time (s)",
      "error (mm)",
      false,
      true,
      {},
      {}};
  const auto add = [&](const std::string& name, const FusionRoad& road, bool dashed) {
    chart.curves.push_back({name, fusion.times_s, road.by_frame_mm, road.low_mm, road.high_mm, dashed});
  };
  add("tracker alone", fusion.drawn.alone, true);
  add("with read-out", fusion.drawn.with_read_out, false);
  return chart;
}

}  // namespace asterism
