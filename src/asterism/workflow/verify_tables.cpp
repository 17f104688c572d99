// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/workflow/fusion_tables.hpp"
#include "asterism/workflow/robustness_tables.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {
namespace {

using Value = ReportTable::Value;

Value rounded(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

std::string unit_of(RunQuantity quantity) { return quantity == RunQuantity::RotationDeg ? "deg" : "mm"; }

Value p_value(double p) { return p < 1e-4 ? Value("< 0.0001") : rounded(p, 4); }

/// "9 (5, 17, 18, …)"
std::string first_of(const std::vector<std::size_t>& frames) {
  constexpr std::size_t kShown = 6;
  if (frames.empty()) return "none";
  std::string text = fmt::format("{} (", frames.size());
  for (std::size_t i = 0; i < std::min(kShown, frames.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", frames[i]);
  return text + (frames.size() > kShown ? ", …)" : ")");
}

ReportTable agreement_table(const std::string& id, const std::string& title, const std::string& note,
                            const AccuracyAgreement& agreement) {
  ReportTable table{id,   title,
                    note, {"point", "simulated RMS (mm)", "predicted RMS (mm)", "simulated / predicted"},
                    {},   {}};
  for (const PointAgreement& point : agreement.points) {
    table.rows.push_back({point.point, rounded(point.simulated_mm, 5), rounded(point.predicted_mm, 5),
                          rounded(point.ratio(), 3)});
  }
  return table;
}

/// Whether the model holds, in words.
std::string nees_words(const NeesAgreement& nees) {
  if (nees.poses == 0) return "no pose to judge by";
  return fmt::format("NEES {:.2f} ({} in {:.2f} … {:.2f} that honest poses have)", nees.mean,
                     nees.honest() ? "is" : "is not", nees.band.low, nees.band.high);
}

std::string noise_note(const AccuracyAgreement& agreement) {
  std::string note = "Centres' noise alone; rig and targets known exactly. Against the prediction: " +
                     nees_words(agreement.predicted) +
                     "; against what the tracker states: " + nees_words(agreement.stated) + ".";
  note += " Frames where the errors contradict the prediction: " + first_of(agreement.outside) + ".";
  if (!agreement.other_targets.empty()) {
    note += " The tracker used more or fewer targets than predicted in frames " +
            first_of(agreement.other_targets) + ".";
  }
  if (!agreement.missed.empty())
    note += " No pose though one was predicted: " + first_of(agreement.missed) + ".";
  if (!agreement.unpredicted.empty())
    note += " A pose though none was predicted: " + first_of(agreement.unpredicted) + ".";
  return note;
}

std::string whole_note(const VerifiedCell& verified) {
  return fmt::format(
      "All sources: in each of {} repeats the rig, the map, the warmth and the latency are off by one draw "
      "of "
      "the noise model, so frames of a repeat share errors and the ratio is only as sharp as {} draws allow; "
      "the disturbance runs are sharper. Mean NEES {:.2f} against 6.",
      verified.repeats, verified.repeats, verified.agreement.predicted.mean);
}

/// Tables 13 and 14 of the paper: errors by layout, with intervals.
ReportTable sample_table(const LayoutComparison& comparison) {
  const std::string unit = unit_of(comparison.quantity);
  ReportTable table{
      fmt::format("runs-{}-{}", comparison.at_rest ? "rest" : "motion",
                  static_cast<int>(comparison.quantity)),
      fmt::format("Disturbance runs {}: {}", comparison.at_rest ? "at rest" : "over the motion",
                  text_of(comparison.quantity)),
      fmt::format("{} runs, then all {} runs in which every layout has a pose; 95 % intervals of the mean by "
                  "Student's t.{}",
                  comparison.first_runs, comparison.runs,
                  comparison.at_rest ? "" : " A run's error is the RMS over its moments."),
      {"layout", "mean", "max", "95 % low", "95 % high", "mean, all runs", "max, all runs", "95 % low, all",
       "95 % high, all"},
      {},
      {}};
  for (std::size_t i = 1; i < table.columns.size(); ++i) table.columns[i] += " (" + unit + ")";
  for (const SampleOfLayout& layout : comparison.layouts) {
    table.rows.push_back({layout.name, rounded(layout.first.mean, 5), rounded(layout.first.highest, 5),
                          rounded(layout.first_interval.low, 5), rounded(layout.first_interval.high, 5),
                          rounded(layout.all.mean, 5), rounded(layout.all.highest, 5),
                          rounded(layout.all_interval.low, 5), rounded(layout.all_interval.high, 5)});
  }
  return table;
}

/// Figure 24 and what the paper does not ask: how many runs would tell.
ReportTable pair_table(const LayoutComparison& comparison) {
  ReportTable table{
      fmt::format("pairs-{}-{}", comparison.at_rest ? "rest" : "motion",
                  static_cast<int>(comparison.quantity)),
      fmt::format("Is one layout better? {}, {}", text_of(comparison.quantity),
                  comparison.at_rest ? "at rest" : "over the motion"),
      fmt::format(
          "Paired t-tests under common random numbers, p made good for the number of pairs (Holm). "
          "Power: with which {} runs find the difference that all {} show; runs for 80 %: how many it "
          "would take.",
          comparison.first_runs, comparison.runs),
      {"pair", fmt::format("p, {} runs", comparison.first_runs),
       fmt::format("difference, all runs ({})", unit_of(comparison.quantity)), "p, all runs",
       fmt::format("power of {} runs", comparison.first_runs), "runs for 80 %", "verdict"},
      {},
      {}};
  for (const PairOfLayouts& pair : comparison.pairs) {
    const std::string& a = comparison.layouts[pair.a].name;
    const std::string& b = comparison.layouts[pair.b].name;
    const bool told = pair.all_p_holm < 0.05;
    const std::string verdict =
        !told ? "no difference shown" : fmt::format("{} is better", pair.all.difference < 0 ? a : b);
    table.rows.push_back(
        {a + " – " + b, p_value(pair.first_p_holm), rounded(pair.all.difference, 6), p_value(pair.all_p_holm),
         rounded(pair.power_of_first, 3),
         pair.runs_needed ? Value(static_cast<double>(*pair.runs_needed)) : Value(std::monostate{}),
         verdict});
    table.verdicts.push_back(told ? Verdict::Good : Verdict::Plain);
  }
  return table;
}

ReportTable budget_table(const VerifiedCell& verified) {
  const ErrorBudget& budget = verified.budget;
  ReportTable table{
      "budget",
      "Error budget at the worst point",
      fmt::format(
          "{} at {:.2f} s, first order through the estimator, each source by itself. Along the widest "
          "direction first order gives u = {:.5f} mm, {} draws with all sources (JCGM 101) {:.5f} mm{}: "
          "the first-order interval is {} (clause 8). |error| stays below {:.5f} mm with 95 %. The body "
          "grows about its fixed point, the part does not; latency is used as it is, not predicted away.",
          verified.body.points[verified.worst.point].name, verified.watched.times_s[verified.worst.frame],
          budget.first.uncertainty, budget.drawn.trials, budget.drawn.uncertainty,
          budget.drawn.stable ? "" : " (its second digit still moves)",
          budget.check.valid ? "confirmed" : "not confirmed; the draws count", budget.below_95_mm),
      {"source", "sigma (mm)", "bias (mm)", "share (%)"},
      {},
      {}};
  for (const BudgetShare& share : budget.shares) {
    table.rows.push_back({std::string(text_of(share.source)), rounded(share.sigma_mm, 5),
                          rounded(share.bias_mm.norm(), 5), rounded(100 * share.share, 2)});
  }
  table.rows.push_back({"all", rounded(budget.rms_mm, 5), std::monostate{}, 100.0});
  return table;
}

/// 95 % of a normal variable lie within so many sigmas; of a length in space fewer are enough.
constexpr double kNormal95 = 1.96;

ReportTable points_table(const VerifiedCell& verified) {
  ReportTable table{
      "points",
      "Errors at named points over the motion",
      fmt::format("Tolerance {} mm, the tracker's nominal accuracy {} mm. Predicted: √tr Σ of all "
                  "sources. Without targets: the platform's own read-out, an assumption (normal "
                  "noise and jumps as the paper's Figs. 21 and 22 draw them). Good: within tolerance with at "
                  "least 95 % probability at the worst moment; bad: the predicted RMS is beyond it, or more "
                  "than 1 % of the "
                  "simulated errors are.",
                  verified.tolerance_mm, verified.nominal_mm),
      {"point", "predicted RMS (mm)", "predicted worst (mm)", "simulated RMS (mm)", "simulated max (mm)",
       "without targets RMS (mm)", "without targets max (mm)"},
      {},
      {}};
  for (std::size_t i = 0; i < verified.body.points.size(); ++i) {
    const PredictedPoint& point = verified.predicted.points[i];
    double predicted = 0, worst = 0, determined = 0;
    for (std::size_t frame = 0; frame < point.covariance.size(); ++frame) {
      const auto error = point.error_mm(frame);
      if (error) predicted += *error * *error, worst = std::max(worst, *error), ++determined;
    }
    const VerifiedCell::Simulated& simulated = verified.simulated[i];
    std::vector<Value> row = {point.point.name, rounded(std::sqrt(predicted / determined), 5),
                              rounded(worst, 5)};
    if (simulated.poses > 0) {
      const double rms = std::sqrt(simulated.square_mm2 / static_cast<double>(simulated.poses));
      row.insert(row.end(), {rounded(rms, 5), rounded(simulated.largest_mm, 5)});
    } else {
      row.insert(row.end(), {std::monostate{}, std::monostate{}});
    }
    if (verified.read_out) {
      const ErrorSummary without = summary_of(verified.read_out->at_mm[i]);
      row.insert(row.end(), {rounded(without.rms, 4), rounded(without.max, 4)});
    } else {
      row.insert(row.end(), {std::monostate{}, std::monostate{}});
    }
    table.rows.push_back(row);
    const bool holds = worst <= verified.tolerance_mm && simulated.share_beyond() <= kMayLieBeyond;
    const bool surely = kNormal95 * worst <= verified.tolerance_mm;
    table.verdicts.push_back(!holds ? Verdict::Bad : surely ? Verdict::Good : Verdict::Attention);
  }
  return table;
}

}  // namespace

std::vector<ReportTable> tables_of(const VerifiedCell& verified) {
  std::vector<ReportTable> tables = {
      points_table(verified),
      agreement_table("roads-noise", "Predicted and simulated: noise", noise_note(verified.noise_agreement),
                      verified.noise_agreement),
      agreement_table("roads-all", "Predicted and simulated: all sources", whole_note(verified),
                      verified.agreement),
      budget_table(verified)};
  for (const LayoutComparison& comparison : verified.comparisons) {
    tables.push_back(sample_table(comparison));
    if (!comparison.pairs.empty()) tables.push_back(pair_table(comparison));
  }
  if (verified.robustness) {
    tables.push_back(robustness_table(*verified.robustness));
    tables.push_back(knock_table(*verified.robustness));
  }
  if (verified.fusion) {
    for (ReportTable& table : fusion_tables(*verified.fusion)) tables.push_back(std::move(table));
  }
  if (verified.speed) {
    tables.push_back(speed_trade_table(*verified.speed));
    if (!verified.speed->checks.empty()) tables.push_back(streak_table(*verified.speed));
  }
  return tables;
}

}  // namespace asterism
