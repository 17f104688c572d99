// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/hypervolume_truncation.hpp"

#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFF;

}  // namespace

std::span<const std::uint32_t> FrontThinning::operator()(std::span<const double> x, std::span<const double> y,
                                                         std::size_t keep) {
  const std::size_t count = x.size();
  require(y.size() == count && keep <= count, "a front's points have two coordinates and enough are there");
  previous_.resize(count);
  next_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    previous_[i] = i == 0 ? kNobody : i - 1;
    next_[i] = i + 1 == count ? kNobody : i + 1;
  }
  std::uint32_t head = 0;
  if (keep < count) {
    heap_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) heap_[i] = {area(x, y, i), i};
    for (std::size_t i = count / 2; i-- > 0;) sift_down(i);
  }
  for (std::size_t left = count; left > keep;) {
    const Share least = heap_.front();
    const double now = area(x, y, least.at);
    if (now > least.area) {  // a neighbour has gone since
      heap_.front().area = now;
    } else {
      const std::uint32_t before = previous_[least.at];
      const std::uint32_t after = next_[least.at];
      (before == kNobody ? head : next_[before]) = after;
      if (after != kNobody) previous_[after] = before;
      heap_.front() = heap_.back();
      heap_.pop_back();
      --left;
    }
    if (!heap_.empty()) sift_down(0);
  }
  kept_.clear();
  contributions_.clear();
  for (std::uint32_t i = keep > 0 ? head : kNobody; i != kNobody; i = next_[i]) {
    kept_.push_back(i);
    contributions_.push_back(area(x, y, i));
  }
  return kept_;
}

double FrontThinning::area(std::span<const double> x, std::span<const double> y, std::uint32_t at) const {
  if (previous_[at] == kNobody || next_[at] == kNobody) return std::numeric_limits<double>::infinity();
  return (x[next_[at]] - x[at]) * (y[previous_[at]] - y[at]);
}

void FrontThinning::sift_down(std::size_t at) {
  const Share moved = heap_[at];
  const auto less = [](const Share& a, const Share& b) {
    return a.area < b.area || (a.area == b.area && a.at < b.at);
  };
  for (;;) {
    std::size_t child = 2 * at + 1;
    if (child >= heap_.size()) break;
    if (child + 1 < heap_.size() && less(heap_[child + 1], heap_[child])) ++child;
    if (!less(heap_[child], moved)) break;
    heap_[at] = heap_[child];
    at = child;
  }
  heap_[at] = moved;
}

}  // namespace asterism
