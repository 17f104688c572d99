// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/fusion_tables.hpp"

#include <fmt/format.h>

#include <cmath>

namespace asterism {
namespace {

constexpr double kTooSure = 1.5;  // mean NEES over six above which a covariance is called too small
using Value = ReportTable::Value;

Value shown(double value) { return std::isfinite(value) ? Value(value) : Value(); }

Value percent(std::size_t part, std::size_t all) {
  return all == 0 ? Value() : Value(100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string assumption(const FusionStudy& study) {
  const ReadOut& model = study.read_out;
  return fmt::format(
      "The read-out is an assumption: noise {} ° about and {} mm along each axis{}, {} % jumps of {} to {} "
      "mm, "
      "{} readings a second. Filter: {:.1f} °/s and {:.1f} mm/s of wander a second; {} runs.",
      model.rotation_sigma_deg, model.translation_sigma_mm,
      model.correlation_s > 0 ? fmt::format(" that lasts {} s", model.correlation_s) : "",
      100 * model.jump_share, model.jump_low_mm, model.jump_high_mm, model.rate_hz,
      study.filter.rate_wander_deg_s, study.filter.speed_wander_mm_s, study.runs);
}

ReportTable cost_table(const FusionStudy& study) {
  ReportTable table;
  table.id = "fusion-cost";
  table.title = "Both cameras blind: without and with the platform's read-out";
  table.note = fmt::format(
      "Errors of {} at point {} while blind; all these poses are PREDICTED. NEES over six: 1 where the "
      "stated "
      "covariance holds, more where it is too sure. {}",
      study.body, study.point, assumption(study));
  table.columns = {"blind (s)",
                   "without: RMS (mm)",
                   "without: stated (mm)",
                   "without: NEES / 6",
                   "without: lost (%)",
                   "with: RMS (mm)",
                   "with: 95 % below (mm)",
                   "with: stated (mm)",
                   "with: NEES / 6",
                   "with: in own 95 % (%)",
                   "with: lost (%)",
                   "after: RMS without (mm)",
                   "after: RMS with (mm)",
                   "measured again after (s)"};
  for (const FusionSpell& spell : study.spells) {
    const FusionRoad& alone = spell.alone;
    const FusionRoad& with = spell.with_read_out;
    table.rows.push_back({spell.occlusion_s, shown(alone.rms_mm), shown(alone.stated_mm),
                          shown(alone.nees / 6), percent(alone.lost, alone.frames), shown(with.rms_mm),
                          shown(with.p95_mm), shown(with.stated_mm), shown(with.nees / 6),
                          shown(100 * with.in_95_percent), percent(with.lost, with.frames),
                          shown(alone.after_rms_mm), shown(with.after_rms_mm), with.back_s});
    const bool sound = with.lost == 0 && with.nees / 6 < kTooSure;
    table.verdicts.push_back(sound ? Verdict::Good : Verdict::Attention);
  }
  return table;
}

ReportTable offset_table(const FusionStudy& study) {
  const FusionOffset& offset = study.offset;
  ReportTable table;
  table.id = "fusion-offset";
  table.title = "How late the platform's read-out is, told from the motion";
  table.note = offset.untold.empty()
                   ? fmt::format("From each of {} runs, the frames with sight alone.", study.runs)
                   : fmt::format("{} of {} runs did not tell it: {}.", offset.untold.size(), study.runs,
                                 offset.untold.front());
  table.columns = {"true (ms)",          "told, mean (ms)", "stated σ (ms)",
                   "RMS error in its σ", "base: NEES / 6",  "runs"};
  if (offset.told == 0) {
    table.rows.push_back({1e3 * offset.true_s, Value(), Value(), Value(), Value(), 0.0});
    return table;
  }
  table.rows.push_back({1e3 * offset.true_s, 1e3 * offset.mean_s, 1e3 * offset.sigma_s, offset.rms_in_sigma,
                        offset.base_nees, static_cast<double>(offset.told)});
  return table;
}

ReportChart::Curve over_time(const std::string& name, const FusionStudy& study, const FusionRoad& road,
                             bool dashed) {
  return {name, study.times_s, road.by_frame_mm, road.low_mm, road.high_mm, dashed};
}

}  // namespace

std::vector<ReportTable> fusion_tables(const FusionStudy& study) {
  return {cost_table(study), offset_table(study)};
}

std::vector<ReportChart> fusion_charts(const FusionStudy& study, double tolerance_mm) {
  ReportChart time;
  time.id = "fusion-time";
  time.title =
      fmt::format("Both cameras blind for {} s from {} s on", study.drawn.occlusion_s, study.drawn.from_s);
  time.note = fmt::format("RMS error of {} runs at point {}, with the band that holds 95 % of them.",
                          study.runs, study.point);
  time.x_label = "time (s)";
  time.y_label = "error (mm)";
  time.log_y = true;
  time.curves = {over_time("tracker alone", study, study.drawn.alone, true),
                 over_time("with the platform's read-out", study, study.drawn.with_read_out, false)};
  time.limits = {{"tolerance", tolerance_mm}};

  ReportChart length;
  length.id = "fusion-length";
  length.title = "What an occlusion costs";
  length.note =
      "RMS error while blind of the poses there are; the tracker alone loses the body when it has "
      "coasted too long.";
  length.x_label = "blind (s)";
  length.y_label = "RMS error (mm)";
  length.log_x = length.log_y = true;
  length.curves = {{"tracker alone", {}, {}, {}, {}, true},
                   {"with the platform's read-out", {}, {}, {}, {}, false}};
  for (const FusionSpell& spell : study.spells) {
    for (ReportChart::Curve& curve : length.curves) curve.x.push_back(spell.occlusion_s);
    // Half lost is not a cost that can be told in mm.
    const bool lost = spell.alone.lost > 0;
    length.curves[0].y.push_back(lost ? std::nan("") : spell.alone.rms_mm);
    length.curves[1].y.push_back(spell.with_read_out.rms_mm);
  }
  length.limits = time.limits;
  return {time, length};
}

}  // namespace asterism
