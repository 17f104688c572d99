// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/optimizer_options.hpp"

#include <fmt/format.h>

#include "asterism/core/result.hpp"

namespace asterism {
void describe(OptimizerOptions& options, OptionVisitor& visit) {
  visit.integer("population", options.population, {2, 1e6}, "candidates of each island");
  visit.integer("generations", options.generations, {0, 1e9}, "stop after so many generations");
  visit.integer("evaluations", options.evaluations, {0, 2e9}, "stop after so many evaluations; 0: no limit");
  visit.number("seconds", options.seconds, {0, 1e9}, "stop after so long; 0: no limit");
  visit.integer("stagnation_generations", options.stagnation_generations, {0, 1e9},
                "stop when the hypervolume hardly grew over so many generations; 0: never");
  visit.number("stagnation_gain", options.stagnation_gain, {0, 1},
               "relative growth of the hypervolume that still counts");
  visit.choice_of("survival", options.survival,
                  {"automatic", "crowding", "hypervolume-contribution", "reference-points"},
                  "who of a front survives; automatic: hypervolume up to three objectives, then points");
  visit.flag("archive", options.archive, "keep every non-dominated candidate that was found");
  visit.flag("remove_duplicates", options.remove_duplicates, "breed a child anew that equals another");
  visit.integer("islands", options.islands, {1, 65536}, "populations that exchange candidates along a ring");
  visit.integer("migration_interval", options.migration_interval, {1, 1e6}, "generations between exchanges");
  visit.integer("migrants", options.migrants, {0, 1e6}, "candidates sent to the next island");
}

OptimizerOptions deb2002() {
  OptimizerOptions options;
  options.survival = Survival::Crowding;
  options.archive = false;
  options.remove_duplicates = false;
  return options;
}

void check(const OptimizerOptions& options) {
  OptimizerOptions checked = options;
  LimitsCheck limits;
  describe(checked, limits);
  if (options.islands > 1 && options.migrants > options.population)
    throw InputError(fmt::format("migrants is {} but a population has only {} candidates", options.migrants,
                                 options.population));
}

std::string identity(const OptimizerOptions& o) {
  return fmt::format(
      "population {}, survival {}, archive {}, remove_duplicates {}, islands {}, migration_interval {}, "
      "migrants {}, seed {}",
      o.population, static_cast<int>(o.survival), o.archive, o.remove_duplicates, o.islands,
      o.islands > 1 ? o.migration_interval : 0, o.islands > 1 ? o.migrants : 0, o.seed);
}

}  // namespace asterism
