// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/accuracy_options.hpp"

namespace asterism {

void describe(AccuracyOptions& options, OptionVisitor& visit) {
  visit.number("sigma_px", options.sigma_px, {1e-4, 10}, "of a target's centre in an image, each axis");
  visit.number("map_sigma_mm", options.map_sigma_mm, {0, 10},
               "of the targets' coordinates, each axis, where they state no covariance");
  visit.flag("single_views", options.single_views, "count targets that only one camera sees");
  visit.number("max_sigma_deg", options.max_sigma_deg, {1e-4, 90},
               "rotation's sigma beyond which a pose counts as not determined");
  visit.integer("losses", options.losses, {0, 2}, "any so many targets are lost");
}

}  // namespace asterism
