// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/evaluation/disturbance_runs.hpp"
#include "asterism/statistics/student.hpp"

namespace asterism {

// Is one layout better than another, and would as few runs as the paper's 50 tell?

/// One layout's errors over the runs.
struct SampleOfLayout {
  std::string name;
  Summary first, all;                     // the first runs, and every run
  Interval first_interval, all_interval;  // of the mean, 95 %, by Student
};

/// Two layouts run by run, under common random numbers.
struct PairOfLayouts {
  std::size_t a = 0, b = 0;                 // a < b
  TTest first, all;                         // paired; of the first runs, of all
  double first_p_holm = 1, all_p_holm = 1;  // made good for the number of pairs
  double power_of_first = 0;                // with which so few runs find the difference that all runs show
  std::optional<std::size_t> runs_needed;   // to find it with 80 %; none: no difference to be found
};

struct LayoutComparison {
  RunQuantity quantity = RunQuantity::CentroidMm;
  bool at_rest = true;
  std::size_t first_runs = 0, runs = 0;  // compared: those in which every layout has a pose
  std::vector<SampleOfLayout> layouts;
  std::vector<PairOfLayouts> pairs;
};

/// `first`: how many runs the paper would have had (50). Throws MeasurementError when fewer than three runs
/// gave every layout a pose.
[[nodiscard]] LayoutComparison compare_layouts(std::span<const LayoutRuns> layouts, RunQuantity quantity,
                                               bool at_rest, std::size_t first = 50);

}  // namespace asterism
