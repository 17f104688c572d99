// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asterism {
namespace {

constexpr double kLeft = 66, kRight = 18, kTop = 34, kBottom = 46;

double round_step(double span, int most) {
  const double rough = span / std::max(1, most);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= rough * (1 - 1e-9)) return step * power;
  }
  return 10 * power;
}

std::string tick_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
}

}  // namespace

Axis axis_around(std::string label, double low, double high) {
  const double span = high > low ? high - low : 1;
  const double step = round_step(span, 6);
  return {std::move(label),
          std::floor((low - 0.04 * span) / step) * step,
          std::ceil((high + 0.04 * span) / step) * step,
          {}};
}

std::vector<double> ticks_of(const Axis& axis, int most) {
  std::vector<double> ticks;
  if (!axis.names.empty()) {
    for (std::size_t i = 0; i < axis.names.size(); ++i) ticks.push_back(static_cast<double>(i));
    return ticks;
  }
  const double step = round_step(axis.high - axis.low, most);
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
    ticks.push_back(k * step);
  return ticks;
}

Plot::Plot(Axis x, Axis y, double width, double height)
    : x_(std::move(x)), y_(std::move(y)), svg_(width, height) {
  draw_axes();
}

Vec2 Plot::at(const Vec2& point) const {
  const double right = svg_.width() - kRight, bottom = svg_.height() - kBottom;
  return {kLeft + (point.x() - x_.low) / (x_.high - x_.low) * (right - kLeft),
          bottom - (point.y() - y_.low) / (y_.high - y_.low) * (bottom - kTop)};
}

void Plot::draw_axes() {
  const double bottom = svg_.height() - kBottom, right = svg_.width() - kRight;
  const std::vector<double> ys = ticks_of(y_, 6), xs = ticks_of(x_, 8);
  for (const double y : ys) {
    const Vec2 here = at({x_.low, y});
    svg_.line(here, {right, here.y()}, "grid");
    svg_.text({kLeft - 7, here.y() + 4}, tick_text(y, ys.size() > 1 ? ys[1] - ys[0] : 1), "tick",
              Anchor::End);
  }
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const Vec2 here = at({xs[i], y_.low});
    svg_.line(here, here + Vec2(0, 4), "axis");
    const std::string text =
        x_.names.empty() ? tick_text(xs[i], xs.size() > 1 ? xs[1] - xs[0] : 1) : x_.names[i];
    svg_.text({here.x(), bottom + 18}, text, "tick", Anchor::Middle);
  }
  svg_.line({kLeft, bottom}, {right, bottom}, "axis");
  svg_.line({kLeft, kTop}, {kLeft, bottom}, "axis");
  svg_.text({(kLeft + right) / 2, svg_.height() - 8}, x_.label, "label", Anchor::Middle);
  svg_.text({15, (kTop + bottom) / 2}, y_.label, "label", Anchor::Middle, -90);
}

void Plot::line(const std::vector<Vec2>& points, std::string_view style) {
  std::vector<Vec2> placed;
  for (const Vec2& point : points) placed.push_back(at(point));
  svg_.polyline(placed, std::string(style) + " curve");
}

void Plot::point(const Vec2& here, std::string_view style, double radius_px, std::string_view tip) {
  svg_.circle(at(here), radius_px, std::string(style) + " filled", tip);
}

void Plot::bar(double centre, double width, double height, std::string_view style, std::string_view tip) {
  const double foot = std::clamp(0.0, y_.low, y_.high);
  const Vec2 corner = at({centre - width / 2, std::max(height, foot)}),
             opposite = at({centre + width / 2, std::min(height, foot)});
  svg_.rect(corner, opposite - corner, std::string(style) + " filled", 1.5, tip);
}

void Plot::error_bar(double x, double low, double high, std::string_view style) {
  const Vec2 foot = at({x, low}), head = at({x, high});
  svg_.line(foot, head, style);
  for (const Vec2& end : {foot, head}) svg_.line(end - Vec2(6, 0), end + Vec2(6, 0), style);
}

void Plot::level(double y, std::string_view label, std::string_view style) {
  const Vec2 from = at({x_.low, y}), to = at({x_.high, y});
  svg_.line(from, to, style);
  svg_.text(to - Vec2(4, 5), label, "note", Anchor::End);
}

void Plot::note(const Vec2& here, std::string_view text, Anchor anchor, const Vec2& shift_px) {
  svg_.text(at(here) + shift_px, text, "note", anchor);
}

void Plot::box(const Vec2& low, const Vec2& high, std::string_view style) {
  const Vec2 corner = at({low.x(), high.y()}), opposite = at({high.x(), low.y()});
  svg_.rect(corner, opposite - corner, style);
}

void Plot::legend(const std::vector<std::pair<std::string, std::string>>& entries) {
  double x = kLeft;
  for (const auto& [style, name] : entries) {
    svg_.circle({x + 5, 15}, 5, style + " filled");
    svg_.text({x + 15, 19}, name, "note");
    x += 30 + 6.4 * static_cast<double>(name.size());
  }
}

}  // namespace asterism
