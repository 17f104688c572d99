// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/reproduction/chain_errors.hpp"
#include "asterism/reproduction/chain_layouts.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/comparison_claims.hpp"
#include "asterism/reproduction/disturbance.hpp"
#include "asterism/reproduction/errors_figures.hpp"
#include "asterism/reproduction/printed.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr double kStatedSigmaMm = 0.1;
constexpr std::size_t kExperiments = 400;

std::string text_of(const ExpectedErrors& e) {
  return fmt::format("{:.4f}/{:.3f}/{:.4f}/{:.3f}", e.mean_rotation_deg.mean, e.max_rotation_deg.mean,
                     e.mean_translation_mm.mean, e.max_translation_mm.mean);
}

bool fits(const printed::PoseErrors& print, const ExpectedErrors& e) {
  return drawn_fits(print.mean_rotation_deg, e.mean_rotation_deg.mean, e.mean_rotation_deg.deviation) &&
         drawn_fits(print.max_rotation_deg, e.max_rotation_deg.mean, e.max_rotation_deg.deviation) &&
         drawn_fits(print.mean_translation_mm, e.mean_translation_mm.mean, e.mean_translation_mm.deviation) &&
         drawn_fits(print.max_translation_mm, e.max_translation_mm.mean, e.max_translation_mm.deviation);
}

std::vector<ExpectedErrors> expect_all(Disturbance disturbance, double sigma, std::uint64_t seed) {
  std::vector<ExpectedErrors> expected;
  for (const PublishedLayout& layout : paper_table1()) {
    expected.push_back(expect_errors(layout.targets, disturbance, sigma, printed::kRuns, kExperiments, seed));
  }
  return expected;
}

void add_table13(std::vector<LedgerRow>& rows, const std::vector<ExpectedErrors>& by_chain,
                 const std::vector<ExpectedErrors>& as_stated, const std::vector<ExpectedErrors>& by_ours) {
  for (std::size_t s = 0; s < 3; ++s) {
    const printed::PoseErrors& print = printed::kTable13[s];
    const ExpectedErrors &chain = by_chain[s], &stated = as_stated[s], &ours = by_ours[s];
    rows.push_back(compare_readings(
        {fmt::format("T13.S{}", s + 1), "Table 13",
         fmt::format("S{} mean/max rotation, deg; mean/max translation, mm", s + 1),
         print.mean_rotation_deg + "/" + print.max_rotation_deg + "/" + print.mean_translation_mm + "/" +
             print.max_translation_mm},
        {{fmt::format("two cameras 1 m apart, 2 m away, 60° up; images of discs off by {} px; "
                      "least-squares pose (Eq. 18) of Table 1's targets; 50 runs",
                      kChainSigmaPx),
          text_of(chain), fits(print, chain)},
         {fmt::format("isotropic noise of {} mm as in Section 3.3", kStatedSigmaMm), text_of(stated),
          fits(print, stated)},
         {"the same images, asterism's maximum-likelihood pose", text_of(ours), fits(print, ours)}},
        "the noise of these simulations and the cameras are not told"));
  }
}

/// Figures 21 and 22 and the text about them, where other places of the paper tell the same quantity.
void add_traces(std::vector<LedgerRow>& rows, const ChainTrace& trace) {
  const std::string open =
      "neither the noise with targets nor how the pose was found without them is told, and the figure's data "
      "are not given";
  const std::string with_model = fmt::format(
      "S1 on the paper's cell over {} frames: simulated centres off by {} px through the whole tracker; {} "
      "frames without a pose",
      trace.times_s.size(), kChainSigmaPx, trace.without_pose);
  const std::string without_model =
      "the platform's own read-out under an assumed error model: 0.0345 deg and 0.185 mm an axis, jumps of "
      "0.35 to 0.65 mm in 5 % of readings; chosen to give what the text tells";
  const Summary with_mm = summarize(trace.with_mm), with_deg = summarize(trace.with_deg);
  const Summary without_mm = summarize(trace.read_out_mm), without_deg = summarize(trace.read_out_deg);
  const auto told = [](const Summary& with, const Summary& without, int decimals) {
    return fmt::format("with: mean {:.{}f}, largest {:.{}f}; without: mean {:.{}f}, largest {:.{}f}",
                       with.mean, decimals, with.highest, decimals, without.mean, decimals, without.highest,
                       decimals);
  };
  const auto share = [](const std::vector<double>& values, double low, double high, const char* unit) {
    const auto inside =
        std::count_if(values.begin(), values.end(), [&](double v) { return v >= low && v <= high; });
    return fmt::format("{:.0f} % within {} to {} {}",
                       100.0 * static_cast<double>(inside) / static_cast<double>(values.size()), low, high,
                       unit);
  };
  const auto tell = [&](const char* id, const char* where, const char* quantity, const char* published,
                        const std::string& computed, const std::string& model) {
    rows.push_back(not_computable({id, where, quantity, published}, open, computed, model));
  };
  double largest = 0, mean = 0;
  for (const printed::PoseErrors& print : printed::kTable13) {
    largest = std::max(largest, std::stod(print.max_translation_mm));
    mean += std::stod(print.mean_rotation_deg) / 3;
  }
  const std::string both = with_model + "; without: " + without_model;
  tell("F21", "Fig. 21", "translation errors with and without targets, mm",
       "with: 0.05 to 0.2, at most 0.25; without: at most 0.8", told(with_mm, without_mm, 3), both);
  tell("F22", "Fig. 22", "rotation errors with and without targets, deg",
       "with: 0.015 to 0.07, mean 0.035; without: mean 0.055, at most 0.11", told(with_deg, without_deg, 4),
       both);
  const std::string in_mm = share(trace.with_mm, 0.05, 0.2, "mm");
  const std::string in_deg = share(trace.with_deg, 0.015, 0.07, "deg");
  tell("P.F21.with_low", "Fig. 21", "translation error with targets, from mm", "0.05", in_mm, with_model);
  tell("P.F21.with_high", "Fig. 21", "translation error with targets, to mm", "0.2", in_mm, with_model);
  rows.push_back(judge({"P.F21.with_max", "Fig. 21", "largest translation error with targets, mm", "0.25"},
                       fmt::format("{:.3f}", largest), largest <= 0.25, {"largest of Table 13", "", ""}));
  tell("P.F21.without_max", "Fig. 21", "largest translation error without targets, mm", "0.8",
       fmt::format("{:.3f}", without_mm.highest), without_model);
  tell("P.F22.with_low", "Fig. 22", "rotation error with targets, from deg", "0.015", in_deg, with_model);
  tell("P.F22.with_high", "Fig. 22", "rotation error with targets, to deg", "0.07", in_deg, with_model);
  rows.push_back(compare({"P.F22.with_mean", "Fig. 22", "mean rotation error with targets, deg", "0.035"},
                         mean, {"mean of Table 13's three means", "", ""}));
  tell("P.F22.without_mean", "Fig. 22", "mean rotation error without targets, deg", "0.055",
       fmt::format("{:.4f}", without_deg.mean), without_model);
  tell("P.F22.without_max", "Fig. 22", "largest rotation error without targets, deg", "0.11",
       fmt::format("{:.3f}", without_deg.highest), without_model);
}

