// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/scan_task.hpp"

namespace asterism {

void describe(ScanTask& task, OptionVisitor& visit) {
  visit.number("share", task.share, {0.01, 1}, "of what the cell lets be measured, by area and weight");
  visit.integer("views_each", task.views_each, {1, 20}, "from how many views each place is to be measured");
  visit.number("tolerance_mm", task.tolerance_mm, {1e-4, 1000},
               "largest predicted standard deviation of a point along its normal");
  visit.number("view_s", task.view_s, {0, 1e5}, "time of one view");
  visit.number("turn_s", task.turn_s, {0, 1e5}, "time of one turn of the platform");
  visit.number("speed_mm_s", task.speed_mm_s, {0.1, 1e5}, "of the scanner between views");
  visit.number("rate_deg_s", task.rate_deg_s, {0.1, 1e4}, "of its turning between views");
  visit.number("settle_s", task.settle_s, {0, 1e4}, "rest before a view");
}

}  // namespace asterism
