// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/robustness_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

using Value = ReportTable::Value;

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

Value number(std::size_t count) { return static_cast<double>(count); }

Value if_any(bool any, double value) { return any && std::isfinite(value) ? Value(value) : Value(); }

/// A trade's rows of one speed and exposure, by rate.
std::span<const SpeedTradeRow> of_rates(const SpeedTrade& trade, std::size_t speed, std::size_t exposure) {
  const std::size_t rates = trade.options.rates_hz.size();
  const std::size_t at = (speed * trade.options.exposures_s.size() + exposure) * rates;
  return std::span(trade.rows).subspan(at, rates);
}

void add_point(ReportChart::Curve& curve, double x, const Outcome& outcome) {
  if (outcome.seen == 0) return;
  curve.x.push_back(x);
  curve.y.push_back(outcome.rms_mm());
}

ReportChart chart_of(std::string id, std::string title, std::string note, double tolerance_mm) {
  ReportChart chart;
  chart.id = std::move(id);
  chart.title = std::move(title);
  chart.note = std::move(note);
  chart.x_label = "fastest turning rate of the swing (°/s)";
  chart.y_label = "RMS error at the worst point (mm)";
  chart.log_y = true;
  chart.limits.emplace_back("tolerance", tolerance_mm);
  return chart;
}

}  // namespace

ReportTable robustness_table(const RobustnessTable& robustness) {
  ReportTable table;
  table.id = "robustness";
  table.title = "Faults and what becomes of the pose";
  table.note = fmt::format(
      "Kept: measured and right. Rough: farther off than {} mm or {}°, as its own covariance says it may be. "
      "Flagged: AMBIGUOUS, or PREDICTED by the filter. Too few seen: of the lost frames, those in which "
      "fewer than four targets were seen by both cameras. Too sure: farther off than one in a million honest "
      "poses would be. Silently wrong: too sure and beyond {} mm or {}°.",
      robustness.options.wrong_mm, robustness.options.wrong_deg, robustness.options.wrong_mm,
      robustness.options.wrong_deg);
  table.columns = {"fault",
                   "runs",
                   "frames",
                   "kept (%)",
                   "rough (%)",
                   "flagged (%)",
                   "lost (%)",
                   "too few seen (%)",
                   "too sure (frames)",
                   "silently wrong (frames)",
                   "RMS error (mm)",
                   "largest (mm)",
                   "NEES/6",
                   "inside 95 % (%)",
                   "filtered: carried on (%)",
                   "filtered: too sure or wrong (frames)"};
  for (const FaultOutcome& row : robustness.rows) {
    const Outcome& raw = row.measured;
    const Outcome& filtered = row.filtered;
    table.rows.push_back(
        {row.fault, number(row.runs), number(raw.frames), percent(raw.kept, raw.frames),
         percent(raw.rough, raw.frames), percent(raw.flagged, raw.frames), percent(raw.lost, raw.frames),
         percent(raw.blind, raw.frames), number(raw.too_sure), number(raw.wrong),
         if_any(raw.seen > 0, raw.rms_mm()), if_any(raw.seen > 0, raw.max_mm),
         if_any(raw.poses > 0, raw.nees_share()), if_any(raw.poses > 0, 100 * raw.inside_95_share()),
         percent(filtered.flagged, filtered.frames), number(filtered.too_sure + filtered.wrong)});
    const bool wrong = raw.wrong + filtered.wrong > 0;
    const bool sure = raw.too_sure + filtered.too_sure > 0;
    table.verdicts.push_back(wrong ? Verdict::Bad : sure ? Verdict::Attention : Verdict::Good);
  }
  return table;
}

ReportTable knock_table(const RobustnessTable& robustness) {
  ReportTable table;
  table.id = "knocks";
  table.title = "A knocked target found and named";
  table.note =
      "Named at once: frames with a pose that refused that target and no other. Found over the run: from all "
      "its frames the target was accused, alone and without a rival; undecided: it or another, which this "
      "layout cannot tell. Smallest knock: found four times in five in the direction that is hardest to see "
      "(Baarda's minimal detectable bias), with no more than one false accusation in a million runs. A run "
      "without a pose finds nothing.";
  table.columns = {"fault",
                   "runs",
                   "named at once (% of poses)",
                   "another named (frames)",
                   "found over the run",
                   "undecided",
                   "another accused",
                   "shift's error, χ²/3",
                   "smallest knock, one frame (mm)",
                   "smallest knock, whole run (mm)"};
  for (const FaultOutcome& row : robustness.rows) {
    if (row.knocks == 0 && row.named_wrong == 0 && row.accused_wrong == 0 && row.fault != "none") continue;
    const double found = static_cast<double>(row.found);
    table.rows.push_back(
        {row.fault, number(row.runs), row.knocks > 0 ? Value(percent(row.named, row.measured.seen)) : Value(),
         number(row.named_wrong), row.knocks > 0 ? number(row.found) : Value(), number(row.undecided),
         number(row.accused_wrong), if_any(row.found > 0, row.shift_chi_square / 3 / found),
         if_any(true, row.detectable_at_once_mm), if_any(true, row.detectable_mm)});
    table.verdicts.push_back(row.accused_wrong > 0    ? Verdict::Bad
                             : row.found < row.knocks ? Verdict::Attention
                                                      : Verdict::Good);
  }
  return table;
}

