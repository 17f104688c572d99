// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/plan_options.hpp"

namespace asterism {

void describe(PlanOptions& options, OptionVisitor& visit) {
  visit.choice_of("objective", options.objective, {"views", "time"},
                  "what is to be least: views, or the time of views and of the platform's turns");
  visit.choice_of("method", options.method, {"surface", "sphere", "cylinder", "rings"},
                  "where candidates stand: before the surface, on a sphere, a cylinder or rings around it");
  visit.integer("samples", options.samples, {10, 200000}, "places that stand for the surface");
  visit.integer("candidates", options.candidates, {1, 200000}, "viewpoints tried at first");
  visit.integer("rounds", options.rounds, {0, 50}, "of sampling anew for places that stay uncovered");
  visit.integer("candidates_more", options.candidates_more, {1, 200000}, "viewpoints added a round at most");
  visit.number("max_tilt_deg", options.max_tilt_deg, {0, 85}, "of the line of sight from the normal");
  visit.number("ring_pitch_mm", options.ring_pitch_mm, {1, 1e5}, "from ring to ring");
  visit.number("ring_step_deg", options.ring_step_deg, {0.5, 180}, "from station to station of a ring");
  visit.integer("platform_steps", options.platform_steps, {1, 21},
                "attitudes an axis of the platform within its stroke; 1 = it rests");
  visit.integer("targets", options.targets, {3, 64},
                "of the scanner and of the platform that both cameras must see");
  constexpr const char* kNames[kScanLimits] = {
      "range", "field",           "incidence",        "sight",      "clearance", "floor",
      "reach", "scanner_targets", "platform_targets", "uncertainty"};
  SectionVisitor limits("limit", visit);
  for (std::size_t i = 0; i < kScanLimits; ++i) {
    limits.flag(kNames[i], options.asked.on[i], text_of(static_cast<ScanLimit>(i)));
  }
  SectionVisitor cover("cover", visit);
  describe(options.cover, cover);
}

}  // namespace asterism
