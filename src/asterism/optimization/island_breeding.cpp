// SPDX-License-Identifier: Apache-2.0
#include <numeric>
#include <utility>

#include "asterism/core/random.hpp"
#include "asterism/optimization/island.hpp"
#include "asterism/optimization/share_work.hpp"

namespace asterism {
namespace {

/// What a stream of random numbers is for; bits 4 to 7 of its key count attempts.
enum Purpose : std::uint32_t { kSample, kMothers, kFathers, kVary };
constexpr int kAttempts = 4;  // to breed a child that nobody equals

RandomStream stream(std::uint64_t seed, int island, int generation, std::size_t individual, Purpose purpose,
                    int attempt = 0) {
  const auto key = (static_cast<std::uint32_t>(island) << 8) | (static_cast<std::uint32_t>(attempt) << 4);
  const std::uint64_t index = (static_cast<std::uint64_t>(generation) << 32) | individual;
  return {seed, index, key | purpose};
}

/// Fisher and Yates.
void shuffle(std::vector<std::uint32_t>& items, RandomStream random) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
}

bool wins(const IslandState& island, std::uint32_t a, std::uint32_t b) {
  if (island.rank[a] != island.rank[b]) return island.rank[a] < island.rank[b];
  return island.spread[a] >= island.spread[b];
}

}  // namespace

/// The problem's seeds are dealt to the islands in turn; the rest is random.
void Island::be_born() {
  const auto count = static_cast<std::size_t>(options_.population);
  const auto islands = static_cast<std::size_t>(options_.islands);
  const std::vector<Genes> seeds = problem_.seeds();
  children_.clear();
  for (auto s = static_cast<std::size_t>(state_.index); s < seeds.size(); s += islands) {
    if (children_.size() < count) children_.push_back(seeds[s]);
  }
  const std::size_t seeded = children_.size();
  children_.resize(count);
  share_work(count - seeded, [&](std::size_t i) {
    RandomStream random = stream(options_.seed, state_.index, 0, i, kSample);
    children_[seeded + i] = problem_.sample(random);
  });
  born_ = count;
}

void Island::breed() {
  choose_parents();
  const std::size_t count = state_.genes.size();
  if (children_.size() < parents_.size()) children_.resize(parents_.size());
  share_work(parents_.size() / 2, [&](std::size_t pair) {
    RandomStream random = stream(options_.seed, state_.index, state_.generation, 2 * pair, kVary);
    problem_.vary(state_.genes[parents_[2 * pair]], state_.genes[parents_[2 * pair + 1]], children_[2 * pair],
                  children_[2 * pair + 1], random);
  });
  born_ = count;
  if (options_.remove_duplicates) replace_duplicates();
}

/// Binary tournaments: in each of two shuffled orders every candidate meets its neighbour.
void Island::choose_parents() {
  const std::size_t count = state_.genes.size();
  parents_.resize(count + count % 2);
  shuffled_.resize(count);
  for (const Purpose purpose : {kMothers, kFathers}) {
    std::iota(shuffled_.begin(), shuffled_.end(), 0U);
    shuffle(shuffled_, stream(options_.seed, state_.index, state_.generation, 0, purpose));
    const std::size_t half = purpose == kMothers ? 0 : parents_.size() / 2;
    for (std::size_t i = 0; i < parents_.size() / 2; ++i) {
      const std::uint32_t a = shuffled_[(2 * i) % count];
      const std::uint32_t b = shuffled_[(2 * i + 1) % count];
      parents_[half + i] = wins(state_, a, b) ? a : b;
    }
  }
}

/// A child that equals a living candidate or an elder child is bred anew with other random numbers, and
/// left out if that does not help, as in a search space that is exhausted.
void Island::replace_duplicates() {
  duplicates_.clear(2 * state_.genes.size() + 2);
  for (const Genes& genes : state_.genes) duplicates_.add(genes);
  std::size_t kept = 0;
  for (std::size_t child = 0; child < born_; ++child) {
    const std::uint32_t mother = parents_[child - child % 2], father = parents_[child - child % 2 + 1];
    std::swap(children_[kept], children_[child]);
    bool is_new = duplicates_.add(children_[kept]);
    for (int attempt = 1; !is_new && attempt < kAttempts; ++attempt) {
      RandomStream random = stream(options_.seed, state_.index, state_.generation, child, kVary, attempt);
      problem_.vary(state_.genes[mother], state_.genes[father], children_[kept], sibling_, random);
      is_new = duplicates_.add(children_[kept]);
    }
    if (is_new) ++kept;
  }
  born_ = kept;
}

}  // namespace asterism
