// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

namespace asterism {

void describe(DetectionOptions& options, OptionVisitor& visit) {
  visit.choice_of("polarity", options.polarity, {"bright", "dark"},
                  "discs brighter or darker than what surrounds them");
  visit.number("min_diameter_px", options.min_diameter_px, {1.5, 1e4},
               "smallest minor axis of a disc's image");
  visit.number("max_diameter_px", options.max_diameter_px, {3, 1e4}, "largest major axis of a disc's image");
  visit.number("max_aspect", options.max_aspect, {1, 20},
               "largest ratio of the axes; 4 is a tilt of 75 degrees");
  visit.number("min_contrast_levels", options.min_contrast_levels, {1, 1e4},
               "grey steps a disc must stand out from its background by");
  visit.number("min_contrast_noise", options.min_contrast_noise, {3, 1e4},
               "the same in standard deviations of the local noise; the larger of both counts");
  visit.number("min_fill", options.min_fill, {0, 1},
               "least area over that of the ellipse with the same moments");
  visit.number("min_edge_support", options.min_edge_support, {0, 1},
               "least share of the outline where the grey level falls as at an edge");
  visit.number("blur_px", options.blur_px, {0, 20}, "standard deviation of the edge's blur; 0 = fitted");
  visit.number("blur_held_below_px", options.blur_held_below_px, {0, 100},
               "semi-axis below which the blur is held at that of larger discs");
}

}  // namespace asterism
