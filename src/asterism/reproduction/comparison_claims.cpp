// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/comparison_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr double kAlpha = 0.05;

/// Length of a vector of three normals of 0.1 mm each (Maxwell's law): the reading of "translation error"
/// that needs no free parameter.
constexpr double kNoiseMm = 0.1;
const double kMaxwellMean = kNoiseMm * std::sqrt(8 / std::numbers::pi);
const double kMaxwellDeviation = kNoiseMm * std::sqrt(3 - 8 / std::numbers::pi);

std::string name_of(std::size_t scheme) { return fmt::format("S{}", scheme + 1); }

void add_intervals(std::vector<LedgerRow>& rows) {
  const Interval expected = mean_interval({printed::kRuns, kMaxwellMean, kMaxwellDeviation, 0, 0});
  const double error_of_mean = kMaxwellDeviation / std::sqrt(static_cast<double>(printed::kRuns));
  const double error_of_deviation = kMaxwellDeviation / std::sqrt(2.0 * (printed::kRuns - 1));
  for (std::size_t s = 0; s < 3; ++s) {
    const Summary sample = sample_of_table14(s);
    const bool maxwell = std::abs(sample.mean - kMaxwellMean) <= 4 * error_of_mean &&
                         std::abs(sample.deviation - kMaxwellDeviation) <= 4 * error_of_deviation;
    const std::string& table13 = printed::kTable13[s].mean_translation_mm;
    const bool same_runs = interval_of_table14(s).holds(std::stod(table13));
    rows.push_back(compare_readings(
        {"T14." + name_of(s), "Table 14", name_of(s) + " 95 % interval of the translation error, mm",
         "[" + printed::kTable14[s].low_mm + ", " + printed::kTable14[s].high_mm + "]"},
        {{"t interval of the lengths of 50 vectors of 0.1 mm noise an axis",
          fmt::format("[{:.4f}, {:.4f}] expected; printed: centre {:.4f}, deviation {:.4f}", expected.low,
                      expected.high, sample.mean, sample.deviation),
          maxwell},
         {"t interval of Table 13's translation errors", "mean " + table13, same_runs}},
        "which error the interval is of is not told"));
  }
}

void add_statements(std::vector<LedgerRow>& rows) {
  std::size_t narrowest = 0;
  std::string widths;
  for (std::size_t s = 0; s < 3; ++s) {
    if (interval_of_table14(s).width() < interval_of_table14(narrowest).width()) narrowest = s;
    widths += fmt::format("{}{} {:.4f}", s > 0 ? ", " : "", name_of(s), interval_of_table14(s).width());
  }
  rows.push_back(compare_text(
      {"T14.narrow", "Section 4.3", "scheme of the narrowest interval", "S3"}, name_of(narrowest),
      {"widths of Table 14, mm: " + widths, "the printed interval of another scheme is narrower", ""}));
  const auto gap = [](std::size_t s, bool rotation) {
    const printed::PoseErrors& e = printed::kTable13[s];
    return rotation ? std::stod(e.max_rotation_deg) - std::stod(e.mean_rotation_deg)
                    : std::stod(e.max_translation_mm) - std::stod(e.mean_translation_mm);
  };
  bool smallest = true;
  for (std::size_t s = 0; s < 2; ++s) {
    smallest = smallest && gap(2, true) < gap(s, true) - 1e-9 && gap(2, false) < gap(s, false) - 1e-9;
  }
  rows.push_back(judge(
      {"T13.diff", "Section 4.3", "scheme of the smallest max − mean", "S3"},
      fmt::format("rotation {:.3f}, {:.3f}, {:.3f} deg; translation {:.3f}, {:.3f}, {:.3f} mm", gap(0, true),
                  gap(1, true), gap(2, true), gap(0, false), gap(1, false), gap(2, false)),
      smallest, {"Table 13, S1 to S3", "rotation ties with S1 and translation is smallest for S2", ""}));
}

