// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/archive.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFullBlock = 48;

bool at_most(const double* a, const double* b, std::size_t m) {
  for (std::size_t k = 0; k < m; ++k)
    if (a[k] > b[k]) return false;
  return true;
}

}  // namespace

ParetoArchive::ParetoArchive(std::size_t objectives) : m_(objectives) {
  require(objectives > 0, "there is something to minimise");
}

bool ParetoArchive::add(std::span<const double> objectives, std::size_t number) {
  require(objectives.size() == m_, "a point has as many objectives as its archive");
  for (const double value : objectives) require(value == value, "objectives are numbers");
  dropped_.clear();
  const bool added = m_ == 2 ? add_to_stairs(objectives, number) : add_to_blocks(objectives.data(), number);
  size_ += added ? 1 : 0;
  size_ -= dropped_.size();
  return added;
}

void ParetoArchive::clear() {
  size_ = 0;
  stairs_.clear();
  blocks_.clear();
  dropped_.clear();
}

std::vector<ParetoArchive::Member> ParetoArchive::members() const {
  std::vector<Member> members;
  for (const auto& [first, step] : stairs_) members.push_back({{first, step.second}, step.number});
  for (const Block& block : blocks_)
    for (std::size_t i = 0; i < block.numbers.size(); ++i) {
      const double* point = block.points.data() + i * m_;
      members.push_back({{point, point + m_}, block.numbers[i]});
    }
  std::ranges::sort(members, {}, &Member::objectives);
  return members;
}

bool ParetoArchive::add_to_stairs(std::span<const double> objectives, std::size_t number) {
  const auto after = stairs_.upper_bound(objectives[0]);
  if (after != stairs_.begin() && std::prev(after)->second.second <= objectives[1]) return false;
  auto first = after;
  if (first != stairs_.begin() && std::prev(first)->first == objectives[0]) --first;
  auto last = first;
  for (; last != stairs_.end() && last->second.second >= objectives[1]; ++last)
    dropped_.push_back(last->second.number);
  stairs_.emplace_hint(stairs_.erase(first, last), objectives[0], Step{objectives[1], number});
  return true;
}

bool ParetoArchive::add_to_blocks(const double* point, std::size_t number) {
  if (covered_last_ < blocks_.size() && is_covered_in(blocks_[covered_last_], point)) return false;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (is_covered_in(blocks_[b], point)) {
      covered_last_ = b;
      return false;
    }
  for (Block& block : blocks_) drop_covered(block, point);
  std::erase_if(blocks_, [](const Block& block) { return block.numbers.empty(); });

  if (blocks_.empty()) blocks_.push_back({{}, {}, {point, point + m_}, {point, point + m_}});
  const std::size_t at = nearest_block(point);
  Block& block = blocks_[at];
  block.points.insert(block.points.end(), point, point + m_);
  block.numbers.push_back(number);
  for (std::size_t k = 0; k < m_; ++k) {
    block.low[k] = std::min(block.low[k], point[k]);
    block.high[k] = std::max(block.high[k], point[k]);
  }
  if (block.numbers.size() > kFullBlock) split(at);
  return true;
}

/// Whether a point of the block is as good in all objectives.
bool ParetoArchive::is_covered_in(const Block& block, const double* point) const {
  if (!at_most(block.low.data(), point, m_)) return false;
  if (at_most(block.high.data(), point, m_)) return true;
  for (std::size_t i = 0; i < block.points.size(); i += m_)
    if (at_most(block.points.data() + i, point, m_)) return true;
  return false;
}

void ParetoArchive::drop_covered(Block& block, const double* point) {
  if (!at_most(point, block.high.data(), m_)) return;
  const std::size_t before = dropped_.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < block.numbers.size(); ++i) {
    const double* other = block.points.data() + i * m_;
    if (at_most(point, other, m_)) {
      dropped_.push_back(block.numbers[i]);
      continue;
    }
    std::copy_n(other, m_, block.points.data() + kept * m_);
    block.numbers[kept++] = block.numbers[i];
  }
  if (dropped_.size() == before) return;
  block.points.resize(kept * m_);
  block.numbers.resize(kept);
  if (kept > 0) fit_corners(block);
}

/// The block whose middle is nearest, each objective measured in widths of the block.
std::size_t ParetoArchive::nearest_block(const double* point) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    double distance = 0;
    for (std::size_t k = 0; k < m_; ++k) {
      const double width = block.high[k] - block.low[k];
      const double offset = point[k] - block.low[k] / 2 - block.high[k] / 2;
      if (width > 0) distance += (offset / width) * (offset / width);
    }
    if (distance < least) {
      least = distance;
      nearest = b;
    }
  }
  return nearest;
}

/// Halves a block along its longest side, measured against that of all blocks.
void ParetoArchive::split(std::size_t at) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t k = 0; k < m_; ++k) {
    double low = blocks_[at].low[k], high = blocks_[at].high[k];
    for (const Block& block : blocks_) {
      low = std::min(low, block.low[k]);
      high = std::max(high, block.high[k]);
    }
    const double share = high > low ? (blocks_[at].high[k] - blocks_[at].low[k]) / (high - low) : 0;
    if (share > most) {
      most = share;
      longest = k;
    }
  }
  const Block whole = std::move(blocks_[at]);
  std::vector<std::size_t> order(whole.numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return whole.points[i * m_ + longest]; });
  Block halves[2];
  for (std::size_t i = 0; i < order.size(); ++i) {
    Block& half = halves[i < order.size() / 2 ? 0 : 1];
    const double* point = whole.points.data() + order[i] * m_;
    half.points.insert(half.points.end(), point, point + m_);
    half.numbers.push_back(whole.numbers[order[i]]);
  }
  for (Block& half : halves) fit_corners(half);
  blocks_[at] = std::move(halves[0]);
  blocks_.push_back(std::move(halves[1]));
}

void ParetoArchive::fit_corners(Block& block) const {
  block.low.assign(block.points.begin(), block.points.begin() + static_cast<std::ptrdiff_t>(m_));
  block.high = block.low;
  for (std::size_t i = m_; i < block.points.size(); ++i) {
    block.low[i % m_] = std::min(block.low[i % m_], block.points[i]);
    block.high[i % m_] = std::max(block.high[i % m_], block.points[i]);
  }
}

}  // namespace asterism
