// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/motion_figures.hpp"

#include "asterism/reproduction/chain_sight.hpp"
#include "asterism/reproduction/frame_placing.hpp"
#include "asterism/reproduction/plot.hpp"

namespace asterism {

std::vector<Exhibit> motion_exhibits() {
  const std::vector<SightOfRing> sights = watch_chain({}, {.acceptance_rad = kChainAcceptanceRad});
  std::vector<Vec2> visible, coverage, turn_x, turn_y;
  for (const SightOfRing& sight : sights) {
    if (!visible.empty()) visible.emplace_back(sight.time_s, visible.back().y());  // a step, not a slope
    visible.emplace_back(sight.time_s, sight.visible);
    coverage.emplace_back(sight.time_s, sight.coverage);
    turn_x.emplace_back(sight.time_s, deg_from_rad(sight.turn_x_rad));
    turn_y.emplace_back(sight.time_s, deg_from_rad(sight.turn_y_rad));
  }
  Plot seen({"time, s", 0, 12, {}}, {"targets seen", 0, 9, {}}, 370, 270);
  seen.level(4, "needed: 4", "s2 dashed");
  seen.line(visible, "s1");
  Plot field({"time, s", 0, 12, {}}, {"coverage coefficient", 0, 1.1, {}}, 370, 270);
  field.level(0.6, "0.6", "s2 dashed");
  field.line(coverage, "s3");
  Plot motion({"time, s", 0, 12, {}}, {"turn, deg", -20, 20, {}}, 370, 270);
  motion.line(turn_x, "s1");
  motion.line(turn_y, "s2");
  motion.legend({{"s1", "about x"}, {"s2", "about y"}});
  const std::string html = "<div class=\"row\"><figure>" + seen.str("Targets seen over time") +
                           "</figure><figure>" + field.str("Coverage coefficient over time") +
                           "</figure><figure>" + motion.str("Motion of the platform") + "</figure></div>";
  return {
      frame_placing(),
      {"F20", "Figure 20. Targets seen and field of view over the motion",
       "Our own visibility on a model of the cell that gives what the text tells of the figure: two cameras "
       "1 m apart, 2 m away, 60° up, 45° aside; eight targets on a ring of 300 mm, tilted outward by 20°, "
       "counted when both cameras see them up to 65° and the casing does not stand in the way. The paper "
       "gives none of these.",
       html}};
}

}  // namespace asterism