void add_p_values(std::vector<LedgerRow>& rows) {
  std::vector<double> p;
  for (const printed::PValue& print : printed::kFigure24) {
    const auto a = static_cast<std::size_t>(print.a), b = static_cast<std::size_t>(print.b);
    const TTest test = test_of_table14(a, b);
    p.push_back(test.p);
    const double printed_p = std::stod(print.p);
    const Account account{
        "two-sided t-test of the samples of Table 14, n = 50 each",
        fmt::format(
            "ten times the printed value is {:.3f}: a slip of the decimal point; as paired tests the three "
            "printed values would need correlations that no runs can have (smallest eigenvalue {:.4f})",
            10 * printed_p, eigenvalue_of_needed_correlations()),
        ""};
    const std::string pair = name_of(a) + "-" + name_of(b);
    rows.push_back(compare({"F24." + pair, "Fig. 24", "p of " + pair, print.p}, test.p, account));
    rows.push_back(told_again(rows.back(), "P.F24.p_" + name_of(a) + "_" + name_of(b), "Section 4.3"));
  }
  const std::vector<double> adjusted = holm_adjusted(p);
  const bool significant = *std::min_element(adjusted.begin(), adjusted.end()) < kAlpha;
  rows.push_back(
      compare_text({"F24.sig", "Section 4.3", "differences between the schemes", "statistically significant"},
                   significant ? "statistically significant" : "not significant",
                   {fmt::format("smallest p after Holm {:.2f}, α = 0.05",
                                *std::min_element(adjusted.begin(), adjusted.end())),
                    "the paper's next paragraph says so too", ""}));
}

/// Could 50 runs have ranked the schemes?
void add_power(std::vector<LedgerRow>& rows) {
  const TTest test = test_of_table14(1, 2);  // the largest difference
  const TTestPlan plan{.effect_size = std::abs(test.effect_size), .design = TTestDesign::TwoSamples};
  const std::size_t needed = sample_size_for(plan, 0.8);
  rows.push_back(judge(
      {"P.T13.simulations", "Table 13, Section 4.3", "simulations enough to rank the schemes", "50"},
      fmt::format("{}", needed), needed <= static_cast<std::size_t>(printed::kRuns),
      {fmt::format("runs a scheme that find the largest difference of Table 14 (S2 − S3, {:.4f} mm) with "
                   "probability 0.8; 50 find it with {:.2f}",
                   test.difference, power_of_t_test(plan, printed::kRuns)),
       "50 runs cannot rank them", ""}));
}

}  // namespace

Interval interval_of_table14(std::size_t scheme) {
  const printed::ConfidenceInterval& print = printed::kTable14[scheme];
  return {std::stod(print.low_mm), std::stod(print.high_mm)};
}

Summary sample_of_table14(std::size_t scheme) {
  return sample_of_interval(interval_of_table14(scheme), printed::kRuns);
}

TTest test_of_table14(std::size_t a, std::size_t b) {
  return pooled_t_test(sample_of_table14(a), sample_of_table14(b));
}

double eigenvalue_of_needed_correlations() {
  Mat3 correlations = Mat3::Identity();
  for (const printed::PValue& print : printed::kFigure24) {
    const Summary a = sample_of_table14(static_cast<std::size_t>(print.a));
    const Summary b = sample_of_table14(static_cast<std::size_t>(print.b));
    const double t = student_quantile(1 - std::stod(print.p) / 2, printed::kRuns - 1);
    const double deviation = std::abs(a.mean - b.mean) / t * std::sqrt(static_cast<double>(printed::kRuns));
    const double rho = (a.deviation * a.deviation + b.deviation * b.deviation - deviation * deviation) /
                       (2 * a.deviation * b.deviation);
    correlations(print.a, print.b) = correlations(print.b, print.a) = rho;
  }
  return symmetric_eigen(correlations).values(0);
}

std::vector<LedgerRow> rows_of_comparisons() {
  std::vector<LedgerRow> rows;
  add_intervals(rows);
  add_statements(rows);
  add_p_values(rows);
  add_power(rows);
  return rows;
}

}  // namespace asterism
