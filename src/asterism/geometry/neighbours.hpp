// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// Points made ready to be asked which of them are near a place; a thin wrapper of nanoflann's k-d tree. The
/// points are copied; all are finite. Of two equally far ones the first comes first. Asking is const and may
/// be done by many threads.
class Neighbours {
 public:
  explicit Neighbours(std::span<const Vec3> points);

  /// The nearest one; none farther away than `within_mm`.
  [[nodiscard]] std::optional<std::size_t> nearest(const Vec3& place, double within_mm) const;
  /// All within a radius, nearest first.
  [[nodiscard]] std::vector<std::size_t> within(const Vec3& place, double radius_mm) const;
  /// The `count` nearest, nearest first.
  [[nodiscard]] std::vector<std::size_t> few_nearest(const Vec3& place, std::size_t count) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace asterism