ReportTable speed_trade_table(const SpeedTrade& trade) {
  ReportTable table;
  table.id = "speed_trade";
  table.title = "Error over turning rate, exposure and frame rate";
  table.note = fmt::format(
      "The body swings by up to {}° about the platform's x axis, the given rate at its fastest; half of the "
      "frames are about that moment, half about the turning point, where it gains speed fastest. Errors are "
      "RMS at the worst point. A target keeps its brightness whatever the exposure. A streak longer than "
      "{:.0f} % of a target's diameter counts as not found.",
      trade.options.swing_deg, 100 * trade.options.longest_streak);
  table.columns = {"turning rate (°/s)", "exposure (ms)", "streak (px)",
                   "centre sigma (px)",  "raw poses (%)", "raw error (mm)"};
  for (const double rate : trade.options.rates_hz)
    table.columns.push_back(fmt::format("filtered at {} Hz (mm)", rate));
  table.columns.push_back("filtered: too sure or wrong (frames)");
  for (std::size_t s = 0; s < trade.options.speeds_deg_s.size(); ++s) {
    for (std::size_t e = 0; e < trade.options.exposures_s.size(); ++e) {
      const auto rows = of_rates(trade, s, e);
      const SpeedTradeRow& last = rows.back();
      const Outcome& raw = last.measured;
      std::size_t faults = 0;
      std::vector<Value> cells = {last.speed_deg_s,
                                  1000 * last.exposure_s,
                                  if_any(raw.seen > 0, last.streak_px),
                                  if_any(raw.seen > 0, last.sigma_px),
                                  percent(raw.seen, raw.frames),
                                  if_any(raw.seen > 0, raw.rms_mm())};
      for (const SpeedTradeRow& row : rows) {
        cells.push_back(if_any(row.filtered.seen > 0, row.filtered.rms_mm()));
        faults += row.filtered.too_sure + row.filtered.wrong;
      }
      cells.push_back(number(faults));
      table.rows.push_back(std::move(cells));
      table.verdicts.push_back(faults > 0      ? Verdict::Attention
                               : raw.seen == 0 ? Verdict::Plain
                                               : Verdict::Good);
    }
  }
  return table;
}

ReportTable streak_table(const SpeedTrade& trade) {
  ReportTable table;
  table.id = "streaks";
  table.title = "Centres of targets that move while they are exposed";
  table.note =
      "Images of the swing, detected, beside the truth at the middle of the exposure. Model: the errors at "
      "rest, grown as the Cramér–Rao bound of a smeared disc grows.";
  table.columns = {"streak (px)",      "exposure (ms)",     "found (%)",
                   "error along (px)", "error across (px)", "stated sigma (px)",
                   "NEES/2",           "model along (px)",  "model across (px)"};
  for (const StreakCheck& check : trade.checks) {
    const bool any = check.found > 0;
    table.rows.push_back({check.streak_px, 1000 * check.exposure_s, percent(check.found, check.shown),
                          if_any(any, check.along_px), if_any(any, check.across_px),
                          if_any(any, check.stated_px), if_any(any, check.nees_share), check.model_along_px,
                          check.model_across_px});
  }
  return table;
}

std::vector<ReportChart> speed_trade_charts(const SpeedTrade& trade, double tolerance_mm) {
  ReportChart raw =
      chart_of("trade_exposure", "Raw error over turning rate and exposure",
               "Where a curve ends, the targets are smeared too far to be found.", tolerance_mm);
  const auto& exposures = trade.options.exposures_s;
  for (std::size_t e = 0; e < exposures.size(); ++e) {
    ReportChart::Curve curve;
    curve.name = fmt::format("{} ms", 1000 * exposures[e]);
    for (std::size_t s = 0; s < trade.options.speeds_deg_s.size(); ++s)
      add_point(curve, trade.options.speeds_deg_s[s], of_rates(trade, s, e).back().measured);
    raw.curves.push_back(std::move(curve));
  }
  const std::size_t shown = std::min<std::size_t>(1, exposures.size() - 1);
  ReportChart filtered =
      chart_of("trade_rate", "Filtered error over turning rate and frame rate",
               fmt::format("At an exposure of {} ms.", 1000 * exposures[shown]), tolerance_mm);
  for (std::size_t r = 0; r < trade.options.rates_hz.size(); ++r) {
    ReportChart::Curve curve;
    curve.name = fmt::format("filtered, {} Hz", trade.options.rates_hz[r]);
    for (std::size_t s = 0; s < trade.options.speeds_deg_s.size(); ++s)
      add_point(curve, trade.options.speeds_deg_s[s], of_rates(trade, s, shown)[r].filtered);
    filtered.curves.push_back(std::move(curve));
  }
  ReportChart::Curve dashed = raw.curves[shown];
  dashed.name = "raw";
  dashed.dashed = true;
  filtered.curves.push_back(std::move(dashed));
  return {raw, filtered};
}

}  // namespace asterism
