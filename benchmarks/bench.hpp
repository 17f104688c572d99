// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace asterism::bench {

/// A table printed for people on standard error as it grows and, at the end, as JSON on standard output
/// together with the processor, the compiler and the date.
class Table {
 public:
  Table(std::string title, std::vector<std::string> columns);
  void row(const std::vector<std::string>& cells);
  void print_json() const;

 private:
  std::string title_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Median seconds of one call; each of `repeats` samples is long enough to time (≥ 2 ms).
[[nodiscard]] double median_seconds(const std::function<void()>& call, int repeats = 15);

/// Median seconds of several calls that are timed in turn, so that a drift of the machine's speed
/// falls on all alike.
[[nodiscard]] std::vector<double> median_seconds_in_turn(const std::vector<std::function<void()>>& calls,
                                                         int repeats = 15);

}  // namespace asterism::bench
