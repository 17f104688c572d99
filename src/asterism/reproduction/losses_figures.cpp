// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/losses_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "asterism/reproduction/plot.hpp"

namespace asterism {
namespace {

std::string style_of(std::size_t scheme) { return fmt::format("s{}", scheme + 1); }

std::string scatter(const std::vector<std::vector<LossDraw>>& draws) {
  Plot plot({"Cost: mean distance to the survivors' centroid, mm", 220, 340, {}}, {"Coverage, m", 0, 7, {}},
            620, 380);
  for (std::size_t s = 0; s < draws.size(); ++s) {
    for (const LossDraw& draw : draws[s]) {
      plot.point({std::clamp(draw.cost_mm, 220.0, 340.0), draw.coverage_mm / 1000},
                 style_of(s) + (draw.on_front ? "" : " faint"), 2.4);
    }
  }
  plot.legend({{"s1", "S1"}, {"s2", "S2"}, {"s3", "S3"}, {"ink faint", "pale: not on the front of its run"}});
  return plot.str("Cost and coverage of 1000 draws of each scheme");
}

/// Means with their deviations; one value a scheme.
std::string bars(const std::string& label, const std::vector<LossFigures>& drawn, double LossFigures::*mean,
                 double LossFigures::*deviation, double scale, double high) {
  Plot plot({"", -0.6, 2.6, {"S1", "S2", "S3"}}, {label, 0, high, {}}, 300, 300);
  for (std::size_t s = 0; s < drawn.size(); ++s) {
    const double x = static_cast<double>(s), value = scale * (drawn[s].*mean);
    plot.bar(x, 0.6, value, style_of(s), fmt::format("S{}: {:.2f}", s + 1, value));
    if (deviation != nullptr) {
      const double spread = scale * (drawn[s].*deviation);
      plot.error_bar(x, value - spread, value + spread, "ink");
    }
    plot.note({x, value}, fmt::format("{:.4g}", value), Anchor::Middle,
              {deviation != nullptr ? 26.0 : 0.0, -6});
  }
  return "<figure>" + plot.str(label) + "</figure>";
}

}  // namespace

std::vector<Exhibit> losses_exhibits(const std::vector<std::vector<LossDraw>>& draws,
                                     const std::vector<LossFigures>& drawn,
                                     const std::vector<LossExpectation>& expected) {
  std::string html = "<figure>" + scatter(draws) + "</figure><div class=\"row\">";
  html += bars("mean Cost ± deviation, mm", drawn, &LossFigures::mean_cost_mm,
               &LossFigures::cost_deviation_mm, 1, 350);
  html += bars("mean Coverage ± deviation, m", drawn, &LossFigures::mean_coverage_mm,
               &LossFigures::coverage_deviation_mm, 1e-3, 8);
  html += bars("on the Pareto front, %", drawn, &LossFigures::front_share, nullptr, 100, 110);
  html += "</div>";
  std::string exact;
  for (std::size_t s = 0; s < expected.size(); ++s) {
    const LossFigures& e = expected[s].expected;
    exact +=
        fmt::format(" S{}: {:.2f} ± {:.2f} mm, {:.1f} ± {:.1f} mm, {:.1f} %.", s + 1, e.mean_cost_mm,
                    e.cost_deviation_mm, e.mean_coverage_mm, e.coverage_deviation_mm, 100 * e.front_share);
  }
  return {{"F14", "Figure 14. Monte Carlo simulation of lost targets",
           "1000 draws of each scheme of Table 1. Each target is lost with probability 0.05; noise 0.1 mm. "
           "The clusters are "
           "none, one, two and more targets lost. Exact expectations:" +
               exact,
           html}};
}

}  // namespace asterism
