// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "asterism/report/scan_report.hpp"

// The pieces of a scan report as the page reads them (web/src/data/scan_report.ts).

namespace asterism {

/// So many points are drawn of all rounds together, and of one of them: about 28 bytes of the page each.
inline constexpr std::size_t kMostDrawn = 240000, kMostDrawnARound = 100000;

/// Surface samples that plans and completeness tell about; each list of them is written once.
class SampleLists {
 public:
  /// Where the list is; −1 for an empty one.
  int place_of(const std::vector<SurfaceSample>& samples);
  [[nodiscard]] nlohmann::json json() const;

 private:
  std::vector<const std::vector<SurfaceSample>*> lists_;
};

[[nodiscard]] nlohmann::json json_of_scanner(const Scanner& scanner);
[[nodiscard]] nlohmann::json json_of_plan(const ScanPlan& plan, SampleLists& lists);
[[nodiscard]] nlohmann::json json_of_completeness(const Completeness& completeness,
                                                  const std::vector<SurfaceSample>& samples,
                                                  SampleLists& lists);
[[nodiscard]] nlohmann::json json_of_deviation(const Deviation& deviation);
/// At most `most` points, with what the cloud's fields and the deviations tell of them.
[[nodiscard]] nlohmann::json json_of_cloud(const Cloud& cloud, const std::vector<double>& deviation_mm,
                                           std::size_t most);

}  // namespace asterism
