// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/layout/designer.hpp"

namespace asterism {

/// A layout to score: where it comes from and its targets, in the frame of the body that carries them.
struct NamedLayout {
  std::string name;
  std::vector<Target> targets;
};

/// The targets of the cell's layout task as they stand. Throws InputError when the cell has no such task or
/// no such body.
[[nodiscard]] NamedLayout present_layout(const Cell& cell);

/// From bodies files: the task's body, or the only one that a file has; named by the file where it has just
/// this one layout. Throws InputError when the body is in none of them.
[[nodiscard]] NamedLayout layout_of_file(const Cell& cell, const std::filesystem::path& file);

/// The paper's layouts: its Tables 1 (S1 to S3, six targets) and 9 (S1 to S5, four).
[[nodiscard]] std::vector<NamedLayout> published_layouts();

/// Scores each of them in the cell.
[[nodiscard]] std::vector<LayoutDesign> score_layouts(const Cell& cell,
                                                      const std::vector<NamedLayout>& layouts,
                                                      const DesignerOptions& options);

/// OUT/report.html about layouts that were given, not searched for.
void write_scores(const std::filesystem::path& out, const Cell& cell,
                  const std::vector<LayoutDesign>& designs, const DesignerOptions& options);

/// A search: from a cell to files.
struct DesignJob {
  std::filesystem::path out;
  DesignerOptions options;
  bool resume = false;            // from OUT/checkpoint
  double checkpoint_seconds = 5;  // between two checkpoints; 0 = after each generation
};

struct DesignedLayouts {
  DesignResult result;
  bool stopped = false;  // before its end; it can be resumed
  long long evaluations = 0;
  double searching_s = 0;  // the time before a resumption included
};

/// Asked after each generation; false ends the search there.
using GoOn = std::function<bool(const Optimizer&)>;

/// Searches and writes OUT/report.html, front.csv, layouts/NN/bodies.toml (all bodies of the cell, so that
/// `track --bodies` takes it), summary.json, and OUT/checkpoint all along. `problem` is of `cell` and
/// `job.options`.
[[nodiscard]] DesignedLayouts search_layouts(const Cell& cell, const LayoutProblem& problem,
                                             const DesignJob& job, const GoOn& go_on,
                                             const OptimizerWorkers& workers = {});

/// A design and the whole search as JSON; docs/formats.md tells the keys.
[[nodiscard]] nlohmann::ordered_json json_of_design(const LayoutDesign& design);
[[nodiscard]] nlohmann::ordered_json summary_of(const DesignedLayouts& designed, const Cell& cell,
                                                const DesignerOptions& options);

}  // namespace asterism
