// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace asterism {

/// Every point found that no other found dominates, without limit; all objectives are minimised. Each
/// carries a number by which its owner knows it. Of equal points the first stays. What is archived depends
/// on the set of points alone, not on the order in which they come, copies' numbers apart.
///
/// Two objectives are kept in an ordered map: O(log n) a point. More are kept in blocks of near points, each
/// with its lower and upper corner, most of which a new point passes by after one look (the idea of the
/// ND-tree, Jaszkiewicz & Lust 2018, with one level).
class ParetoArchive {
 public:
  struct Member {
    std::vector<double> objectives;
    std::size_t number;
  };

  explicit ParetoArchive(std::size_t objectives);

  /// Archives the point unless one in the archive is as good in all; false if so. `objectives` are numbers.
  bool add(std::span<const double> objectives, std::size_t number);
  /// Numbers of the points that the last one added has driven out.
  [[nodiscard]] std::span<const std::size_t> dropped() const { return dropped_; }

  [[nodiscard]] std::size_t size() const { return size_; }
  void clear();
  /// In lexicographic order of their objectives.
  [[nodiscard]] std::vector<Member> members() const;

 private:
  struct Block {
    std::vector<double> points;  // row-major
    std::vector<std::size_t> numbers;
    std::vector<double> low, high;  // corners
  };
  struct Step {
    double second;
    std::size_t number;
  };

  bool add_to_stairs(std::span<const double> objectives, std::size_t number);
  bool add_to_blocks(const double* point, std::size_t number);
  bool is_covered_in(const Block& block, const double* point) const;
  void drop_covered(Block& block, const double* point);
  [[nodiscard]] std::size_t nearest_block(const double* point) const;
  void split(std::size_t at);
  void fit_corners(Block& block) const;

  std::size_t m_;
  std::size_t size_ = 0;
  std::map<double, Step> stairs_;  // two objectives, by the first
  std::vector<Block> blocks_;
  std::size_t covered_last_ = 0;  // block that turned the last point away; it is asked first
  std::vector<std::size_t> dropped_;
};

}  // namespace asterism
