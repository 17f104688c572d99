// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/island.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

template <class T>
std::vector<double> row(const T& rows, std::size_t i, std::size_t width) {
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(i * width);
  return {first, first + static_cast<std::ptrdiff_t>(width)};
}

}  // namespace

double total_violation(std::span<const double> violations, std::span<const ConstraintInfo> constraints) {
  double sum = 0;
  for (std::size_t c = 0; c < violations.size(); ++c) sum += violations[c] / constraints[c].scale;
  return sum;
}

Island::Island(const OptimizationProblem& problem, const OptimizerOptions& options, BatchEvaluator evaluate,
               int index)
    : problem_(problem),
      options_(options),
      evaluate_(std::move(evaluate)),
      objectives_(problem.objectives()),
      constraints_(problem.constraints()),
      archive_(objectives_.size()),
      selection_(options.survival) {
  if (!evaluate_) evaluate_ = evaluate_batch;
  state_.index = index;
}

void Island::advance(int generations) {
  for (int i = 0; i < generations; ++i) {
    ++state_.generation;
    if (state_.generation == 0) {
      be_born();
    } else {
      breed();
    }
    evaluate_children();
    remember_closest();
    if (options_.archive) archive_children();
    welcome_immigrants();
    select();
  }
}

void Island::evaluate_children() {
  const std::size_t m = objectives_.size(), c = constraints_.size();
  const std::size_t old = state_.genes.size();
  objectives_of_.resize((old + born_) * m);
  violations_of_.resize((old + born_) * c);
  std::ranges::copy(state_.objectives, objectives_of_.begin());
  std::ranges::copy(state_.violations, violations_of_.begin());
  evaluate_(problem_, std::span(children_).first(born_), std::span(objectives_of_).subspan(old * m),
            std::span(violations_of_).subspan(old * c));
  state_.evaluations += static_cast<long long>(born_);
  for (std::size_t i = 0; i < born_; ++i) check_child(i);
}

void Island::check_child(std::size_t child) const {
  const auto refuse = [&](const char* what, const std::string& name, double value, const char* right) {
    throw InputError(fmt::format("{} `{}` of candidate {} in generation {} is {}: it must be {}", what, name,
                                 child + 1, state_.generation, value, right));
  };
  const std::size_t row = state_.genes.size() + child;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    const double value = objectives_of_[row * objectives_.size() + k];
    if (!std::isfinite(value)) refuse("objective", objectives_[k].name, value, "a finite number");
  }
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    const double value = violations_of_[row * constraints_.size() + k];
    if (!(value >= 0 && std::isfinite(value)))
      refuse("the violation of", constraints_[k].name, value, "0 or a finite number above");
  }
}

void Island::archive_children() {
  const std::size_t m = objectives_.size(), c = constraints_.size(), old = state_.genes.size();
  for (std::size_t i = 0; i < born_; ++i) {
    const std::span<const double> violations = std::span(violations_of_).subspan((old + i) * c, c);
    if (std::ranges::any_of(violations, [](double v) { return v > 0; })) continue;
    const std::span<const double> objectives = std::span(objectives_of_).subspan((old + i) * m, m);
    const std::size_t number = free_numbers_.empty() ? archived_genes_.size() : free_numbers_.back();
    if (!archive_.add(objectives, number)) continue;
    if (free_numbers_.empty()) {
      archived_genes_.push_back(children_[i]);
    } else {
      free_numbers_.pop_back();
      archived_genes_[number] = children_[i];
    }
    const std::span<const std::size_t> dropped = archive_.dropped();
    free_numbers_.insert(free_numbers_.end(), dropped.begin(), dropped.end());
  }
}

std::vector<Candidate> Island::archive() const {
  std::vector<Candidate> candidates;
  candidates.reserve(archive_.size());
  for (ParetoArchive::Member& member : archive_.members())
    candidates.push_back({archived_genes_[member.number], std::move(member.objectives),
                          std::vector<double>(constraints_.size(), 0.0), 0});
  return candidates;
}

IslandState Island::state() const {
  IslandState state = state_;
  state.archive = archive();
  return state;
}

void Island::restore(IslandState state) {
  state_ = std::move(state);
  archive_.clear();
  archived_genes_.clear();
  free_numbers_.clear();
  for (Candidate& candidate : state_.archive) {
    archive_.add(candidate.objectives, archived_genes_.size());
    archived_genes_.push_back(std::move(candidate.genes));
  }
  state_.archive.clear();
}

