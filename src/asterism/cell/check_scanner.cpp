// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "asterism/cell/cell_checks.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

void check_ranges(const Scanner& scanner, const std::string& here) {
  if (!(scanner.near_mm < scanner.far_mm)) {
    throw InputError(here, fmt::format("`near_mm` is {}; it must be less than `far_mm`, {}", scanner.near_mm,
                                       scanner.far_mm));
  }
  if (scanner.stand_off_mm < scanner.near_mm || scanner.stand_off_mm > scanner.far_mm) {
    throw InputError(here, fmt::format("`stand_off_mm` is {}; it must lie between `near_mm`, {}, and "
                                       "`far_mm`, {}",
                                       scanner.stand_off_mm, scanner.near_mm, scanner.far_mm));
  }
  if (scanner.good_incidence_deg > scanner.max_incidence_deg) {
    throw InputError(here, fmt::format("`good_incidence_deg` is {}; it must not be more than "
                                       "`max_incidence_deg`, {}",
                                       scanner.good_incidence_deg, scanner.max_incidence_deg));
  }
}

void check_pass(const ScanPass& pass, const std::string& here) {
  if (pass.scan < 0) throw InputError(here, "its number is negative");
  if (!std::isfinite(pass.from_s) || !std::isfinite(pass.to_s))
    throw InputError(here, "its times must be finite numbers");
  if (pass.to_s > pass.from_s) return;
  throw InputError(here, fmt::format("it ends at {} s, not after it begins at {} s", pass.to_s, pass.from_s));
}

}  // namespace

void check_scanner(const Cell& cell, const std::string& where) {
  if (cell.scanner) {
    check_carrier(cell.scanner->body, cell, where + ": the scanner", "it is carried by");
    check_ranges(*cell.scanner, where + ": [scanner]");
  }
  std::set<int> numbers;
  std::vector<ScanPass> in_order = cell.passes;
  for (const ScanPass& pass : cell.passes) {
    const std::string here = fmt::format("{}: scan pass {}", where, pass.scan);
    if (!cell.scanner || !cell.workpiece)
      throw InputError(here, fmt::format("there is no [{}]", cell.scanner ? "workpiece" : "scanner"));
    check_pass(pass, here);
    if (!numbers.insert(pass.scan).second) throw InputError(here, "its number is given twice");
  }
  std::sort(in_order.begin(), in_order.end(),
            [](const ScanPass& a, const ScanPass& b) { return a.from_s < b.from_s; });
  for (std::size_t i = 1; i < in_order.size(); ++i) {
    const ScanPass &before = in_order[i - 1], &after = in_order[i];
    if (after.from_s >= before.to_s) continue;
    throw InputError(fmt::format("{}: scan pass {}", where, after.scan),
                     fmt::format("it begins at {} s, while pass {} lasts until {} s; there is one scanner",
                                 after.from_s, before.scan, before.to_s));
  }
}

}  // namespace asterism
