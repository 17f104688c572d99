// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/optimization/archive.hpp"
#include "asterism/optimization/duplicates.hpp"
#include "asterism/optimization/optimizer.hpp"
#include "asterism/optimization/survival.hpp"

namespace asterism {

/// Of a candidate: each violation over its constraint's scale, added up. 0 = feasible.
[[nodiscard]] double total_violation(std::span<const double> violations,
                                     std::span<const ConstraintInfo> constraints);

/// One population and its descendants: choose parents, breed, evaluate, keep the best. A generation is a
/// pure function of the problem, the options and the state; memory is reused from one to the next, so that
/// genomes of one length are bred without allocation.
class Island {
 public:
  Island(const OptimizationProblem& problem, const OptimizerOptions& options, BatchEvaluator evaluate,
         int index);

  /// So many generations; the first population counts as one.
  void advance(int generations);

  [[nodiscard]] IslandState state() const;
  void restore(IslandState state);

  /// The best of the first front, those that stand most alone first.
  [[nodiscard]] std::vector<Candidate> emigrants(std::size_t count) const;
  /// They compete from the next generation on.
  void receive(std::vector<Candidate> immigrants) { state_.immigrants = std::move(immigrants); }

  /// In lexicographic order of their objectives.
  [[nodiscard]] std::vector<Candidate> archive() const;
  /// Without the archive, which `state` adds.
  [[nodiscard]] const IslandState& population() const { return state_; }
  [[nodiscard]] Candidate candidate(std::size_t i) const;
  [[nodiscard]] bool is_feasible(std::size_t i) const;

 private:
  void be_born();
  void breed();
  void choose_parents();
  void replace_duplicates();
  void evaluate_children();
  void check_child(std::size_t child) const;
  void archive_children();
  void welcome_immigrants();
  void select();
  void remember_closest();

  const OptimizationProblem& problem_;
  OptimizerOptions options_;
  BatchEvaluator evaluate_;
  std::vector<ObjectiveInfo> objectives_;
  std::vector<ConstraintInfo> constraints_;

  IslandState state_;
  ParetoArchive archive_;
  std::vector<Genes> archived_genes_;      // by the number given to `archive_`
  std::vector<std::size_t> free_numbers_;  // of candidates that were driven out

  std::vector<std::uint32_t> parents_;  // two of each pair of children
  std::vector<std::uint32_t> shuffled_;
  Duplicates duplicates_;
  std::vector<Genes> children_;  // then the immigrants
  Genes sibling_;
  std::size_t born_ = 0;        // children to evaluate, the first of `children_`
  std::size_t contenders_ = 0;  // parents, children and immigrants
  std::vector<double> objectives_of_, violations_of_, breach_;  // of the contenders
  std::vector<std::size_t> niches_;
  SurvivorSelection selection_;
  std::vector<Genes> next_genes_;
};

}  // namespace asterism
