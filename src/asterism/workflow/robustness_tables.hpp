// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/evaluation/robustness.hpp"
#include "asterism/evaluation/speed_trade.hpp"
#include "asterism/report/cell_report.hpp"

namespace asterism {

/// Faults × outcome, a row a fault: good where nothing was silently wrong or too sure.
[[nodiscard]] ReportTable robustness_table(const RobustnessTable& robustness);

/// Which knocks were found, the target named, and how small one could be.
[[nodiscard]] ReportTable knock_table(const RobustnessTable& robustness);

/// Angular speed × exposure: the raw error, and the filtered one at each frame rate.
[[nodiscard]] ReportTable speed_trade_table(const SpeedTrade& trade);

/// Detection on images beside the model of a moving disc.
[[nodiscard]] ReportTable streak_table(const SpeedTrade& trade);

/// Raw error over speed, a curve an exposure; filtered error over speed, a curve a frame rate.
[[nodiscard]] std::vector<ReportChart> speed_trade_charts(const SpeedTrade& trade, double tolerance_mm);

}  // namespace asterism
