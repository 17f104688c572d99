// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/core/progress.hpp"

namespace asterism {

/// Choose columns of least total cost so that every row (or a share of their weight) is covered: views that
/// see samples. The set covering problem; with a share below 1, its partial form; with demands, multi-cover;
/// with groups, each column needs its group to be opened, which costs once (facility location): a turn of a
/// platform. A row that no column covers, weighs 0 or demands 0 counts nowhere.
struct SetCoverProblem {
  std::size_t rows = 0;
  std::vector<std::vector<std::uint32_t>> columns;  // the rows each covers, ascending, none twice
  std::vector<double> cost;                         // by column, positive; empty = 1 each
  std::vector<double> weight;                       // by row, not negative; empty = 1 each
  std::vector<int> demand;           // by row: so many columns, but never more than can; empty = 1 each
  double share = 1;                  // of the weight that all columns together cover (to 1e-9 of it)
  std::vector<std::uint32_t> group;  // by column; empty = none
  std::vector<double> group_cost;    // by group; a group that is open already costs 0
};

struct SetCoverOptions {
  int local_steps = 200000;         // of the row-weighting local search; 0 = none
  double exact_s = 20;              // time of the exact part (CBC); 0 = none: then the bound is the dual one
  double gap = 0;                   // good enough: the exact part ends at this relative gap
  bool exact_deterministic = true;  // ends by counts of nodes, not by the clock, so that results repeat
};
void describe(SetCoverOptions& options, OptionVisitor& visit);

struct SetCover {
  std::vector<std::uint32_t> chosen;  // columns, in the order of what each adds
  double cost = 0;
  double bound = 0;  // no cover costs less: of the linear relaxation, the dual, or the exact search; rounded
                     // up where all costs are whole
  bool optimal = false;
  double covered = 0, coverable = 0;            // weight
  double greedy_cost = 0, local_cost = 0;       // after those stages; what each was worth
  std::size_t rows_left = 0, columns_left = 0;  // after the reductions
  std::string exact;  // what became of the exact part, in words: "optimal after 312 nodes", "not asked"

  [[nodiscard]] double gap() const { return cost > 0 ? (cost - bound) / cost : 0; }
};

/// Reductions (rows alike, dominated rows and columns), lazy greedy (Chvátal 1979; Minoux 1978), what it need
/// not have, row-weighting local search (Gao et al. 2015), then CBC. Throws InputError for rows, costs or
/// groups that are not there.
[[nodiscard]] SetCover solve(const SetCoverProblem& problem, const SetCoverOptions& options,
                             std::uint64_t seed, const Progress& progress);

}  // namespace asterism
