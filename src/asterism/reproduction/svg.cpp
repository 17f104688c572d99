// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/svg.hpp"

#include <fmt/format.h>

#include <vector>

namespace asterism {
namespace {

constexpr double kHeadLength = 9, kHeadHalfWidth = 3.2;

std::string tip_of(std::string_view tip) {
  return tip.empty() ? "" : "<title>" + html_text(tip) + "</title>";
}

/// Two decimals are finer than any screen; zeros at the end are left out.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value == 0 ? 0.0 : value);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string list_of(std::span<const Vec2> points) {
  std::string list;
  for (const Vec2& point : points) list += number(point.x()) + "," + number(point.y()) + " ";
  return list;
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

void Svg::line(const Vec2& a, const Vec2& b, std::string_view style) {
  body_ += fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", style, number(a.x()),
                       number(a.y()), number(b.x()), number(b.y()));
}

void Svg::arrow(const Vec2& from, const Vec2& to, std::string_view style) {
  const double length = (to - from).norm();
  if (length < 1e-9) return;
  const Vec2 along = (to - from) / length, across(-along.y(), along.x());
  const Vec2 neck = to - kHeadLength * along;
  line(from, neck, style);
  const std::vector<Vec2> head = {to, neck + kHeadHalfWidth * across, neck - kHeadHalfWidth * across};
  polyline(head, std::string(style) + " filled", true);
}

void Svg::polyline(std::span<const Vec2> points, std::string_view style, bool closed) {
  body_ += fmt::format("<{} class=\"{}\" points=\"{}\"/>\n", closed ? "polygon" : "polyline", style,
                       list_of(points));
}

void Svg::circle(const Vec2& centre, double radius, std::string_view style, std::string_view tip) {
  body_ += fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\">{}</circle>\n", style,
                       number(centre.x()), number(centre.y()), number(radius), tip_of(tip));
}

void Svg::rect(const Vec2& corner, const Vec2& size, std::string_view style, double rounding,
               std::string_view tip) {
  body_ +=
      fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\">{}</rect>\n",
                  style, number(corner.x()), number(corner.y()), number(size.x()), number(size.y()),
                  number(rounding), tip_of(tip));
}

void Svg::text(const Vec2& at, std::string_view text, std::string_view style, Anchor anchor,
               double turn_deg) {
  const char* anchors[] = {"start", "middle", "end"};
  const std::string turn = turn_deg == 0 ? ""
                                         : fmt::format(" transform=\"rotate({} {} {})\"", number(turn_deg),
                                                       number(at.x()), number(at.y()));
  body_ +=
      fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", style,
                  number(at.x()), number(at.y()), anchors[static_cast<int>(anchor)], turn, html_text(text));
}

std::string Svg::str(std::string_view label) const {
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" style=\"max-width:{}px\">\n{}</svg>\n",
      number(width_), number(height_), html_text(label), number(width_), body_);
}

}  // namespace asterism
