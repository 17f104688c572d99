// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "asterism/geometry/rigid_motion.hpp"
#include "asterism/reproduction/svg.hpp"

namespace asterism {

/// Things in space seen from afar (parallel projection, z up), fitted into a drawing of a given size.
class SpaceDrawing {
 public:
  SpaceDrawing(double azimuth_deg, double elevation_deg);

  void line(const Vec3& a, const Vec3& b, std::string style);
  /// Its label stands at its middle, a point's beside it.
  void arrow(const Vec3& from, const Vec3& to, std::string style, std::string label = "");
  void point(const Vec3& at, std::string style, std::string label = "", double radius_px = 4.5);
  void loop(const std::vector<Vec3>& points, std::string style);
  /// Three arrows of `length` along the axes of `world_from_frame`, and the origin's name.
  void axes(const RigidMotion& world_from_frame, double length, const std::string& name);

  [[nodiscard]] std::string str(double width, double height, std::string_view label) const;

 private:
  enum class Kind { Line, Arrow, Point, Loop };
  struct Item {
    Kind kind;
    std::vector<Vec2> points;  // right and up
    std::string style, label;
    double radius_px = 0;
  };
  [[nodiscard]] Vec2 seen(const Vec3& point) const;
  void add(Kind kind, const std::vector<Vec3>& points, std::string style, std::string label,
           double radius_px = 0);

  Vec3 right_, up_;
  std::vector<Item> items_;
};

/// Boxes from top to bottom joined by arrows; a box whose text starts with `?` is a question (drawn as
/// such) from which an arrow labelled `no` returns to box `back_to`.
[[nodiscard]] std::string flow_chart(const std::vector<std::string>& boxes, std::size_t back_to,
                                     std::string_view label);

/// A table: the first row is its head. Cells are text, not HTML.
[[nodiscard]] std::string html_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace asterism
