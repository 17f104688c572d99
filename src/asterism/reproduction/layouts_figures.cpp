// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/layouts_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/layout/identifiability.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"
#include "asterism/reproduction/disturbance.hpp"
#include "asterism/reproduction/drawing.hpp"
#include "asterism/reproduction/next_generation.hpp"
#include "asterism/reproduction/papers_run.hpp"
#include "asterism/reproduction/plot.hpp"
#include "asterism/reproduction/printed.hpp"

namespace asterism {
namespace {

std::string crowding_text(double value) { return std::isinf(value) ? "Inf" : fmt::format("{:.4f}", value); }

Exhibit table9(const std::vector<Scheme>& schemes) {
  std::vector<std::vector<std::string>> cells = {
      {"scheme", "P1, mm", "P2, mm", "P3, mm", "P4, mm", "rotation error, deg", "wrong labelling, mm"}};
  for (const Scheme& scheme : schemes) {
    std::vector<std::string> row = {scheme.name};
    for (const Vec3& p : scheme.targets)
      row.push_back(fmt::format("({:g}, {:g}, {:g})", p.x(), p.y(), p.z()));
    row.push_back(fmt::format("{:.4f}", rms_rotation_deg(scheme.targets, 0.1)));
    row.push_back(fmt::format("{:.2f}", identifiability_margin(scheme.targets).rms_mm));
    cells.push_back(row);
  }
  return {"T9", "Table 9. Five schemes of four targets",
          "S4's P2 is printed as (−220, −220, 590). The last two columns are ours: RMS rotation error by 0.1 "
          "mm of "
          "noise, and how well the best wrong labelling fits. All five can be taken for themselves turned by "
          "half "
          "a turn within 0.27 mm.",
          html_table(cells)};
}

Exhibit table10(const std::vector<Scheme>& schemes) {
  std::vector<std::vector<std::string>> cells = {
      {"scheme", "f1, mm", "printed", "coverage, mm", "printed", "crowding", "printed", "front"}};
  for (std::size_t s = 0; s < schemes.size(); ++s) {
    const Scheme& scheme = schemes[s];
    const printed::Crowding& print = printed::kTable10[s];
    cells.push_back({scheme.name, fmt::format("{:.4f}", scheme.f1_mm), print.f1_mm,
                     fmt::format("{:.4f}", scheme.coverage_mm), print.coverage_mm,
                     crowding_text(scheme.crowding), print.distance, fmt::format("{}", scheme.rank + 1)});
  }
  return {"T10", "Table 10. Crowding distances", "", html_table(cells)};
}

Exhibit tables11and12(const std::vector<Scheme>& schemes) {
  std::vector<std::vector<std::string>> cells = {{"", "f1, mm (printed)", "f2, mm (printed)", "what it is"}};
  const std::string meaning[] = {"a child, far out", "a child near S1", "dominated by row 1 as printed",
                                 fmt::format("S2, whose f1 is {:.2f}", schemes[1].f1_mm), "S4"};
  for (std::size_t i = 0; i < 5; ++i) {
    cells.push_back(
        {fmt::format("row {}", i + 1), printed::kTable11[i].f1_mm, printed::kTable11[i].f2_mm, meaning[i]});
  }
  cells.push_back({"Table 12", fmt::format("{:.2f}", schemes[0].f1_mm),
                   fmt::format("{:.2f}", -schemes[0].coverage_mm), "S1 unchanged; no row of Table 11"});
  return {"T11", "Tables 11 and 12. The next generation and the optimal layout", "", html_table(cells)};
}

/// The front of some hundred children, thinned until its points can be told apart.
std::vector<Vec2> front_of_children(std::uint64_t seed) {
  const auto children = children_of_table9(1000, 300, seed);
  std::vector<double> objectives;
  for (const auto& child : children) objectives.insert(objectives.end(), child.begin(), child.end());
  const std::vector<int> ranks = non_dominated_ranks(objectives, 2);
  std::vector<Vec2> front;
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (ranks[i] == 0) front.emplace_back(children[i][0], children[i][1] / 1000);
  }
  std::sort(front.begin(), front.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  std::vector<Vec2> shown;
  const double apart = 0.08 * (front.back().x() - front.front().x());
  for (const Vec2& point : front) {
    if (shown.empty() || point.x() - shown.back().x() >= apart) shown.push_back(point);
  }
  return shown;
}

Exhibit figure13(std::uint64_t seed) {
  const std::vector<Vec2> shown = front_of_children(seed);
  Plot plot(axis_around("f1, mm", shown.front().x(), shown.back().x()),
            axis_around("f2 = −coverage, m", shown.back().y(), shown.front().y()));
  if (shown.size() >= 3) {
    const std::size_t i = shown.size() / 2;
    plot.box({shown[i - 1].x(), shown[i + 1].y()}, {shown[i + 1].x(), shown[i - 1].y()}, "s2 dashed hollow");
    plot.note(shown[i], "i", Anchor::Start, {8, -6});
    plot.note(shown[i - 1], "i − 1", Anchor::Start, {8, -6});
    plot.note(shown[i + 1], "i + 1", Anchor::Start, {8, -6});
  }
  plot.line(shown, "soft");
  for (const Vec2& point : shown) plot.point(point, "s1");
  return {"F13", "Figure 13. Crowding distance",
          "A front of children of the five schemes. The crowding distance of i is half "
          "the perimeter of the box its neighbours span, each side over the front's own extent. Two "
          "objectives are sorted; "
          "the text speaks of three.",
          plot.str("Figure 13")};
}

Exhibit figure17(const std::vector<Scheme>& schemes) {
  Plot plot(axis_around("f1: mean distance to the origin, mm", 640, 880),
            axis_around("f2 = −coverage, m", -6, -2.4));
  std::vector<Vec2> front;
  for (const Scheme& scheme : schemes) {
    if (scheme.rank == 0) front.emplace_back(scheme.f1_mm, -scheme.coverage_mm / 1000);
  }
  std::sort(front.begin(), front.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  plot.line(front, "soft");
  for (std::size_t s = 0; s < schemes.size(); ++s) {
    const Vec2 here(schemes[s].f1_mm, -schemes[s].coverage_mm / 1000);
    plot.point(here, fmt::format("s{}", s + 1), 6, schemes[s].name);
    const bool below = s == 4;  // S3 stands beside it
    plot.note(here, fmt::format("{}, Front {}", schemes[s].name, schemes[s].rank + 1), Anchor::Start,
              {10, below ? 14.0 : -6.0});
  }
  return {"F17", "Figure 17. Non-dominated sorting of the five schemes",
          "All five lie on Front 1: cost and coverage rise together "
          "with the size of the layout.",
          plot.str("Figure 17")};
}

/// What 50 candidates and 100 generations make of the five schemes.
Exhibit papers_front(const std::vector<Scheme>& schemes, std::uint64_t seed) {
  const OptimizationResult run = papers_run(seed);
  Plot plot({"f1: mean distance to the origin, mm", 560, 1180, {}}, {"f2 = −coverage, m", -10, 0, {}});
  for (const Candidate& candidate : run.front) {
    plot.point({candidate.objectives[0], candidate.objectives[1] / 1000}, "s1", 3.5);
  }
  for (const Scheme& scheme : schemes) {
    const Vec2 here(scheme.f1_mm, -scheme.coverage_mm / 1000);
    plot.point(here, "s2", 4.5);
    plot.note(here, scheme.name, Anchor::Start, {8, -4});
  }
  plot.legend({{"s1", "front after 100 generations of 50"}, {"s2", "Table 9"}});
  return {"S43.run", "Section 4.3. The optimisation that the paper times",
          "Four targets, x and y within ±700 mm, z within 580 to 620 mm, Tables 3 to 7. The exact ends of "
          "the front: "
          "580 mm with all four targets in one place, and 9562 mm of coverage with one in each corner.",
          plot.str("The front of the paper's optimisation")};
}

Exhibit figure18(const std::vector<Scheme>& schemes) {
  Plot plot({"", -0.7, 4.7, {"S1", "S2", "S3", "S4", "S5"}}, {"coverage, m", 0, 7, {}});
  for (std::size_t s = 0; s < schemes.size(); ++s) {
    const double x = static_cast<double>(s), ours = schemes[s].coverage_mm / 1000;
    const double print = std::stod(printed::kTable10[s].coverage_mm) / 1000;
    plot.bar(x - 0.18, 0.32, ours, fmt::format("s{}", s + 1), fmt::format("computed {:.2f} mm", 1000 * ours));
    plot.bar(x + 0.18, 0.32, print, "soft", fmt::format("printed {:.2f} mm", 1000 * print));
    plot.note({x - 0.18, ours}, fmt::format("{:.3f}", ours));
  }
  plot.legend({{"s1", "computed"}, {"soft", "printed in Table 10"}});
  return {"F18", "Figure 18. Coverage of the five schemes", "", plot.str("Figure 18")};
}

Exhibit figure19(const std::vector<Scheme>& schemes, std::uint64_t seed) {
  const std::vector<std::size_t> ours = draw_parents(schemes, seed), print = {0, 1, 0, 1, 4};
  const std::vector<double> odds = tournament_odds(schemes);
  Plot plot({"tournament", -0.6, 4.6, {"1", "2", "3", "4", "5"}}, {"index of the parent", 0, 6, {}});
  for (std::size_t i = 0; i < 5; ++i) {
    const double x = static_cast<double>(i);
    plot.bar(x - 0.16, 0.28, static_cast<double>(ours[i] + 1), "s1", "drawn here");
    plot.bar(x + 0.16, 0.28, static_cast<double>(print[i] + 1), "soft", "in the paper");
  }
  plot.legend({{"s1", "drawn here"}, {"soft", "in the paper"}});
  std::string text = "One tournament picks";
  for (std::size_t s = 0; s < 5; ++s)
    text += fmt::format(" {} with probability {:.2f}{}", schemes[s].name, odds[s], s < 4 ? "," : ".");
  return {"F19", "Figure 19. Parents picked by binary tournament", text, plot.str("Figure 19")};
}

}  // namespace

std::vector<Exhibit> layouts_exhibits(const std::vector<Scheme>& schemes, std::uint64_t seed) {
  const Exhibit figure12{"F12", "Figure 12. NSGA-II",
                         "Tables 3 to 7 are its steps; they are in optimization/.",
                         flow_chart({"random layouts within the deployable area", "evaluate the objectives",
                                     "sort into fronts (Table 3)", "crowding distances (Table 4)",
                                     "?last generation", "the front of the last generation"},
                                    1, "NSGA-II")};
  return {table9(schemes),   table10(schemes),        tables11and12(schemes),
          figure12,          figure13(seed),          figure17(schemes),
          figure18(schemes), figure19(schemes, seed), papers_front(schemes, seed)};
}

}  // namespace asterism