void add_conclusion(std::vector<LedgerRow>& rows) {
  const double centre = interval_of_table14(0).centre();
  rows.push_back(not_computable(
      {"P.C.rot_before", "Conclusion", "rotation error before, deg", "0.055"},
      "Section 4.3 says the same of Fig. 22, but how the pose was found without targets is not told",
      "0.055 in Section 4.3"));
  rows.push_back(compare({"P.C.rot_after", "Conclusion", "rotation error after, deg", "0.035"},
                         std::stod(printed::kTable13[0].mean_rotation_deg),
                         {"mean of S1 in Table 13", "", "S3, the scheme praised, has 0.034"}));
  rows.push_back(not_computable({"P.C.trans_before", "Conclusion", "translation error before, mm", "0.31"},
                                "no table, figure or text of the experiment gives it"));
  std::vector<Reading> after = {{"centre of S1's interval in Table 14", fmt::format("{:.4f}", centre),
                                 std::abs(centre - 0.162) <= 0.0005}};
  for (std::size_t s = 0; s < 3; ++s) {
    after.push_back({fmt::format("mean of S{} in Table 13", s + 1), printed::kTable13[s].mean_translation_mm,
                     std::abs(std::stod(printed::kTable13[s].mean_translation_mm) - 0.162) <= 0.0005});
  }
  rows.push_back(compare_readings(
      {"P.C.trans_after", "Conclusion, abstract", "translation error after, mm", "0.162"}, after,
      "which mean is meant is not told, and the paper's tables contradict one another"));
  rows.push_back(compare({"C.rot", "Abstract, conclusion", "fall of the rotation error, %", "36"},
                         100 * (1 - 0.035 / 0.055), {"1 − 0.035 / 0.055, both as printed", "", ""}));
  rows.push_back(told_again(rows.back(), "P.C.rot_decrease", "Conclusion"));
  rows.push_back(compare(
      {"C.tr", "Abstract, conclusion", "fall of the translation error, %", "48"}, 100 * (1 - 0.162 / 0.31),
      {"1 − 0.162 / 0.31, both as printed", "", "with Table 13's 0.099 it would be 68 %"}));
  rows.push_back(told_again(rows.back(), "P.C.trans_decrease", "Conclusion"));
}

void add_specification(std::vector<LedgerRow>& rows) {
  const std::string data_sheet = "a figure of the device's data sheet, which the paper does not give";
  rows.push_back(not_computable(
      {"P.43.tracker_nominal_accuracy", "Section 4.3", "nominal accuracy of the tracker, mm", "0.025"},
      data_sheet));
  double largest = 0;
  for (const printed::PoseErrors& print : printed::kTable13) {
    largest = std::max(largest, std::stod(print.max_translation_mm));
  }
  rows.push_back(judge(
      {"P.43.maximum_allowable_error", "Section 4.3", "errors stay below the largest allowed, mm", "0.25"},
      fmt::format("{:.3f}", largest), largest <= 0.25, {"largest of Table 13", "", ""}));
}

}  // namespace

Chapter errors_chapter(std::uint64_t seed) {
  const std::vector<ExpectedErrors> by_chain =
      expect_chain_errors(Estimator::LeastSquares, kExperiments, seed);
  const ChainTrace trace = chain_trace(seed);
  Chapter chapter{"Errors of the pose (Section 4.3, conclusion)", {}, errors_exhibits(by_chain, trace, seed)};
  for (Exhibit& exhibit : exhibits_of(compare_on_chain(seed))) chapter.exhibits.push_back(std::move(exhibit));
  add_table13(chapter.rows, by_chain, expect_all(Disturbance::Isotropic, kStatedSigmaMm, seed),
              expect_chain_errors(Estimator::MaximumLikelihood, kExperiments / 4, seed));
  for (LedgerRow& row : rows_of_comparisons()) chapter.rows.push_back(std::move(row));
  add_traces(chapter.rows, trace);
  add_specification(chapter.rows);
  add_conclusion(chapter.rows);
  return chapter;
}

}  // namespace asterism
