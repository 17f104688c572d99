// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>

#include "asterism/core/result.hpp"
#include "asterism/geometry/congruence.hpp"

namespace asterism {
namespace {

using Word = std::uint64_t;
using Bits = Word*;

/// Correspondences as nodes of a graph, their compatibility as one row of bits a node.
struct Graph {
  std::vector<Correspondence> nodes;
  std::size_t words = 0;
  std::vector<Word> rows;

  [[nodiscard]] const Word* row(std::size_t node) const { return rows.data() + node * words; }
};

int count_common(const Word* a, const Word* b, std::size_t words) {
  int count = 0;
  for (std::size_t w = 0; w < words; ++w) count += std::popcount(a[w] & b[w]);
  return count;
}

template <class Visit>
void for_each_bit(const Word* bits, std::size_t words, Visit visit) {
  for (std::size_t w = 0; w < words; ++w) {
    for (Word rest = bits[w]; rest != 0; rest &= rest - 1) {
      visit(w * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

class Enumeration {
 public:
  Enumeration(const Graph& graph, const CliqueLimits& limits) : graph_(graph), limits_(limits) {}

  Cliques run() {
    const std::size_t words = graph_.words;
    std::vector<Word> start(2 * words, 0);
    for (std::size_t node = 0; node < graph_.nodes.size(); ++node) start[node / 64] |= Word{1} << (node % 64);
    expand(start.data(), start.data() + words, 0);
    return std::move(cliques_);
  }

 private:
  void expand(Bits candidates, Bits excluded, std::size_t depth) {
    if (work_ > limits_.max_work) cliques_.complete = false;
    if (!cliques_.complete) return;
    const std::size_t words = graph_.words;
    work_ += words;
    const int left = count_common(candidates, candidates, words);
    if (static_cast<int>(chosen_.size()) + left < limits_.min_size) return;
    if (left == 0) {
      if (count_common(excluded, excluded, words) == 0) report();
      return;
    }
    if (scratch_.size() <= depth) scratch_.emplace_back(3 * words);
    const Bits inner = scratch_[depth].data();
    const Bits inner_excluded = inner + words;
    const Bits branch = inner + 2 * words;
    const Word* beside = graph_.row(pivot(candidates, excluded));
    for (std::size_t w = 0; w < words; ++w) branch[w] = candidates[w] & ~beside[w];
    for_each_bit(branch, words, [&](std::size_t node) {
      const Word* row = graph_.row(node);
      for (std::size_t w = 0; w < words; ++w) {
        inner[w] = candidates[w] & row[w];
        inner_excluded[w] = excluded[w] & row[w];
      }
      chosen_.push_back(node);
      expand(inner, inner_excluded, depth + 1);
      chosen_.pop_back();
      candidates[node / 64] &= ~(Word{1} << (node % 64));
      excluded[node / 64] |= Word{1} << (node % 64);
    });
  }

  [[nodiscard]] std::size_t pivot(const Word* candidates, const Word* excluded) {
    std::size_t best = 0;
    int most = -1;
    const auto consider = [&](std::size_t node) {
      const int common = count_common(candidates, graph_.row(node), graph_.words);
      work_ += graph_.words;
      if (common <= most) return;
      most = common;
      best = node;
    };
    for_each_bit(candidates, graph_.words, consider);
    for_each_bit(excluded, graph_.words, consider);
    return best;
  }

  void report() {
    if (cliques_.found.size() >= limits_.max_cliques) {
      cliques_.complete = false;
      return;
    }
    std::vector<Correspondence> clique;
    clique.reserve(chosen_.size());
    for (const std::size_t node : chosen_) clique.push_back(graph_.nodes[node]);
    std::sort(clique.begin(), clique.end());
    cliques_.found.push_back(std::move(clique));
  }

  const Graph& graph_;
  const CliqueLimits& limits_;
  Cliques cliques_;
  std::vector<std::size_t> chosen_;
  std::vector<std::vector<Word>> scratch_;
  std::size_t work_ = 0;
};

/// How many partners each correspondence has once those with too few are gone; 0 for the dropped.
std::vector<int> partners_of(std::span<const CompatiblePair> pairs, std::size_t pattern_points,
                             std::size_t scene_points, int fewest) {
  const auto index = [&](const Correspondence& c) {
    return static_cast<std::size_t>(c.scene) * pattern_points + static_cast<std::size_t>(c.pattern);
  };
  std::vector<int> partners(pattern_points * scene_points, 0);
  for (const auto& pair : pairs) {
    ++partners[index(pair.first)];
    ++partners[index(pair.second)];
  }
  std::vector<CompatiblePair> alive(pairs.begin(), pairs.end());
  for (bool dropped = true; dropped;) {
    const auto weak = [&](const CompatiblePair& pair) {
      const std::size_t a = index(pair.first);
      const std::size_t b = index(pair.second);
      if (partners[a] >= fewest && partners[b] >= fewest) return false;
      --partners[a];
      --partners[b];
      return true;
    };
    dropped = std::erase_if(alive, weak) > 0;
  }
  return partners;
}

}  // namespace

Cliques grow_cliques(std::span<const CompatiblePair> pairs, std::size_t pattern_points,
                     std::size_t scene_points, const CliqueLimits& limits) {
  require(limits.min_size >= 2, "a clique has two correspondences or more");
  if (pairs.empty()) return {};
  const auto partners = partners_of(pairs, pattern_points, scene_points, limits.min_size - 1);
  std::vector<int> node_of(partners.size(), -1);
  Graph graph;
  for (std::size_t i = 0; i < partners.size(); ++i) {
    if (partners[i] < limits.min_size - 1) continue;
    node_of[i] = static_cast<int>(graph.nodes.size());
    graph.nodes.push_back({static_cast<int>(i % pattern_points), static_cast<int>(i / pattern_points)});
  }
  if (graph.nodes.empty()) return {};
  if (graph.nodes.size() > limits.max_nodes) return {{}, false};

  graph.words = (graph.nodes.size() + 63) / 64;
  graph.rows.assign(graph.nodes.size() * graph.words, 0);
  const auto node = [&](const Correspondence& c) {
    return node_of[static_cast<std::size_t>(c.scene) * pattern_points + static_cast<std::size_t>(c.pattern)];
  };
  for (const auto& pair : pairs) {
    if (node(pair.first) < 0 || node(pair.second) < 0) continue;
    const auto a = static_cast<std::size_t>(node(pair.first));
    const auto b = static_cast<std::size_t>(node(pair.second));
    graph.rows[a * graph.words + b / 64] |= Word{1} << (b % 64);
    graph.rows[b * graph.words + a / 64] |= Word{1} << (a % 64);
  }
  return Enumeration(graph, limits).run();
}

}  // namespace asterism
