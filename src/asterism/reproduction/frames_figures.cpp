// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/frames_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/layout/frame.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/reproduction/drawing.hpp"
#include "asterism/reproduction/printed.hpp"

namespace asterism {
namespace {

constexpr double kAzimuth = -62, kElevation = 32;

std::string target_name(std::size_t i) { return fmt::format("P{}", i + 1); }

std::vector<Vec3> circle_of(double radius) {
  std::vector<Vec3> points;
  for (int i = 0; i < 72; ++i) {
    const double angle = rad_from_deg(5.0 * i);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return points;
}

Exhibit table1() {
  std::vector<std::vector<std::string>> cells = {{"target", "S1, mm", "S2, mm", "S3, mm"}};
  for (std::size_t i = 0; i < 6; ++i) {
    cells.push_back({target_name(i)});
    for (const PublishedLayout& layout : paper_table1()) {
      const Vec3& p = layout.targets[i];
      cells.back().push_back(fmt::format("({:g}, {:g}, {:g})", p.x(), p.y(), p.z()));
    }
  }
  return {"T1", "Table 1. Three schemes of six targets",
          "The input of Tables 2, 13 and 14 and of Figures 9, 10 and 14.", html_table(cells)};
}

Exhibit table2() {
  std::vector<std::vector<std::string>> cells = {{"scheme", "max radius, mm", "printed", "symmetry score, mm",
                                                  "printed", "mean radius, mm", "thickness, mm",
                                                  "enclosing sphere, mm"}};
  for (std::size_t s = 0; s < 3; ++s) {
    const LayoutMetrics m = measure_layout(paper_table1()[s].targets);
    cells.push_back({fmt::format("S{}", s + 1), fmt::format("{:.4f}", m.max_radius_mm),
                     printed::kTable2[s].max_radius_mm, fmt::format("{:.4f}", m.symmetry_mm),
                     printed::kTable2[s].symmetry_mm, fmt::format("{:.2f}", m.mean_distance_to_centroid_mm),
                     fmt::format("{:.2f}", m.thickness_mm),
                     fmt::format("{:.2f}", m.enclosing_sphere.radius_mm)});
  }
  return {"T2", "Table 2. Geometric distribution",
          "The last three columns are ours: the paper names the minimum "
          "enclosing sphere and does not use it.",
          html_table(cells)};
}

/// The first three targets of scheme 1 and what is made of them, step by step.
Exhibit construction(const std::string& id, const std::string& title, bool whole) {
  const auto& p = paper_table1()[0].targets;
  SpaceDrawing drawing(kAzimuth, kElevation);
  for (std::size_t i = 0; i < p.size(); ++i)
    drawing.point(p[i], i < (whole ? 4U : 2U) ? "s1" : "soft", target_name(i));
  drawing.arrow(p[0], p[1], "s2", "V1");
  if (whole) {
    drawing.arrow(p[0], p[2], "s2", "V2");
    drawing.arrow(p[0], p[3], "s2", "V3");
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    drawing.arrow(p[0], p[0] + 220 * n, "s3");
    drawing.point(p[0] + 220 * n, "s3", "n = V1 × V2", 0);
  }
  return {id, title,
          whole ? "n is at right angles to V1 and V2, but V1 and V2 are not to one another: [V1 V2 n] is no "
                  "rotation. V3 is never used."
                : "Scheme 1; P1 is the origin, V1 points to P2.",
          drawing.str(460, 300, title)};
}

Exhibit figure9() {
  const auto& targets = paper_table1()[0].targets;
  SpaceDrawing drawing(kAzimuth, kElevation);
  const auto frame = centroid_frame(targets);
  if (frame) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      drawing.line(frame->translation, targets[i], "soft dashed");
      drawing.point(targets[i], "s1", target_name(i));
    }
    drawing.axes(*frame, 200, "C");
  }
  return {"F9", "Figure 9. The frame at the centroid",
          "Scheme 1 of Table 1 in the platform's frame: x along P2 − P1, z along "
          "(P2 − P1) × (P3 − P1), y = z × x, origin C = (0, 0, 598.33) mm.",
          drawing.str(560, 360, "Figure 9")};
}

Exhibit figure10() {
  std::string html = "<div class=\"row\">";
  for (std::size_t s = 0; s < 3; ++s) {
    const auto& targets = paper_table1()[s].targets;
    const auto frame = centroid_frame(targets);
    if (!frame) continue;
    const LayoutMetrics m = measure_layout(targets);
    SpaceDrawing drawing(-90, 62);
    drawing.loop(circle_of(m.max_radius_mm), "soft dashed");
    const std::vector<Vec3> local = local_coordinates(*frame, targets);
    for (std::size_t i = 0; i < local.size(); ++i) {
      drawing.line(Vec3::Zero(), local[i], "soft");
      drawing.point(local[i], fmt::format("s{}", s + 1), target_name(i));
    }
    drawing.axes({}, 150, "");
    html += fmt::format(
        "<figure>{}<figcaption>S{}: radius {:.2f} mm, symmetry {:.2f} mm</figcaption></figure>",
        drawing.str(330, 300, fmt::format("Scheme {}", s + 1)), s + 1, m.max_radius_mm, m.symmetry_mm);
  }
  return {"F10", "Figure 10. The three schemes in their own frames",
          "The dashed circle has the radius of the farthest "
          "target. Distances to C do not depend on the frame, so Table 2 does not test it.",
          html + "</div>"};
}

}  // namespace

std::vector<Exhibit> frames_exhibits() {
  const Exhibit figure6{"F6", "Figure 6. Steps of the construction",
                        "As Section 2.3 does it, with axes that are at right angles.",
                        flow_chart({"targets p1 … pn in the tracker", "V1 = p2 − p1, V2 = p3 − p1",
                                    "?V1 × V2 ≠ 0", "z = V1 × V2, x = V1, y = z × x, to length 1",
                                    "origin C = mean of all targets", "p′ = Rᵀ (p − C)"},
                                   1, "Steps of the construction of a frame")};
  return {table2(),
          table1(),
          figure6,
          construction("F7", "Figure 7. Origin and first axis", false),
          construction("F8", "Figure 8. Vectors and normal", true),
          figure9(),
          figure10()};
}

}  // namespace asterism
