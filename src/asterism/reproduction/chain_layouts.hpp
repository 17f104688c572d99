// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asterism/evaluation/estimator_comparison.hpp"
#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// A layout on the paper's cell and what it is worth after the loss that hurts most.
struct LayoutAfterLoss {
  std::string layout;
  std::size_t targets = 0;
  double worst_mm = 0;       // predicted √tr Σ at the worst point of the part over the motion, none lost
  double after_loss_mm = 0;  // the same after any one loss
  std::string point, lost;   // where, and without which target
  double drawn_mm = 0;       // RMS of our estimator there and then, of simulated centres
};

/// Beyond the paper: schemes S1 to S3 of Table 1 beside layouts of six and eight targets designed for the
/// same cell, room (cylinder of 350 mm, 580 to 620 mm high) and noise (0.20 px), by three estimators.
struct ChainLayouts {
  std::vector<EstimatorRow> estimators;  // over the motion
  std::vector<LayoutAfterLoss> losses;
};
[[nodiscard]] ChainLayouts compare_on_chain(std::uint64_t seed);

/// As two tables.
[[nodiscard]] std::vector<Exhibit> exhibits_of(const ChainLayouts& compared);

}  // namespace asterism
