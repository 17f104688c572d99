// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_reductions.hpp"

#include <algorithm>
#include <numeric>

namespace asterism {
namespace {

/// Which numbers stand in each list, to be asked one by one.
class BitRows {
 public:
  BitRows(const NumberLists& lists, std::size_t width)
      : words_((width + 63) / 64), bits_(lists.size() * words_, 0) {
    for (std::size_t list = 0; list < lists.size(); ++list)
      for (const std::uint32_t k : lists[list]) bits_[list * words_ + k / 64] |= std::uint64_t{1} << k % 64;
  }
  [[nodiscard]] bool contains(std::size_t list, std::span<const std::uint32_t> numbers) const {
    const std::uint64_t* bits = bits_.data() + list * words_;
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](std::uint32_t k) { return (bits[k / 64] >> k % 64 & 1U) != 0; });
  }

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// Of `numbers`, the one whose list is shortest.
std::uint32_t rarest(std::span<const std::uint32_t> numbers, const NumberLists& lists) {
  return *std::min_element(numbers.begin(), numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lists[a].size() < lists[b].size();
  });
}

class Reduction {
 public:
  explicit Reduction(CoverModel model) : model_(std::move(model)), column_(model_.columns()) {
    std::iota(column_.begin(), column_.end(), 0);
  }

  ReducedCover run() {
    bool changed = true;
    while (changed) {
      keep_row_.assign(model_.rows(), 1);
      keep_column_.assign(model_.columns(), 1);
      drop_rows();
      force_columns();
      drop_columns();
      changed = rebuild();
    }
    return {std::move(model_), std::move(column_), std::move(forced_)};
  }

 private:
  /// Those that are covered whenever another is.
  void drop_rows() {
    const BitRows columns(model_.columns_of, model_.columns());
    for (std::size_t i = model_.rows(); i-- > 0;) {
      if (keep_row_[i] == 0) continue;
      const auto its_columns = model_.columns_of[i];
      for (const std::uint32_t other : model_.rows_of[rarest(its_columns, model_.rows_of)]) {
        if (other == i || keep_row_[other] == 0) continue;
        const bool alike =
            model_.columns_of[other].size() == its_columns.size() && model_.demand[other] == model_.demand[i];
        const bool weaker =
            model_.columns_of[other].size() >= its_columns.size() && model_.demand[other] <= model_.demand[i];
        if (model_.is_partial() ? !alike : !weaker) continue;
        if (!columns.contains(other, its_columns)) continue;
        keep_row_[other] = 0;
        model_.weight[i] += model_.weight[other];
      }
    }
  }

  void force_columns() {
    if (model_.is_partial()) return;
    for (std::size_t i = 0; i < model_.rows(); ++i) {
      if (keep_row_[i] == 0) continue;
      const auto left = std::count_if(model_.columns_of[i].begin(), model_.columns_of[i].end(),
                                      [&](std::uint32_t j) { return keep_column_[j] != 0; });
      if (left > model_.demand[i]) continue;
      for (const std::uint32_t j : model_.columns_of[i])
        if (keep_column_[j] != 0) force(j);
    }
  }

  void force(std::uint32_t column) {
    forced_.push_back(column_[column]);
    keep_column_[column] = 0;
    for (const std::uint32_t i : model_.rows_of[column])
      if (--model_.demand[i] <= 0) keep_row_[i] = 0;
    const std::uint32_t group = model_.group[column];
    if (group == kNoGroup) return;
    for (std::uint32_t& other : model_.group)
      if (other == group) other = kNoGroup;  // it is open now
  }

  void drop_columns() {
    const BitRows rows(model_.rows_of, model_.rows());
    std::vector<std::uint32_t> its_rows;
    for (std::size_t j = model_.columns(); j-- > 0;) {
      if (keep_column_[j] == 0) continue;
      its_rows.clear();
      for (const std::uint32_t i : model_.rows_of[j])
        if (keep_row_[i] != 0) its_rows.push_back(i);
      if (its_rows.empty()) {
        keep_column_[j] = 0;
        continue;
      }
      if (std::any_of(its_rows.begin(), its_rows.end(),
                      [&](std::uint32_t i) { return model_.demand[i] > 1; }))
        continue;
      for (const std::uint32_t other : model_.columns_of[rarest(its_rows, model_.columns_of)]) {
        if (other == j || keep_column_[other] == 0 || cost_instead(other, j) > model_.cost[j]) continue;
        if (!rows.contains(other, its_rows)) continue;
        keep_column_[j] = 0;
        break;
      }
    }
  }

  /// What a column costs where another was chosen.
  [[nodiscard]] double cost_instead(std::uint32_t column, std::size_t other) const {
    const std::uint32_t group = model_.group[column];
    const bool opens = group != kNoGroup && group != model_.group[other];
    return model_.cost[column] + (opens ? model_.group_cost[group] : 0);
  }

  /// Leaves out what is not kept; false when all is.
  bool rebuild() {
    const auto gone = std::count(keep_row_.begin(), keep_row_.end(), 0) +
                      std::count(keep_column_.begin(), keep_column_.end(), 0);
    if (gone == 0) return false;
    model_ = part_of(model_, keep_row_, keep_column_);
    std::size_t left = 0;
    for (std::size_t j = 0; j < column_.size(); ++j)
      if (keep_column_[j] != 0) column_[left++] = column_[j];
    column_.resize(left);
    return true;
  }

  CoverModel model_;
  std::vector<std::uint32_t> column_, forced_;
  std::vector<char> keep_row_, keep_column_;
};

}  // namespace

ReducedCover reduced(CoverModel model) { return Reduction(std::move(model)).run(); }

}  // namespace asterism
