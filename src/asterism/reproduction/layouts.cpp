// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "asterism/layout/metrics.hpp"
#include "asterism/optimization/non_dominated_sort.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/disturbance.hpp"
#include "asterism/reproduction/layouts_figures.hpp"
#include "asterism/reproduction/next_generation.hpp"
#include "asterism/reproduction/papers_run.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/reproduction/schemes.hpp"
#include "asterism/reproduction/sorting_claims.hpp"

namespace asterism {
namespace {

const std::string kRepaired = "S4's second target at x = +220 (see T9.S4)";

void add_table10(std::vector<LedgerRow>& rows, const std::vector<Scheme>& schemes) {
  for (std::size_t s = 0; s < schemes.size(); ++s) {
    const printed::Crowding& print = printed::kTable10[s];
    const std::string id = "T10." + schemes[s].name;
    const std::string repaired = s == 3 ? "; " + kRepaired : "";
    rows.push_back(compare({id + ".f1", "Table 10", schemes[s].name + " f1, mm", print.f1_mm},
                           schemes[s].f1_mm,
                           {"mean distance of the targets to the origin" + repaired,
                            s == 3 ? "the prose and Table 11 give 669.23 for the same scheme"
                                   : "with the printed value S3 would be dominated, as the prose has it",
                            ""}));
    rows.push_back(
        compare({id + ".cov", "Table 10", schemes[s].name + " coverage, mm", print.coverage_mm},
                schemes[s].coverage_mm,
                {"sum of the six pair distances" + repaired,
                 "the table repeats S3's coverage for S4 and S5; the prose gives 3005.77 and 5828.35", ""}));
    rows.push_back(compare({id + ".cd", "Table 10", schemes[s].name + " crowding distance", print.distance},
                           schemes[s].crowding,
                           {"Eq. 29 over f1 and f2, all five in one front; " + kRepaired, "", ""}));
  }
  rows.push_back(compare({"S42.S4.f1", "Section 4.2", "S4 cost in the prose, mm", "669.23"}, schemes[3].f1_mm,
                         {"mean distance to the origin; " + kRepaired, "", ""}));
  rows.push_back(compare({"S42.S4.cov", "Section 4.2", "S4 coverage in the prose, mm", "3005.77"},
                         schemes[3].coverage_mm, {"sum of the six pair distances; " + kRepaired, "", ""}));
  rows.push_back(compare({"S42.S5.cov", "Section 4.2", "S5 coverage in the prose, mm", "5828.35"},
                         schemes[4].coverage_mm, {"sum of the six pair distances", "", ""}));
}

/// Which single change of sign in S4 as printed gives the coverage the prose tells?
void add_repair(std::vector<LedgerRow>& rows, const std::vector<Scheme>& schemes) {
  std::vector<Vec3> as_printed = schemes[3].targets;
  as_printed[1] = printed::kTable9S4P2;
  const auto fits = [](std::span<const Vec3> targets) {
    return std::abs(-objectives_of(targets)[1] - 3005.77) <= 0.005;
  };
  std::vector<std::string> repairs;
  for (std::size_t i = 0; i < as_printed.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> flipped = as_printed;
      flipped[i](axis) = -flipped[i](axis);
      if (!fits(flipped)) continue;
      repairs.push_back(
          fmt::format("P{} ({:g}, {:g}, {:g})", i + 1, flipped[i].x(), flipped[i].y(), flipped[i].z()));
    }
  }
  rows.push_back(
      judge({"T9.S4", "Table 9", "S4, second target, mm", "P2 (-220, -220, 590)"},
            fmt::format("{}", fmt::join(repairs, " or ")), fits(as_printed),
            {"the change of one sign that gives the prose's coverage 3005.77",
             fmt::format("as printed the coverage is {:.2f}", -objectives_of(as_printed)[1]), ""}));
  const LayoutMetrics metrics = measure_layout(schemes[3].targets);
  rows.push_back(
      judge({"T9.coplanar", "Section 4.2", "S4 is \"non-coplanar\"; farthest target from a plane, mm", "> 0"},
            fmt::format("{:.3f}", metrics.off_plane_mm), metrics.off_plane_mm > 1e-6,
            {kRepaired, "580 + 605 = 590 + 595: the four lie in one plane", ""}));
}

void add_front(std::vector<LedgerRow>& rows, const std::vector<Scheme>& schemes) {
  std::vector<std::string> front;
  for (const Scheme& scheme : schemes) {
    if (scheme.rank == 0) front.push_back(scheme.name);
  }
  const auto by = [&](auto value) {
    return std::min_element(schemes.begin(), schemes.end(),
                            [&](const Scheme& a, const Scheme& b) { return value(a) < value(b); })
        ->name;
  };
  rows.push_back(compare_text(
      {"S42.front", "Section 4.2, Fig. 17", "schemes in Front 1", "S1, S2, S4, S5"},
      fmt::format("{}", fmt::join(front, ", ")),
      {"non-dominated in (f1, −coverage)",
       fmt::format("S3 is not dominated by S5: {:.2f} < {:.2f}", schemes[2].f1_mm, schemes[4].f1_mm), ""}));
  rows.push_back(compare_text({"S42.low", "Section 4.2", "scheme of the lowest cost", "S2"},
                              by([](const Scheme& s) { return s.f1_mm; }),
                              {"smallest f1", "the same section also says S1", ""}));
  rows.push_back(compare_text({"S42.high", "Section 4.2, Fig. 18", "scheme of the highest coverage", "S5"},
                              by([](const Scheme& s) { return -s.coverage_mm; }),
                              {"largest coverage", "", ""}));
  std::vector<std::string> widest;
  for (const Scheme& scheme : schemes) {
    if (std::isinf(scheme.crowding)) widest.push_back(scheme.name);
  }
  rows.push_back(compare_text(
      {"S42.crowd", "Section 4.2, Fig. 19", "schemes of the largest crowding distance", "S1, S2"},
      fmt::format("{}", fmt::join(widest, ", ")), {"Eq. 29", "S2 is not at an end of the front", ""}));
}

/// Ranks of Table 11's rows as they are printed.
std::vector<int> ranks_of_table11() {
  std::vector<double> objectives;
  for (const printed::Survivor& row : printed::kTable11) {
    objectives.insert(objectives.end(), {std::stod(row.f1_mm), std::stod(row.f2_mm)});
  }
  return non_dominated_ranks(objectives, 2);
}

std::string pair_of(const printed::Survivor& row) { return "(" + row.f1_mm + ", " + row.f2_mm + ")"; }

void add_table11(std::vector<LedgerRow>& rows, const std::vector<Scheme>& schemes, std::uint64_t seed) {
  const auto& table = printed::kTable11;
  rows.push_back(row_of_reach(seed));
  rows.push_back(row_of_small_child(seed));
  rows.push_back(
      judge({"T11.3", "Table 11", "row 3 is a survivor of the non-dominated sort", pair_of(table[2])},
            fmt::format("front {} of the five rows", ranks_of_table11()[2] + 1), ranks_of_table11()[2] == 0,
            {"non-dominated sorting of the five printed rows",
             "dominated by row 1 as printed; with any f1 between 779 and 1059 elitist selection keeps "
             "exactly the printed set",
             ""}));
  rows.push_back(compare({"T11.4", "Table 11", "row 4 f1 (S2 by its f2), mm", table[3].f1_mm},
                         schemes[1].f1_mm,
                         {"mean distance to the origin of the scheme whose −coverage is −4780.5",
                          "no target lies nearer to the origin than z = 580", ""}));
  rows.push_back(compare({"T11.5", "Table 11", "row 5 f1 (S4), mm", table[4].f1_mm}, schemes[3].f1_mm,
                         {"as Table 10; " + kRepaired, "", ""}));
  rows.push_back(compare({"T11.5.f2", "Table 11", "row 5 f2 (S4), mm", table[4].f2_mm},
                         -schemes[3].coverage_mm, {"as Table 10; " + kRepaired, "", ""}));
}

void add_table12(std::vector<LedgerRow>& rows, const std::vector<Scheme>& schemes) {
  const auto [f1, f2] = objectives_of(printed::kTable12);
  bool among = false;
  for (const printed::Survivor& row : printed::kTable11) {
    among =
        among || (std::abs(std::stod(row.f1_mm) - f1) < 0.05 && std::abs(std::stod(row.f2_mm) - f2) < 0.5);
  }
  const bool same =
      std::equal(printed::kTable12.begin(), printed::kTable12.end(), schemes[0].targets.begin());
  rows.push_back(judge({"T12", "Table 12", "the optimal layout is one of Table 11", "yes"},
                       fmt::format("({:.2f}, {:.2f}), {}{}", f1, f2, same ? "S1 unchanged, " : "",
                                   among ? "in Table 11" : "not in Table 11"),
                       among,
                       {"f1 and f2 of the printed coordinates", "no row of Table 11 has these values", ""}));
  std::vector<double> errors;
  for (const Scheme& scheme : schemes) errors.push_back(rms_rotation_deg(scheme.targets, 0.1));
  const auto place = 1 + std::count_if(errors.begin(), errors.end(), [&](double e) { return e < errors[0]; });
  rows.push_back(judge(
      {"T12.place", "Table 12", "place of the optimal layout (S1) among the five by rotation error", "1"},
      fmt::format("{}", place), place == 1,
      {fmt::format("RMS rotation error by 0.1 mm of noise, S1 to S5: {:.4f} deg", fmt::join(errors, ", ")),
       "a smaller layout has a shorter lever", ""}));
}

}  // namespace

Chapter layouts_chapter(std::uint64_t seed) {
  const std::vector<Scheme> schemes = schemes_of_table9();
  Chapter chapter{"Layouts and their optimisation (Sections 3.2, 4.2)", {}, layouts_exhibits(schemes, seed)};
  add_table10(chapter.rows, schemes);
  add_repair(chapter.rows, schemes);
  add_front(chapter.rows, schemes);
  add_table11(chapter.rows, schemes, seed);
  add_table12(chapter.rows, schemes);
  for (LedgerRow& row : rows_of_sorting(seed)) chapter.rows.push_back(std::move(row));
  for (LedgerRow& row : rows_of_operators(schemes)) chapter.rows.push_back(std::move(row));
  for (LedgerRow& row : rows_of_times(seed)) chapter.rows.push_back(std::move(row));
  return chapter;
}

}  // namespace asterism
