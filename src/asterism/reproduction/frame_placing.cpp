// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/frame_placing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/frame_chain.hpp"
#include "asterism/cell/paper_layouts.hpp"
#include "asterism/core/result.hpp"
#include "asterism/reproduction/chain_cell.hpp"
#include "asterism/reproduction/drawing.hpp"

namespace asterism {
namespace {

Cell placed_cell() { return chain_cell(chain_targets(paper_table1().front().targets)); }

std::vector<Vec3> circle_at(double radius_mm, double height_mm) {
  std::vector<Vec3> points;
  for (int i = 0; i < 72; ++i) {
    const double angle = rad_from_deg(5.0 * i);
    points.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), height_mm);
  }
  return points;
}

void draw_casing(SpaceDrawing& drawing) {
  const CasingShape casing;
  drawing.loop(circle_at(casing.bottom_radius_mm, 0), "soft");
  drawing.loop(circle_at(casing.top_radius_mm, casing.height_mm), "soft");
  for (int k = 0; k < 4; ++k) {
    const Vec3 outward(std::cos(rad_from_deg(90.0 * k)), std::sin(rad_from_deg(90.0 * k)), 0);
    drawing.line(casing.bottom_radius_mm * outward,
                 casing.top_radius_mm * outward + Vec3(0, 0, casing.height_mm), "soft");
  }
}

std::string text_of(const RigidMotion& motion) {
  const Vec3 turn = log_rotation(motion.rotation);
  const Vec3 t = motion.translation.array().round() + 0.0;  // so that no −0 is told
  return fmt::format("({:.0f}, {:.0f}, {:.0f}) mm; turned by {:.2f}°", t.x(), t.y(), t.z(),
                     deg_from_rad(turn.norm()));
}

}  // namespace

Exhibit frame_placing() {
  const FrameChain chain = frame_chain_at(placed_cell(), 0);
  require(chain.workpiece_from_scanner && chain.platform_from_target_centroid,
          "the paper's cell has platform, workpiece and scanner");
  const RigidMotion platform_from_tracker = chain.tracker_from_platform->inverse();
  SpaceDrawing drawing(-35, 16);
  draw_casing(drawing);
  drawing.axes({}, 260, "O_p, O_g");
  drawing.axes(*chain.platform_from_target_centroid, 200, "O_1");
  drawing.axes(platform_from_tracker, 260, "O_c");
  drawing.axes(platform_from_tracker * *chain.tracker_from_scanner, 200, "O_s");
  drawing.line(platform_from_tracker.translation, {0, 0, 600}, "soft dashed");
  const std::string table =
      html_table({{"motion", "where the second frame stands in the first"},
                  {"tracker_from_platform (O_c, O_p)", text_of(*chain.tracker_from_platform)},
                  {"platform_from_target_centroid (O_p, O_1)", text_of(*chain.platform_from_target_centroid)},
                  {"platform_from_workpiece (O_p, O_g)", text_of(*chain.platform_from_workpiece)},
                  {"tracker_from_scanner (O_c, O_s)", text_of(*chain.tracker_from_scanner)},
                  {"workpiece_from_scanner (O_g, O_s)", text_of(*chain.workpiece_from_scanner)}});
  return {
      "F11", "Figure 11. The measurement frames",
      "Placed by our model of the cell: tracker 2 m away, 60° up, 45° aside; the scanner at the first "
      "station of Table 15; the part's frame on the platform's. The paper gives none of these transforms; "
      "that the chain of Eqs. 19 to 22 closes does not hang on them.",
      drawing.str(620, 420, "Placing of the measurement frames") + table};
}

double chain_misclosure_mm() {
  const Cell cell = placed_cell();
  double largest = 0;
  for (int i = 0; i <= 24; ++i) {
    const FrameChain chain = frame_chain_at(cell, 0.5 * i);
    const Vec3 on_part(0, 0, 500);
    const Vec3 straight = *chain.tracker_from_scanner * on_part;
    const Vec3 over_part = *chain.tracker_from_platform *
                           (*chain.platform_from_workpiece * (*chain.workpiece_from_scanner * on_part));
    largest = std::max(largest, (straight - over_part).norm());
  }
  return largest;
}

}  // namespace asterism
