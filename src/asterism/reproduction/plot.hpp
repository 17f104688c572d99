// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asterism/reproduction/svg.hpp"

namespace asterism {

/// From `low` to `high`; ticks at round numbers, or one for each name at 0, 1, 2, …
struct Axis {
  std::string label;
  double low = 0, high = 1;
  std::vector<std::string> names;
};

/// The smallest round span that holds both ends, with a little room.
[[nodiscard]] Axis axis_around(std::string label, double low, double high);

/// Round numbers within an axis, at most `most` of them.
[[nodiscard]] std::vector<double> ticks_of(const Axis& axis, int most);

/// A drawing with two axes. Everything is given in the axes' units; styles as in Svg.
class Plot {
 public:
  Plot(Axis x, Axis y, double width = 620, double height = 340);

  void line(const std::vector<Vec2>& points, std::string_view style);
  void point(const Vec2& at, std::string_view style, double radius_px = 4, std::string_view tip = "");
  /// From zero (or the axis's low end) up to `height`.
  void bar(double centre, double width, double height, std::string_view style, std::string_view tip = "");
  void error_bar(double x, double low, double high, std::string_view style);
  void level(double y, std::string_view label, std::string_view style);
  void note(const Vec2& at, std::string_view text, Anchor anchor = Anchor::Middle,
            const Vec2& shift_px = {0, -8});
  void box(const Vec2& low, const Vec2& high, std::string_view style);
  /// Style and name of each series, in one line above the axes.
  void legend(const std::vector<std::pair<std::string, std::string>>& entries);

  [[nodiscard]] std::string str(std::string_view label) const { return svg_.str(label); }

 private:
  [[nodiscard]] Vec2 at(const Vec2& point) const;
  void draw_axes();

  Axis x_, y_;
  Svg svg_;
};

}  // namespace asterism
