// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/front_thinning.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

std::span<const std::uint32_t> FrontThinning::operator()(std::span<const double> x, std::span<const double> y,
                                                         std::size_t keep) {
  const std::size_t count = x.size();
  require(y.size() == count && keep <= count, "a front's points have two coordinates and enough are there");
  x_ = x;
  y_ = y;
  plant(count);
  std::size_t left = count;
  for (; left > keep && least_[1] < kInfinite; --left) leave_out_least();
  kept_.clear();
  contributions_.clear();
  for (std::uint32_t i = 0; kept_.size() < keep; i = next_[i]) {
    kept_.push_back(i);
    contributions_.push_back(least_[leaves_ + i]);
  }
  return kept_;
}

/// Links the points and makes the tree of their shares.
void FrontThinning::plant(std::size_t count) {
  previous_.resize(count);
  next_.resize(count);
  leaves_ = std::bit_ceil(std::max<std::size_t>(count, 2));
  least_.assign(2 * leaves_, kInfinite);
  for (std::uint32_t i = 0; i < count; ++i) {
    previous_[i] = i == 0 ? i : i - 1;
    next_[i] = i + 1 == count ? i : i + 1;
    least_[leaves_ + i] = share(i);
  }
  for (std::size_t node = leaves_; --node > 0;)
    least_[node] = std::min(least_[2 * node], least_[2 * node + 1]);
}

void FrontThinning::leave_out_least() {
  std::size_t node = 1;
  while (node < leaves_) {
    node *= 2;
    node += least_[node] > least_[node / 2] ? 1 : 0;  // of equal shares the left one goes
  }
  const std::size_t at = node - leaves_;
  const std::size_t before = previous_[at];
  const std::size_t after = next_[at];
  next_[before] = static_cast<std::uint32_t>(after);
  previous_[after] = static_cast<std::uint32_t>(before);
  set_share(at, kInfinite);
  set_share(before, share(before));
  set_share(after, share(after));
}

void FrontThinning::set_share(std::size_t at, double share) {
  std::size_t node = leaves_ + at;
  least_[node] = share;
  for (; node > 1; node /= 2) {
    share = std::min(share, least_[node ^ 1]);
    least_[node / 2] = share;
  }
}

double FrontThinning::share(std::size_t at) const {
  if (previous_[at] == at || next_[at] == at) return kInfinite;
  return (x_[next_[at]] - x_[at]) * (y_[previous_[at]] - y_[at]);
}

}  // namespace asterism
