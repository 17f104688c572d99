// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/evaluation/accuracy_agreement.hpp"
#include "asterism/evaluation/error_budget.hpp"
#include "asterism/evaluation/error_map.hpp"
#include "asterism/evaluation/fusion.hpp"
#include "asterism/evaluation/layout_comparison.hpp"
#include "asterism/evaluation/read_out_errors.hpp"
#include "asterism/evaluation/robustness.hpp"
#include "asterism/evaluation/speed_trade.hpp"
#include "asterism/report/cell_report.hpp"
#include "asterism/visibility/availability.hpp"
#include "asterism/visibility/watch.hpp"
#include "asterism/workflow/design_layout.hpp"

namespace asterism {

struct VerifyOptions {
  CentreLevel level = CentreLevel::Centres;
  int repeats = 8;        // of the motion at the level of centres; images are made once
  int runs = 5000;        // disturbance runs of each layout,
  int moments = 8;        // each at rest and at so many moments of the motion
  int budget_blocks = 2;  // of 10⁴ draws that check the error budget
  bool faults = true;     // what becomes of the pose under faults: lost, knocked, hidden targets
  bool fusion = true;     // what the platform's own read-out gains while both cameras are blind
  bool speed = true;      // error over turning rate, exposure and frame rate
  RobustnessOptions robustness;
  VisibilityOptions visibility;
  OcclusionOptions occlusion;
  TrackerOptions tracker;
};
void describe(VerifyOptions& options, OptionVisitor& visit);

struct VerifyJob {
  std::filesystem::path out;  // folder for the results; empty = none is written
  VerifyOptions options;
  std::uint64_t seed = 1;
  std::vector<NamedLayout> layouts;  // to be compared with the body's present one
};

/// Of the simulated errors at a point so many may lie beyond the tolerance. Not none: the largest of
/// thousands of draws of sound noise passes any tolerance in the end.
constexpr double kMayLieBeyond = 0.01;

/// How the cell does against its tolerance at the named points.
struct CellVerdict {
  bool pass = false;
  double below_95_mm = 0;  // what the error at the worst point and moment stays below with 95 % probability
  double beyond = 0;       // share of the simulated errors beyond the tolerance, at the named point with most
  double largest_mm = 0;   // seen in the simulation, at any named point; it grows with the number of draws
  std::string words;
};

/// What was found of a cell in motion. Frames are the pictures of its timing.
struct VerifiedCell {
  std::string cell;
  VerifiedBody body;
  std::string body_name;
  double tolerance_mm = 0, nominal_mm = 0;
  WatchedCell watched;
  std::vector<std::string> solids;  // names, as watched's causes count them

  PredictedAccuracy noise_only;  // centres' noise alone
  PredictedAccuracy predicted;   // RMS of all sources of error, biases included
  AccuracyAgreement noise_agreement, agreement;
  std::vector<SimulatedPose> poses;     // by frame, of the first repeat, all sources
  std::array<std::size_t, 5> status{};  // of all repeats, in the order of PoseStatus
  std::size_t repeats = 0;
  /// At each point over the poses of all repeats, all sources.
  struct Simulated {
    double square_mm2 = 0, largest_mm = 0;
    std::size_t poses = 0, beyond = 0;  // beyond the tolerance
    [[nodiscard]] double share_beyond() const {
      return poses > 0 ? static_cast<double>(beyond) / static_cast<double>(poses) : 0;
    }
  };
  std::vector<Simulated> simulated;
  std::optional<ReadOutErrors> read_out;

  WorstMoment worst;
  ErrorBudget budget;            // there and then
  std::optional<ErrorMap> map;   // of the part's surface
  std::vector<LayoutRuns> runs;  // [0] the present layout
  std::vector<LayoutComparison> comparisons;
  CellVerdict verdict;

  std::optional<RobustnessTable> robustness;
  std::optional<FusionStudy> fusion;
  std::optional<SpeedTrade> speed;
  std::vector<std::string> remarks;                     // what was left out and why
  std::vector<std::pair<std::string, double>> seconds;  // where the time went
};

/// Looks along the motion, predicts, simulates and tracks, disturbs, and judges; writes OUT/summary.json,
/// errors.csv, sights.csv and report.html. Throws MeasurementError with the reasons when the body's pose is
/// determined at no moment; InputError as check_cell does, or when a layout is of another body.
[[nodiscard]] VerifiedCell verify_cell(const Cell& cell, const VerifyJob& job, const Progress& progress);

/// Targets of the body that both cameras see in a frame.
[[nodiscard]] int visible_at(const VerifiedCell& verified, std::size_t frame);

/// The tables of a verification, one after the other.
[[nodiscard]] std::vector<ReportTable> tables_of(const VerifiedCell& verified);
[[nodiscard]] CellReport report_of(const Cell& cell, const VerifiedCell& verified,
                                   const VerifyOptions& options);

/// Over roll × pitch from rest, as far as the platform's stroke: targets seen, and predicted error at the
/// worst point.
[[nodiscard]] std::vector<CellReport::Heat> attitude_heats(const Cell& cell, const VerifiedCell& verified,
                                                           const VerifyOptions& options);

/// What summary.json holds; docs/formats.md tells the keys.
[[nodiscard]] nlohmann::ordered_json summary_of(const VerifiedCell& verified, const VerifyOptions& options);

/// errors.csv and sights.csv.
[[nodiscard]] std::string errors_csv(const VerifiedCell& verified);
[[nodiscard]] std::string sights_csv(const Cell& cell, const VerifiedCell& verified);

}  // namespace asterism
