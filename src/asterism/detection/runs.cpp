// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "asterism/detection/clones.hpp"

namespace asterism {
namespace {

constexpr int kBlock = 32;

template <class Grey>
struct Vector;
template <>
struct Vector<std::uint8_t> {
  using Type = std::uint8_t __attribute__((vector_size(32)));
};
template <>
struct Vector<std::uint16_t> {
  using Type = std::uint16_t __attribute__((vector_size(32)));
};
using Words = std::uint64_t __attribute__((vector_size(32)));

/// Whether any of 32 pixels, turned by `flip`, is above the threshold.
template <class Grey>
ASTERISM_INLINE bool any_above(const Grey* pixels, Grey flip, Grey threshold) {
  using Lanes = typename Vector<Grey>::Type;
  Words found{};
  for (std::size_t part = 0; part < kBlock * sizeof(Grey) / 32; ++part) {
    Lanes lanes;
    std::memcpy(&lanes, pixels + part * (32 / sizeof(Grey)), 32);
    found |= reinterpret_cast<Words>((lanes ^ flip) > threshold);
  }
  return (found[0] | found[1] | found[2] | found[3]) != 0;
}

/// A bit for each of 32 pixels above the threshold.
template <class Grey>
ASTERISM_INLINE std::uint32_t bits_above(const Grey* pixels, Grey flip, Grey threshold) {
  std::uint32_t bits = 0;
  for (int i = 0; i < kBlock; ++i) bits |= static_cast<std::uint32_t>((pixels[i] ^ flip) > threshold) << i;
  return bits;
}

/// A level above which exactly the pixels > `threshold` lie, as a grey value.
template <class Grey>
ASTERISM_INLINE Grey as_grey(float threshold) {
  constexpr float kMost = std::numeric_limits<Grey>::max();
  return static_cast<Grey>(threshold <= 0 ? 0.0F : threshold >= kMost ? kMost : threshold);
}

struct OpenRun {
  int begin = -1;
};

ASTERISM_INLINE void add_bits(std::uint32_t bits, int count, int x, int y, OpenRun& open,
                              std::vector<Run>& runs) {
  int at = 0;
  while (at < count) {
    const std::uint32_t rest = open.begin >= 0 ? ~bits >> at : bits >> at;
    if (rest == 0) return;
    at += __builtin_ctz(rest);
    if (at >= count) return;
    if (open.begin >= 0) {
      runs.push_back({y, open.begin, x + at});
      open.begin = -1;
    } else {
      open.begin = x + at;
    }
  }
}

template <class Grey>
ASTERISM_INLINE void runs_of_row(const Grey* row, int y, int x_begin, int x_end, const float* thresholds,
                                 Grey flip, std::vector<Run>& runs) {
  OpenRun open;
  int x = x_begin;
  while (x < x_end) {
    const int block_end = std::min(x_end, (x / kBlock + 1) * kBlock);
    const Grey threshold = as_grey<Grey>(thresholds[x / kBlock]);
    const int count = block_end - x;
    if (count == kBlock) {
      if (any_above(row + x, flip, threshold)) {
        add_bits(bits_above(row + x, flip, threshold), kBlock, x, y, open, runs);
      } else if (open.begin >= 0) {
        runs.push_back({y, open.begin, x});
        open.begin = -1;
      }
    } else {
      std::uint32_t bits = 0;
      for (int i = 0; i < count; ++i)
        bits |= static_cast<std::uint32_t>((row[x + i] ^ flip) > threshold) << i;
      add_bits(bits, count, x, y, open, runs);
    }
    x = block_end;
  }
  if (open.begin >= 0) runs.push_back({y, open.begin, x_end});
}

ASTERISM_CLONES void runs_of_row_8(const std::uint8_t* row, int y, int x_begin, int x_end,
                                   const float* thresholds, std::uint8_t flip, std::vector<Run>& runs) {
  runs_of_row(row, y, x_begin, x_end, thresholds, flip, runs);
}

ASTERISM_CLONES void runs_of_row_16(const std::uint16_t* row, int y, int x_begin, int x_end,
                                    const float* thresholds, std::uint16_t flip, std::vector<Run>& runs) {
  runs_of_row(row, y, x_begin, x_end, thresholds, flip, runs);
}

/// Sums over the pixels of a blob, about the pixel (0, 0).
struct Sums {
  PixelBox box{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0, 0};
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Run& run) {
    const double length = run.end - run.begin;
    const double middle = 0.5 * (run.begin + run.end - 1);
    n += length;
    x += length * middle;
    y += length * run.y;
    xx += length * (middle * middle + (length * length - 1) / 12);
    xy += length * middle * run.y;
    yy += length * run.y * run.y;
    box = {std::min(box.x_begin, run.begin), std::min(box.y_begin, run.y), std::max(box.x_end, run.end),
           std::max(box.y_end, run.y + 1)};
  }

  [[nodiscard]] Blob blob() const {
    Blob result{box, n, {x / n, y / n}, {}};
    result.covariance << xx, xy, xy, yy;
    result.covariance = result.covariance / n - result.mean * result.mean.transpose();
    return result;
  }
};

/// Union of sets of runs; the root is the first run of its set, so blobs come in the order of rows.
struct Sets {
  std::vector<std::size_t> parent;

  std::size_t root(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    (a < b ? parent[b] : parent[a]) = std::min(a, b);
  }
};

}  // namespace

template <>
void append_runs_of_row(const std::uint8_t* row, int y, int x_begin, int x_end, const float* thresholds,
                        Tone<std::uint8_t> tone, std::vector<Run>& runs) {
  runs_of_row_8(row, y, x_begin, x_end, thresholds, tone.flip, runs);
}

template <>
void append_runs_of_row(const std::uint16_t* row, int y, int x_begin, int x_end, const float* thresholds,
                        Tone<std::uint16_t> tone, std::vector<Run>& runs) {
  runs_of_row_16(row, y, x_begin, x_end, thresholds, tone.flip, runs);
}

std::vector<Blob> blobs_of(const std::vector<Run>& runs) {
  Sets sets;
  sets.parent.resize(runs.size());
  std::size_t above = 0;  // first run of the row above that may still touch
  for (std::size_t i = 0; i < runs.size(); ++i) {
    sets.parent[i] = i;
    const Run& run = runs[i];
    while (above < i &&
           (runs[above].y < run.y - 1 || (runs[above].y == run.y - 1 && runs[above].end < run.begin))) {
      ++above;
    }
    for (std::size_t j = above; j < i && runs[j].y == run.y - 1 && runs[j].begin <= run.end; ++j)
      sets.join(i, j);
  }
  std::vector<std::size_t> place(runs.size());
  std::vector<Sums> sums;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t root = sets.root(i);
    if (root == i) {
      place[i] = sums.size();
      sums.emplace_back();
    }
    sums[place[root]].add(runs[i]);
  }
  std::vector<Blob> blobs;
  blobs.reserve(sums.size());
  for (const Sums& sum : sums) blobs.push_back(sum.blob());
  return blobs;
}

}  // namespace asterism
