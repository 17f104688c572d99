// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asterism {
namespace {

constexpr double kMarginPx = 34;

}  // namespace

SpaceDrawing::SpaceDrawing(double azimuth_deg, double elevation_deg) {
  const double a = rad_from_deg(azimuth_deg), e = rad_from_deg(elevation_deg);
  right_ = Vec3(-std::sin(a), std::cos(a), 0);
  up_ = Vec3(-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e));
}

Vec2 SpaceDrawing::seen(const Vec3& point) const { return {right_.dot(point), up_.dot(point)}; }

void SpaceDrawing::add(Kind kind, const std::vector<Vec3>& points, std::string style, std::string label,
                       double radius_px) {
  Item item{kind, {}, std::move(style), std::move(label), radius_px};
  for (const Vec3& point : points) item.points.push_back(seen(point));
  items_.push_back(std::move(item));
}

void SpaceDrawing::line(const Vec3& a, const Vec3& b, std::string style) {
  add(Kind::Line, {a, b}, std::move(style), "");
}
void SpaceDrawing::arrow(const Vec3& from, const Vec3& to, std::string style, std::string label) {
  add(Kind::Arrow, {from, to}, std::move(style), std::move(label));
}
void SpaceDrawing::point(const Vec3& at, std::string style, std::string label, double radius_px) {
  add(Kind::Point, {at}, std::move(style), std::move(label), radius_px);
}
void SpaceDrawing::loop(const std::vector<Vec3>& points, std::string style) {
  add(Kind::Loop, points, std::move(style), "");
}

void SpaceDrawing::axes(const RigidMotion& world_from_frame, double length, const std::string& name) {
  const char* styles[] = {"s2", "s3", "s1"};
  const char* names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const Vec3 tip = world_from_frame * (length * Vec3::Unit(i));
    arrow(world_from_frame.translation, tip, styles[i]);
    point(tip, styles[i], names[i], 0);
  }
  point(world_from_frame.translation, "ink", name, 3);
}

std::string SpaceDrawing::str(double width, double height, std::string_view label) const {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Item& item : items_) {
    for (const Vec2& point : item.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  const Vec2 span = (high - low).cwiseMax(1e-9);
  const double scale = std::min((width - 2 * kMarginPx) / span.x(), (height - 2 * kMarginPx) / span.y());
  const Vec2 middle = (low + high) / 2;
  const auto place = [&](const Vec2& p) {
    return Vec2(width / 2 + scale * (p.x() - middle.x()), height / 2 - scale * (p.y() - middle.y()));
  };
  Svg svg(width, height);
  for (const Item& item : items_) {
    std::vector<Vec2> at;
    for (const Vec2& point : item.points) at.push_back(place(point));
    if (item.kind == Kind::Line) svg.line(at[0], at[1], item.style);
    if (item.kind == Kind::Arrow) svg.arrow(at[0], at[1], item.style);
    if (item.kind == Kind::Loop) svg.polyline(at, item.style, true);
    if (item.kind == Kind::Point) svg.circle(at[0], item.radius_px, item.style + " filled", item.label);
    const Vec2 beside = item.kind == Kind::Arrow ? Vec2((at[0] + at[1]) / 2) : at.back();
    if (!item.label.empty()) svg.text(beside + Vec2(7, -6), item.label, "note");
  }
  return svg.str(label);
}

std::string flow_chart(const std::vector<std::string>& boxes, std::size_t back_to, std::string_view label) {
  constexpr double kWidth = 420, kBoxWidth = 300, kBoxHeight = 36, kGap = 22, kRightEdge = 385;
  const auto top = [&](std::size_t i) { return 10 + static_cast<double>(i) * (kBoxHeight + kGap); };
  const double middle = 20 + kBoxWidth / 2;
  Svg svg(kWidth, top(boxes.size()));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const bool question = boxes[i].starts_with('?');
    svg.rect({20, top(i)}, {kBoxWidth, kBoxHeight}, question ? "box question" : "box", question ? 18 : 5);
    svg.text({middle, top(i) + kBoxHeight / 2 + 4.5}, question ? boxes[i].substr(1) : boxes[i], "label",
             Anchor::Middle);
    if (i + 1 < boxes.size()) svg.arrow({middle, top(i) + kBoxHeight}, {middle, top(i + 1)}, "ink");
    if (!question) continue;
    const double from = top(i) + kBoxHeight / 2, to = top(back_to) + kBoxHeight / 2;
    svg.line({20 + kBoxWidth, from}, {kRightEdge, from}, "ink");
    svg.line({kRightEdge, from}, {kRightEdge, to}, "ink");
    svg.arrow({kRightEdge, to}, {20 + kBoxWidth, to}, "ink");
    svg.text({kRightEdge - 24, from - 6}, "no", "note");
    svg.text({middle + 8, top(i) + kBoxHeight + 15}, "yes", "note");
  }
  return svg.str(label);
}

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\"><table class=\"data\">";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    html += "<tr>";
    const char* tag = r == 0 ? "th" : "td";
    for (const std::string& cell : rows[r]) html += fmt::format("<{}>{}</{}>", tag, html_text(cell), tag);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace asterism
