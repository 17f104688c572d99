// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "asterism/optimization/set_cover.hpp"

namespace asterism {

/// Lists of numbers one behind the other in memory.
class NumberLists {
 public:
  void add(std::span<const std::uint32_t> list);
  [[nodiscard]] std::size_t size() const { return start_.size() - 1; }
  [[nodiscard]] std::size_t entries() const { return entries_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {entries_.data() + start_[i], entries_.data() + start_[i + 1]};
  }
  /// Of each number below `count`, the lists it stands in, ascending.
  [[nodiscard]] NumberLists transposed(std::size_t count) const;

 private:
  std::vector<std::size_t> start_{0};
  std::vector<std::uint32_t> entries_;
};

constexpr std::uint32_t kNoGroup = std::numeric_limits<std::uint32_t>::max();

/// A set cover problem as its solvers work on it: both ways round, only with rows that count and that columns
/// can cover; weights are whole, so that sums are exact in any order.
struct CoverModel {
  NumberLists rows_of;     // by column
  NumberLists columns_of;  // by row
  std::vector<double> cost;
  std::vector<std::int64_t> weight;  // positive
  std::vector<int> demand;           // at least 1, at most the columns there are
  std::int64_t total = 0;            // weight of all rows
  std::int64_t target = 0;           // weight of the rows that must have what they demand
  std::vector<std::uint32_t> group;  // by column; kNoGroup where opening is free
  std::vector<double> group_cost;

  [[nodiscard]] std::size_t rows() const { return columns_of.size(); }
  [[nodiscard]] std::size_t columns() const { return rows_of.size(); }
  [[nodiscard]] bool is_partial() const { return target < total; }
  [[nodiscard]] bool has_groups() const { return !group_cost.empty(); }
};

/// Throws InputError for what is not there or cannot be. Columns keep their numbers.
[[nodiscard]] CoverModel model_of(const SetCoverProblem& problem);

/// Only the rows and columns that are kept; where all rows were wanted, all that are left are.
[[nodiscard]] CoverModel part_of(const CoverModel& model, const std::vector<char>& keep_row,
                                 const std::vector<char>& keep_column);

/// Of columns that are chosen, groups' costs included.
[[nodiscard]] double cost_of(const CoverModel& model, std::span<const std::uint32_t> chosen);

/// Weight of the rows that have what they demand.
[[nodiscard]] std::int64_t covered_weight(const CoverModel& model, std::span<const std::uint32_t> chosen);

/// The least that a cover can cost which costs at least `bound`: the next whole number where costs are whole.
[[nodiscard]] double rounded_up(const CoverModel& model, double bound);

}  // namespace asterism
