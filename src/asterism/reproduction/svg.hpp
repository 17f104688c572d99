// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// `&`, `<`, `>` and `"` made safe for HTML.
[[nodiscard]] std::string html_text(std::string_view text);

/// Where a text stands from its point.
enum class Anchor { Start, Middle, End };

/// A drawing, in its own units, y down. Styles are class names of the page's style sheet: `ink`, `soft`,
/// `s1` to `s5`, `thin`, `dashed`, `filled`, …
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  void line(const Vec2& a, const Vec2& b, std::string_view style);
  void arrow(const Vec2& from, const Vec2& to, std::string_view style);
  void polyline(std::span<const Vec2> points, std::string_view style, bool closed = false);
  /// `tip` is shown when the mouse rests on it.
  void circle(const Vec2& centre, double radius, std::string_view style, std::string_view tip = "");
  void rect(const Vec2& corner, const Vec2& size, std::string_view style, double rounding = 0,
            std::string_view tip = "");
  void text(const Vec2& at, std::string_view text, std::string_view style = "", Anchor anchor = Anchor::Start,
            double turn_deg = 0);

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  /// The element; `label` is what a screen reader says.
  [[nodiscard]] std::string str(std::string_view label) const;

 private:
  double width_, height_;
  std::string body_;
};

}  // namespace asterism
