// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/camera/two_view.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/drawing.hpp"
#include "asterism/reproduction/papers_cell.hpp"

namespace asterism {
namespace {

/// Figure 1 from above: what Eqs. 1 to 4 are about, to scale but for the focal length.
std::string stereo_drawing() {
  Svg svg(560, 330);
  const Vec2 left(150, 270), right(410, 270), point(250, 40);
  const double f = 60;
  for (const Vec2& camera : {left, right}) {
    svg.line(camera - Vec2(55, f), camera + Vec2(55, -f), "s1");
    svg.line(camera, camera - Vec2(0, 235), "soft dashed");
    svg.line(camera, point, "s2");
    svg.circle(camera, 4, "ink filled");
    const Vec2 image = camera + (point - camera) * (f / (camera.y() - point.y()));
    svg.circle(image, 4, "s2 filled");
    svg.text(image + Vec2(8, -7), camera.x() < 300 ? "P_L, x_L" : "P_R, x_R", "note");
  }
  svg.circle(point, 5, "s3 filled");
  svg.text(point + Vec2(10, 2), "P (X, Z)", "label");
  svg.line(left, right, "ink");
  svg.text({280, 290}, "baseline b", "label", Anchor::Middle);
  svg.arrow({60, 270}, {60, 210}, "ink");
  svg.text({40, 245}, "f", "label");
  svg.arrow({500, 270}, {500, 40}, "ink");
  svg.text({510, 160}, "z", "label");
  return svg.str("Two parallel cameras see a point");
}

std::string pinhole_drawing() {
  SpaceDrawing drawing(-60, 22);
  drawing.axes({}, 120, "O_c");
  const Vec3 point(120, 90, 420);
  const double f = 190;
  const Vec3 image = point * (f / point.z());
  drawing.loop({{-90, -70, f}, {90, -70, f}, {90, 70, f}, {-90, 70, f}}, "s1");
  drawing.line({0, 0, 0}, point, "s2");
  drawing.line({0, 0, f}, image, "soft dashed");
  drawing.point(image, "s2", "(x, y)");
  drawing.point(point, "s3", "(X_c, Y_c, Z_c)");
  return drawing.str(420, 320, "Image and camera frame");
}

std::string pixel_drawing() {
  Svg svg(420, 300);
  svg.rect({70, 40}, {300, 220}, "s1 hollow");
  for (int i = 1; i < 10; ++i) svg.line({70 + 30.0 * i, 40}, {70 + 30.0 * i, 260}, "grid");
  for (int i = 1; i < 8; ++i) svg.line({70, 40 + 27.5 * i}, {370, 40 + 27.5 * i}, "grid");
  svg.arrow({70, 40}, {190, 40}, "s2");
  svg.arrow({70, 40}, {70, 140}, "s2");
  svg.text({194, 34}, "u", "label");
  svg.text({54, 150}, "v", "label");
  svg.arrow({220, 150}, {320, 150}, "s3");
  svg.arrow({220, 150}, {220, 235}, "s3");
  svg.text({324, 146}, "x", "label");
  svg.text({226, 250}, "y", "label");
  svg.circle({220, 150}, 4, "ink filled");
  svg.text({228, 142}, "(u0, v0)", "note");
  svg.text({220, 282}, "u = x / dx + u0,  v = y / dy + v0", "label", Anchor::Middle);
  return svg.str("Pixel and image frame");
}

std::string world_drawing() {
  SpaceDrawing drawing(-50, 25);
  const RigidMotion world_from_camera{exp_rotation({0.2, -0.4, 0.6}), {320, 180, 60}};
  drawing.axes({}, 120, "O_w");
  drawing.axes(world_from_camera, 120, "O_c");
  const Vec3 point(260, -60, 230);
  drawing.line({0, 0, 0}, point, "soft dashed");
  drawing.line(world_from_camera.translation, point, "soft dashed");
  drawing.point(point, "s3", "P");
  drawing.arrow(world_from_camera.translation, {0, 0, 0}, "ink", "");
  return drawing.str(420, 300, "Camera and world frame");
}

std::string chain_drawing() {
  const char* frames[] = {"world", "camera", "image", "pixel"};
  const char* maps[] = {"R, T (Eq. 8)", "f / Z (Eqs. 5, 6)", "1/dx, 1/dy, γ, u0, v0 (Eq. 7)"};
  Svg svg(720, 110);
  for (int i = 0; i < 4; ++i) {
    const double x = 10 + 190.0 * i;
    svg.rect({x, 40}, {110, 40}, "box", 6);
    svg.text({x + 55, 65}, frames[i], "label", Anchor::Middle);
    if (i == 3) continue;
    svg.arrow({x + 110, 60}, {x + 190, 60}, "ink");
    svg.text({x + 150, i % 2 == 0 ? 30.0 : 102.0}, maps[i], "note", Anchor::Middle);
  }
  return svg.str("From the world to pixels");
}

/// Depth by Eq. 4 against the triangulated point, over the working volume.
LedgerRow row_of_depth() {
  const StereoRig rig = stereo_rig();
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const int row = i / 10;
    const Vec3 point(200 + 3.0 * (i % 20), -150 + 15.0 * row, 1800 + 4.0 * i);
    const auto left = project(rig.left, point), right = project(rig.right, rig.right_from_left * point);
    if (!left || !right) continue;
    const double depth = rig.baseline_mm() * rig.left.fx / (left->px.x() - right->px.x());
    const auto found = triangulate_pair(rig, left->px, Mat2::Identity(), right->px, Mat2::Identity());
    worst = std::max(worst, found ? std::abs(found->in_tracker.z() - depth) : INFINITY);
  }
  return judge(
      {"E4", "Eqs. 1–4", "depth z = b f / (x_L − x_R) is that of the triangulated point, mm", "equal"},
      fmt::format("{:.1e}", worst), worst < 1e-6,
      {"largest difference of 200 points, parallel cameras", "", ""});
}

/// Eq. 9 as one matrix product against the lens in use.
LedgerRow row_of_projection() {
  Lens lens = stereo_rig().left;
  lens.skew = 1.7;
  Mat3 k;
  k << lens.fx, lens.skew, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1;
  const RigidMotion camera_from_world{exp_rotation({0.2, -0.1, 0.4}), {50, 80, 1900}};
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 in_world(-200 + 4.0 * i, 150 - 3.0 * i, 2.0 * i);
    const Vec3 homogeneous = k * (camera_from_world * in_world);
    const auto image = project(lens, camera_from_world * in_world);
    worst = std::max(worst, image ? (image->px - homogeneous.hnormalized()).norm() : INFINITY);
  }
  return judge(
      {"E9", "Eqs. 5–9", "pixels by the matrix product are those of the lens in use, px", "equal"},
      fmt::format("{:.1e}", worst), worst < 1e-9,
      {"largest difference of 100 points; the skew γ stands in Eq. 9 only, and lens distortion nowhere", "",
       ""});
}

}  // namespace

Chapter projection_chapter() {
  return {"From the world to pixels (Section 2.1)",
          {row_of_depth(), row_of_projection()},
          {{"F1", "Figure 1. Two cameras and a target",
            "d = x_L − x_R, and z = b f / d by similar triangles.", stereo_drawing()},
           {"F2", "Figure 2. Image and camera frame", "x = f X / Z, y = f Y / Z.", pinhole_drawing()},
           {"F3", "Figure 3. Pixel and image frame", "", pixel_drawing()},
           {"F4", "Figure 4. Camera and world frame", "X_c = R X_w + T.", world_drawing()},
           {"F5", "Figure 5. The four frames", "", chain_drawing()}}};
}

}  // namespace asterism
