// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/layout/target_loss.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/losses_figures.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPaperRuns = 1000;
constexpr double kImplausible = 0.001;  // a joint probability below this refuses a model

/// One of the eleven figures that Section 3.3 prints.
struct Printed {
  const char* row;    // in the ledger
  const char* prose;  // the same number in the running text
  const char* quantity;
  double LossFigures::*figure;
  std::size_t scheme;
  const char* published;
  double scale;  // 100 for a share in percent
};

const Printed kPrinted[] = {
    {"F14.1", "mean_cost_S1", "MeanCost S1, mm", &LossFigures::mean_cost_mm, 0, "284.83", 1},
    {"F14.2", "mean_cost_S2", "MeanCost S2, mm", &LossFigures::mean_cost_mm, 1, "311.92", 1},
    {"F14.3", "mean_cost_S3", "MeanCost S3, mm", &LossFigures::mean_cost_mm, 2, "264.51", 1},
    {"F14.4", "std_cost_S3", "StdCost S3, mm", &LossFigures::cost_deviation_mm, 2, "7.11", 1},
    {"F14.5", "mean_cover_S2", "MeanCover S2, mm", &LossFigures::mean_coverage_mm, 1, "6098.6", 1},
    {"F14.6", "mean_cover_S3", "MeanCover S3, mm", &LossFigures::mean_coverage_mm, 2, "5372.2", 1},
    {"F14.7", "std_cover_S2", "StdCover S2, mm", &LossFigures::coverage_deviation_mm, 1, "1148.6", 1},
    {"F14.8", "std_cover_S3", "StdCover S3, mm", &LossFigures::coverage_deviation_mm, 2, "1039.1", 1},
    {"F14.9", "pareto_S1", "Pareto frequency S1, %", &LossFigures::front_share, 0, "83.2", 100},
    {"F14.10", "pareto_S2", "Pareto frequency S2, %", &LossFigures::front_share, 1, "75.0", 100},
    {"F14.11", "pareto_S3", "Pareto frequency S3, %", &LossFigures::front_share, 2, "99.6", 100}};

std::vector<LossExpectation> expect(const TargetLossModel& model, std::size_t runs = kPaperRuns) {
  return expect_target_loss(places_of(paper_table1()), model, runs);
}

/// How probable the eleven figures are as one draw of the model, taken for independent: cost and coverage
/// of a scheme are not quite.
double joint_probability(const std::vector<LossExpectation>& expected) {
  double squares = 0;
  for (const Printed& printed : kPrinted) {
    const LossExpectation& of = expected[printed.scheme];
    const double gap = std::stod(printed.published) / printed.scale - of.expected.*printed.figure;
    const double error = of.standard_error.*printed.figure;
    squares += gap * gap / std::max(error * error, 1e-12);
  }
  return chi_square_tail(squares, static_cast<double>(std::size(kPrinted)));
}

void add_figures(std::vector<LedgerRow>& rows, const std::vector<LossExpectation>& expected,
                 const std::vector<LossFigures>& drawn) {
  const auto stated = expect({.cost = LayoutCost::MeanPairDistance});
  for (const Printed& printed : kPrinted) {
    const LossExpectation& of = expected[printed.scheme];
    const std::string as_stated =
        printed.figure == &LossFigures::mean_cost_mm
            ? fmt::format("; by the text's own definition, the mean pair distance, it would be {:.2f}",
                          stated[printed.scheme].expected.mean_cost_mm)
            : "";
    const Account account{
        "each target of Table 1 lost with probability 0.05, independently; noise 0.1 mm; Cost = mean "
        "distance of "
        "those left to their own centroid; Coverage = sum of pair distances; all 64 sets enumerated",
        "",
        fmt::format("{:.5g} in our own 1000 draws{}", printed.scale * (drawn[printed.scheme].*printed.figure),
                    as_stated)};
    const double value = printed.scale * (of.expected.*printed.figure);
    const double error = printed.scale * (of.standard_error.*printed.figure);
    rows.push_back(compare_drawn({printed.row, "Section 3.3, Fig. 14", printed.quantity, printed.published},
                                 value, error, account));
    rows.push_back(told_again(rows.back(), std::string("P.F14.") + printed.prose, "Section 3.3"));
  }
}

