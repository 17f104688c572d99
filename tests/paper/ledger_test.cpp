// SPDX-License-Identifier: Apache-2.0
// Every number of the paper that was ever checked by hand has its row and its verdict.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "asterism/reproduction/reproduce.hpp"

namespace asterism {
namespace {

const std::map<std::string, LedgerRow>& ledger() {
  static const std::map<std::string, LedgerRow> rows = [] {
    std::map<std::string, LedgerRow> by_id;
    for (const LedgerRow& row : reproduce_paper(1).rows()) by_id.emplace(row.claim.id, row);
    return by_id;
  }();
  return rows;
}

void expect_verdict(const std::string& id, Verdict verdict) {
  ASSERT_TRUE(ledger().contains(id)) << id;
  EXPECT_EQ(words(ledger().at(id).verdict), words(verdict)) << id << ": " << ledger().at(id).reason;
}

// By an independent recalculation of the paper.
const char* const kMatches[] = {
    "T2.1.r",    "T2.1.s",     "T2.2.r",    "T2.2.s",    "T2.3.r",     "T10.S1.f1", "T10.S1.cov", "T10.S1.cd",
    "T10.S2.f1", "T10.S2.cov", "T10.S2.cd", "T10.S3.f1", "T10.S3.cov", "T10.S3.cd", "T10.S4.cd",  "T10.S5.cd",
    "T11.5",     "T16.n",      "S43.25",    "S43.33",    "C.rot",      "C.tr"};

const char* const kMatchesWithinMonteCarloError[] = {"F14.1", "F14.2", "F14.3", "F14.4",  "F14.5", "F14.6",
                                                     "F14.7", "F14.8", "F14.9", "F14.10", "F14.11"};

const char* const kMismatches[] = {
    "T2.3.s",    "T2.range",  "T10.S4.f1", "T10.S4.cov", "T10.S5.f1", "T10.S5.cov", "T9.S4",
    "S42.front", "S42.low",   "T11.3",     "T11.4",      "T12",       "T14.narrow", "T13.diff",
    "F24.S1-S2", "F24.S2-S3", "F24.S1-S3", "F24.sig",    "T15.n",     "S43.ang",    "S43.init"};

// What hangs on something the paper does not tell: noise, bounds, seeds, hardware.
const char* const kCannotBeDetermined[] = {"F14.sigma", "T11.1",  "T13.S1", "T14.S1", "T13.S2",
                                           "T14.S2",    "T13.S3", "T14.S3", "F20",    "F21",
                                           "F22",       "time",   "time2"};

struct Told {
  const char *id, *value;
};

// Numbers that stand in the running text only.
const Told kProse[] = {{"P.33.noise_sigma", "0.1"},
                       {"P.33.dropout", "5"},
                       {"P.33.runs", "1000"},
                       {"P.F14.mean_cost_S1", "284.83"},
                       {"P.F14.mean_cost_S2", "311.92"},
                       {"P.F14.mean_cost_S3", "264.51"},
                       {"P.F14.std_cost_S3", "7.11"},
                       {"P.F14.mean_cover_S2", "6098.6"},
                       {"P.F14.std_cover_S2", "1148.6"},
                       {"P.F14.mean_cover_S3", "5372.2"},
                       {"P.F14.std_cover_S3", "1039.1"},
                       {"P.F14.pareto_S1", "83.2"},
                       {"P.F14.pareto_S2", "75.0"},
                       {"P.F14.pareto_S3", "99.6"},
                       {"P.42.crossover_probability", "0.9"},
                       {"P.42.eta_c", "20"},
                       {"P.42.eta_m", "20"},
                       {"P.42.mutation_probability", "1/12"},
                       {"P.F19.tournament_parents", "S1 S2 S1 S2 S5"},
                       {"P.F20.targets", "8"},
                       {"P.F20.motion_start", "5"},
                       {"P.F20.motion_end", "9"},
                       {"P.F20.visible_min", "4"},
                       {"P.F20.visible_max", "8"},
                       {"P.F20.coverage_min", "0.6"},
                       {"P.F20.coverage_max", "nearly 1.0"},
                       {"P.F21.with_low", "0.05"},
                       {"P.F21.with_high", "0.2"},
                       {"P.F21.with_max", "0.25"},
                       {"P.F21.without_max", "0.8"},
                       {"P.F22.with_low", "0.015"},
                       {"P.F22.with_high", "0.07"},
                       {"P.F22.with_mean", "0.035"},
                       {"P.F22.without_mean", "0.055"},
                       {"P.F22.without_max", "0.11"},
                       {"P.T13.simulations", "50"},
                       {"P.F24.p_S1_S2", "0.07352"},
                       {"P.F24.p_S2_S3", "0.05227"},
                       {"P.F24.p_S1_S3", "0.07335"},
                       {"P.43.tracker_nominal_accuracy", "0.025"},
                       {"P.43.maximum_allowable_error", "0.25"},
                       {"P.43.population", "50"},
                       {"P.43.iterations", "100"},
                       {"P.43.nsga_time", "13.7"},
                       {"P.43.visibility_pose_time", "200"},
                       {"P.43.initial_scan_x", "789.48"},
                       {"P.43.initial_scan_y", "-125.04"},
                       {"P.43.initial_scan_z", "499"},
                       {"P.43.scan_angle", "6.12"},
                       {"P.43.points_reduction", "25"},
                       {"P.43.efficiency_gain", "33.3"},
                       {"P.C.rot_before", "0.055"},
                       {"P.C.rot_after", "0.035"},
                       {"P.C.trans_before", "0.31"},
                       {"P.C.trans_after", "0.162"},
                       {"P.C.rot_decrease", "36"},
                       {"P.C.trans_decrease", "48"},
                       {"P.C.lowest_symmetry", "20.395"}};

TEST(PaperLedger, AgreesWithAnIndependentRecalculation) {
  for (const char* id : kMatches) expect_verdict(id, Verdict::Match);
  for (const char* id : kMatchesWithinMonteCarloError)
    expect_verdict(id, Verdict::MatchWithinMonteCarloError);
  for (const char* id : kMismatches) expect_verdict(id, Verdict::Mismatch);
  for (const char* id : kCannotBeDetermined) expect_verdict(id, Verdict::CannotBeDetermined);
}

TEST(PaperLedger, HoldsEveryNumberOfTheRunningText) {
  for (const Told& told : kProse) {
    ASSERT_TRUE(ledger().contains(told.id)) << told.id;
    EXPECT_NE(ledger().at(told.id).claim.published.find(told.value), std::string::npos)
        << told.id << ": " << ledger().at(told.id).claim.published;
  }
}

TEST(PaperLedger, HoldsTheClaimsOfTheAbstractAndOfTheText) {
  expect_verdict("time", Verdict::CannotBeDetermined);   // 13.7 s
  expect_verdict("time2", Verdict::CannotBeDetermined);  // 200 ms
  expect_verdict("C.rot", Verdict::Match);               // 36 %
  expect_verdict("C.tr", Verdict::Match);                // 48 %
  expect_verdict("S43.33", Verdict::Match);              // 33.3 %
  expect_verdict("S32.O(N2)", Verdict::Match);           // O(N²) in N …
  expect_verdict("S32.O(N2).M", Verdict::Mismatch);      // … but O(M N²)
  expect_verdict("S43.ang", Verdict::Mismatch);          // 6.12°
  expect_verdict("S32.conflict", Verdict::Mismatch);
}

}  // namespace
}  // namespace asterism
