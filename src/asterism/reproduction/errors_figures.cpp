// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/errors_figures.hpp"

#include <fmt/format.h>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/reproduction/comparison_claims.hpp"
#include "asterism/reproduction/drawing.hpp"
#include "asterism/reproduction/plot.hpp"
#include "asterism/reproduction/printed.hpp"

namespace asterism {
namespace {

constexpr double kSigmaPx = 0.20;

PoseErrorSample run_of(std::size_t scheme, std::size_t runs, std::uint64_t seed) {
  return disturb_images(paper_table1()[scheme].targets, kSigmaPx, runs, seed, 1);
}

std::string text_of(const Expected& expected, int decimals) {
  return fmt::format("{:.{}f} ± {:.{}f}", expected.mean, decimals, expected.deviation, decimals);
}

Exhibit table13(const std::vector<ExpectedErrors>& expected) {
  std::vector<std::vector<std::string>> cells = {{"scheme", "mean rot., deg", "printed", "max rot., deg",
                                                  "printed", "mean transl., mm", "printed", "max transl., mm",
                                                  "printed"}};
  for (std::size_t s = 0; s < 3; ++s) {
    const ExpectedErrors& ours = expected[s];
    const printed::PoseErrors& print = printed::kTable13[s];
    cells.push_back({fmt::format("S{}", s + 1), text_of(ours.mean_rotation_deg, 4), print.mean_rotation_deg,
                     text_of(ours.max_rotation_deg, 3), print.max_rotation_deg,
                     text_of(ours.mean_translation_mm, 4), print.mean_translation_mm,
                     text_of(ours.max_translation_mm, 3), print.max_translation_mm});
  }
  return {"T13", "Table 13. Errors of 50 disturbed poses",
          "By two cameras 1 m apart, 2 m away, and 0.20 px of noise: mean and spread of 400 experiments of "
          "50 poses. "
          "The paper states no noise for it; its 0.1 mm of Section 3.3 would give half as much.",
          html_table(cells)};
}

Exhibit table14() {
  std::vector<std::vector<std::string>> cells = {{"scheme", "printed interval, mm", "centre",
                                                  "standard deviation it tells of",
                                                  "Table 13's mean lies in it"}};
  for (std::size_t s = 0; s < 3; ++s) {
    const Interval interval = interval_of_table14(s);
    const Summary sample = sample_of_table14(s);
    cells.push_back({fmt::format("S{}", s + 1), fmt::format("[{:.4f}, {:.4f}]", interval.low, interval.high),
                     fmt::format("{:.4f}", sample.mean), fmt::format("{:.4f}", sample.deviation),
                     interval.holds(std::stod(printed::kTable13[s].mean_translation_mm)) ? "yes" : "no"});
  }
  return {"T14", "Table 14. 95 % confidence intervals", "", html_table(cells)};
}

Exhibit trace(const std::string& id, const std::string& title, const std::vector<double>& errors,
              const std::string& label, double high, double level) {
  Plot plot({"pose", 0, 100, {}}, {label, 0, high, {}}, 620, 260);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < errors.size(); ++i) points.emplace_back(static_cast<double>(i), errors[i]);
  plot.level(level, "largest the text tells of", "s2 dashed");
  plot.line(points, "s1");
  return {id, title,
          "With targets, by the model of Table 13. Without targets nothing can be drawn: how the pose was "
          "found then is not "
          "told.",
          plot.str(title)};
}

Exhibit figure23(std::uint64_t seed) {
  Plot plot({"", -0.6, 2.6, {"S1", "S2", "S3"}}, {"translation error, mm", 0.05, 0.22, {}});
  for (std::size_t s = 0; s < 3; ++s) {
    const double x = static_cast<double>(s);
    const Interval print = interval_of_table14(s),
                   ours = mean_interval(summarize(run_of(s, printed::kRuns, seed).translation_mm));
    plot.error_bar(x - 0.12, print.low, print.high, "ink");
    plot.point({x - 0.12, print.centre()}, "ink", 5);
    plot.error_bar(x + 0.12, ours.low, ours.high, fmt::format("s{}", s + 1));
    plot.point({x + 0.12, ours.centre()}, fmt::format("s{}", s + 1), 5);
  }
  plot.legend({{"ink", "Table 14"}, {"s1", "ours, the model of Table 13"}});
  return {"F23", "Figure 23. 95 % confidence intervals",
          "The printed intervals are not those of Table 13's errors: they do not hold its "
          "means.",
          plot.str("Figure 23")};
}

Exhibit figure24() {
  std::vector<std::string> names;
  for (const printed::PValue& print : printed::kFigure24)
    names.push_back(fmt::format("S{}–S{}", print.a + 1, print.b + 1));
  Plot plot({"", -0.6, 3.1, names}, {"p", 0, 1, {}});
  for (std::size_t i = 0; i < printed::kFigure24.size(); ++i) {
    const printed::PValue& print = printed::kFigure24[i];
    const double ours =
        test_of_table14(static_cast<std::size_t>(print.a), static_cast<std::size_t>(print.b)).p;
    const double x = static_cast<double>(i);
    plot.bar(x - 0.18, 0.32, ours, "s1", fmt::format("from Table 14: {:.4f}", ours));
    plot.bar(x + 0.18, 0.32, std::stod(print.p), "soft", "printed: " + print.p);
    plot.note({x - 0.18, ours}, fmt::format("{:.4f}", ours));
    plot.note({x + 0.18, std::stod(print.p)}, print.p);
  }
  plot.level(0.05, "α = 0.05", "s2 dashed");
  plot.legend({{"s1", "from Table 14"}, {"soft", "printed"}});
  return {"F24", "Figure 24. p-values of the t-tests",
          "The printed values are a tenth of what Table 14 gives.", plot.str("Figure 24")};
}

}  // namespace

std::vector<Exhibit> errors_exhibits(const std::vector<ExpectedErrors>& expected, std::uint64_t seed) {
  const PoseErrorSample sample = run_of(0, 101, seed);
  return {table13(expected),
          table14(),
          trace("F21", "Figure 21. Translation error over time", sample.translation_mm,
                "translation error, mm", 0.4, 0.25),
          trace("F22", "Figure 22. Rotation error over time", sample.rotation_deg, "rotation error, deg",
                0.12, 0.07),
          figure23(seed),
          figure24()};
}

}  // namespace asterism