/// A setting can be told from print only when no other value gives the printed figures as well.
void add_settings(std::vector<LedgerRow>& rows) {
  std::vector<Reading> noises, losses, runs;
  for (const double noise : {0.1, 0.0, 0.5, 1.0}) {
    const double p = joint_probability(expect({.noise_mm = noise}));
    noises.push_back({fmt::format("{:g} mm", noise), fmt::format("joint p = {:.2g}", p), p > kImplausible});
  }
  for (const double loss : {0.05, 0.03, 0.04, 0.06, 0.07}) {
    const double p = joint_probability(expect({.loss_probability = loss}));
    losses.push_back(
        {fmt::format("{:g} %", 100 * loss), fmt::format("joint p = {:.2g}", p), p > kImplausible});
  }
  for (const std::size_t count : {1000U, 500U, 2000U, 20000U}) {
    const double p = joint_probability(expect({}, count));
    runs.push_back({fmt::format("{} runs", count), fmt::format("joint p = {:.2g}", p), p > kImplausible});
  }
  rows.push_back(compare_setting({"F14.sigma", "Section 3.3", "noise, mm", "0.1"}, noises));
  rows.push_back(told_again(rows.back(), "P.33.noise_sigma", "Section 3.3"));
  rows.push_back(compare_setting(
      {"P.33.dropout", "Section 3.3", "share of targets lost (each by itself), %", "5"}, losses));
  rows.push_back(compare_setting({"P.33.runs", "Section 3.3", "simulations", "1000"}, runs));
}

/// What the paper concludes from the figures.
void add_conclusions(std::vector<LedgerRow>& rows, const std::vector<LossExpectation>& expected) {
  std::size_t smallest = 0;
  std::string deviations, ratios;
  double least_ratio = 1, most_ratio = 0;
  for (std::size_t s = 0; s < expected.size(); ++s) {
    const LossFigures& of = expected[s].expected;
    if (of.cost_deviation_mm < expected[smallest].expected.cost_deviation_mm) smallest = s;
    const double ratio = of.coverage_deviation_mm / of.mean_coverage_mm;
    least_ratio = std::min(least_ratio, ratio);
    most_ratio = std::max(most_ratio, ratio);
    deviations += fmt::format("{}S{} {:.3f}", s > 0 ? ", " : "", s + 1, of.cost_deviation_mm);
    ratios += fmt::format("{}S{} {:.1f} %", s > 0 ? ", " : "", s + 1, 100 * ratio);
  }
  rows.push_back(judge(
      {"F14.least", "Section 3.3", "scheme with the smallest StdCost", "S3"},
      fmt::format("S{}", smallest + 1), smallest == 2,
      {"expected standard deviations: " + deviations,
       "S1 and S3 differ by less than a thousand runs can tell; that S3 came out smallest was luck", ""}));
  rows.push_back(
      judge({"F14.robust", "Section 3.3", "StdCover / MeanCover differs between the schemes", "yes"},
            most_ratio - least_ratio > 0.005 ? "yes" : "no", most_ratio - least_ratio > 0.005,
            {ratios,
             "the spread is the same share of every scheme's coverage: it tells the layout's size, "
             "not its robustness",
             ""}));
}

}  // namespace

Chapter losses_chapter(std::uint64_t seed) {
  const auto draws = draw_target_loss(places_of(paper_table1()), {}, kPaperRuns, seed);
  const std::vector<LossFigures> drawn = figures_of(draws);
  const std::vector<LossExpectation> expected = expect({});
  Chapter chapter{"Lost targets (Section 3.3)", {}, losses_exhibits(draws, drawn, expected)};
  add_figures(chapter.rows, expected, drawn);
  add_settings(chapter.rows);
  add_conclusions(chapter.rows, expected);
  return chapter;
}

}  // namespace asterism