/// Behind the children, unless an equal one lives here already.
void Island::welcome_immigrants() {
  const auto is_known = [&](const Genes& genes) {
    return std::ranges::find(state_.genes, genes) != state_.genes.end() ||
           std::find(children_.begin(), children_.begin() + static_cast<std::ptrdiff_t>(born_), genes) !=
               children_.begin() + static_cast<std::ptrdiff_t>(born_);
  };
  contenders_ = state_.genes.size() + born_;
  for (Candidate& immigrant : state_.immigrants) {
    if (options_.remove_duplicates && is_known(immigrant.genes)) continue;
    const std::size_t place = contenders_++ - state_.genes.size();
    if (place >= children_.size()) children_.resize(place + 1);
    children_[place].swap(immigrant.genes);
    objectives_of_.insert(objectives_of_.end(), immigrant.objectives.begin(), immigrant.objectives.end());
    violations_of_.insert(violations_of_.end(), immigrant.violations.begin(), immigrant.violations.end());
  }
  state_.immigrants.clear();
}

void Island::select() {
  const std::size_t m = objectives_.size(), c = constraints_.size(), old = state_.genes.size();
  const auto genes_of = [&](std::size_t i) -> Genes& {
    return i < old ? state_.genes[i] : children_[i - old];
  };
  breach_.clear();
  niches_.clear();
  bool has_niches = false;
  for (std::size_t i = 0; i < contenders_; ++i) {
    if (c > 0) breach_.push_back(total_violation(std::span(violations_of_).subspan(i * c, c), constraints_));
    niches_.push_back(problem_.niche_of(genes_of(i)));
    has_niches = has_niches || niches_[i] != niches_[0];
  }
  if (!has_niches) niches_.clear();
  const auto survivors =
      selection_({objectives_of_, m, breach_, niches_}, static_cast<std::size_t>(options_.population));

  next_genes_.resize(survivors.size());
  state_.objectives.clear();
  state_.violations.clear();
  state_.rank.clear();
  state_.spread.clear();
  for (std::size_t k = 0; k < survivors.size(); ++k) {
    const std::size_t i = survivors[k].index;
    next_genes_[k].swap(genes_of(i));
    for (std::size_t j = 0; j < m; ++j) state_.objectives.push_back(objectives_of_[i * m + j]);
    for (std::size_t j = 0; j < c; ++j) state_.violations.push_back(violations_of_[i * c + j]);
    state_.rank.push_back(survivors[k].rank);
    state_.spread.push_back(survivors[k].spread);
  }
  state_.genes.swap(next_genes_);
}

/// While no candidate is feasible, who comes nearest: the elder among equals.
void Island::remember_closest() {
  const std::size_t m = objectives_.size(), c = constraints_.size(), old = state_.genes.size();
  if (c == 0 || (state_.generation > 0 && state_.closest.objectives.empty())) return;
  for (std::size_t i = 0; i < born_; ++i) {
    const double breach = total_violation(std::span(violations_of_).subspan((old + i) * c, c), constraints_);
    if (breach == 0) {
      state_.closest = {};
      return;
    }
    if (!state_.closest.objectives.empty() &&
        !(breach < total_violation(state_.closest.violations, constraints_)))
      continue;
    state_.closest = {children_[i], row(objectives_of_, old + i, m), row(violations_of_, old + i, c), 0};
  }
}

bool Island::is_feasible(std::size_t i) const {
  const std::size_t c = constraints_.size();
  return std::ranges::none_of(std::span(state_.violations).subspan(i * c, c), [](double v) { return v > 0; });
}

Candidate Island::candidate(std::size_t i) const {
  return {state_.genes[i], row(state_.objectives, i, objectives_.size()),
          row(state_.violations, i, constraints_.size()), state_.rank[i]};
}

std::vector<Candidate> Island::emigrants(std::size_t count) const {
  std::vector<std::uint32_t> best(state_.genes.size());
  std::iota(best.begin(), best.end(), 0U);
  std::ranges::stable_sort(best, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(state_.rank[a], -state_.spread[a]) < std::pair(state_.rank[b], -state_.spread[b]);
  });
  std::vector<Candidate> sent;
  for (const std::uint32_t i : best) {
    if (sent.size() < count) sent.push_back(candidate(i));
  }
  return sent;
}

}  // namespace asterism
