// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/lexicographic_order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFew = 24;            // below it insertion is quickest
constexpr std::size_t kMostBuckets = 4096;  // more would leave the second-level cache
constexpr int kDeepest = 4;                 // levels of dealing before values count as skewed

}  // namespace

std::span<const std::uint32_t> LexicographicOrder::operator()(std::span<const double> points, std::size_t m) {
  require(m > 0 && points.size() % m == 0, "points are count × m numbers");
  points_ = points;
  m_ = m;
  const std::size_t count = points.size() / m;
  keys_.resize(count);
  dealt_.resize(count);
  order_.resize(count);
  bool numbers = true;
  for (const double value : points) numbers &= value == value;
  require(numbers, "objectives are numbers");
  for (std::size_t i = 0; i < count; ++i) keys_[i] = {points[i * m], static_cast<std::uint32_t>(i)};
  sort({0, count}, 0, 0);
  for (std::size_t i = 0; i < count; ++i) order_[i] = keys_[i].index;
  return order_;
}

bool LexicographicOrder::before(const Key& a, const Key& b, std::size_t coordinate) const {
  if (a.value != b.value) return a.value < b.value;
  const double* p = points_.data() + a.index * m_;
  const double* q = points_.data() + b.index * m_;
  for (std::size_t k = coordinate + 1; k < m_; ++k)
    if (p[k] != q[k]) return p[k] < q[k];
  return a.index < b.index;
}

void LexicographicOrder::sort(Range range, std::size_t coordinate, int depth) {
  if (range.last - range.first <= kFew) return sort_few(range, coordinate);
  double low = keys_[range.first].value;
  double high = low;
  for (std::size_t i = range.first + 1; i < range.last; ++i) {
    low = std::min(low, keys_[i].value);
    high = std::max(high, keys_[i].value);
  }
  if (low == high) return sort_equal(range, coordinate);
  if (depth < kDeepest && deal(range, low, high, coordinate, depth)) return;
  std::sort(keys_.begin() + static_cast<std::ptrdiff_t>(range.first),
            keys_.begin() + static_cast<std::ptrdiff_t>(range.last),
            [&](const Key& a, const Key& b) { return before(a, b, coordinate); });
}

void LexicographicOrder::sort_few(Range range, std::size_t coordinate) {
  for (std::size_t i = range.first + 1; i < range.last; ++i) {
    const Key key = keys_[i];
    std::size_t hole = i;
    for (; hole > range.first && before(key, keys_[hole - 1], coordinate); --hole)
      keys_[hole] = keys_[hole - 1];
    keys_[hole] = key;
  }
}

/// All are equal in this coordinate: the next one decides. Dealing is stable, so equal points stay in order.
void LexicographicOrder::sort_equal(Range range, std::size_t coordinate) {
  if (++coordinate == m_) return;
  for (std::size_t i = range.first; i < range.last; ++i)
    keys_[i].value = points_[keys_[i].index * m_ + coordinate];
  sort(range, coordinate, 0);
}

/// Deals the range into buckets and sorts each; false if the values' spread cannot be divided.
bool LexicographicOrder::deal(Range range, double low, double high, std::size_t coordinate, int depth) {
  const std::size_t count = range.last - range.first;
  const std::size_t buckets = std::min(std::bit_ceil(count), kMostBuckets);
  const double scale = static_cast<double>(buckets - 1) / (high - low);
  if (!std::isfinite(high - low) || !std::isfinite(scale)) return false;
  const auto bucket_of = [&](const Key& key) {
    return static_cast<std::size_t>(static_cast<std::int64_t>((key.value - low) * scale));
  };

  const std::size_t base = bucket_ends_.size();  // this level's part of a stack
  bucket_ends_.resize(base + buckets);
  std::uint32_t* ends = bucket_ends_.data() + base;
  for (std::size_t i = range.first; i < range.last; ++i) ++ends[bucket_of(keys_[i])];
  auto next = static_cast<std::uint32_t>(range.first);
  std::uint32_t fullest = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::uint32_t size = ends[b];
    ends[b] = next;
    next += size;
    fullest = std::max(fullest, size);
  }
  for (std::size_t i = range.first; i < range.last; ++i) dealt_[ends[bucket_of(keys_[i])]++] = keys_[i];
  std::copy(dealt_.begin() + static_cast<std::ptrdiff_t>(range.first),
            dealt_.begin() + static_cast<std::ptrdiff_t>(range.last),
            keys_.begin() + static_cast<std::ptrdiff_t>(range.first));
  if (fullest <= kFew) {
    sort_few(range, coordinate);
  } else {
    std::size_t first = range.first;
    for (std::size_t b = 0; b < buckets; ++b) {
      const std::size_t last = bucket_ends_[base + b];
      if (last - first > 1) sort({first, last}, coordinate, depth + 1);
      first = last;
    }
  }
  bucket_ends_.resize(base);
  return true;
}

}  // namespace asterism
