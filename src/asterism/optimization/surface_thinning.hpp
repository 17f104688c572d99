// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asterism {

/// Thins a front of three objectives: again and again the point of least hypervolume contribution is left
/// out, until `keep` remain. Shares only grow when others go, so one measured earlier is a lower bound, and
/// only the least of these bounds is measured anew, and only if a neighbour has gone: a few sweeps in O(n)
/// for each point left out.
class SurfaceThinning {
 public:
  /// `front` is count × 3, row-major. Returns the positions kept, ascending; valid until the next call.
  std::span<const std::uint32_t> operator()(std::span<const double> front, std::size_t keep,
                                            std::span<const double> reference);

 private:
  struct Point {
    double x, y, z;
    std::uint32_t at;
  };
  struct Step {
    double x, y;
    std::uint32_t by;  // place in points_
  };
  [[nodiscard]] double share(std::size_t of);
  bool cover(const Step& step);
  [[nodiscard]] double free_area(const Point& point) const;

  std::span<const double> reference_;
  std::vector<Point> points_;   // those left, by z
  std::vector<double> bounds_;  // of their shares
  std::vector<char> fresh_;     // whether the bound is the share
  std::vector<std::uint32_t> neighbours_;
  std::vector<Step> covered_;  // by others in the box above a point: x ascends, y descends
  std::vector<std::uint32_t> kept_;
};

}  // namespace asterism
