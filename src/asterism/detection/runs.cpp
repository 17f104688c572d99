// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "asterism/detection/lanes.hpp"

namespace asterism {
namespace {

constexpr int kBlock = 32;

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

/// Pixels, turned so that discs are bright, and their thresholds.
template <class Grey>
struct Line {
  const Grey* row;
  int width;
  const Grey* thresholds;  // may be null
  Grey level, flip;

  static constexpr int kLanes = 32 / sizeof(Grey);

  /// All ones where one of kLanes pixels is above its threshold.
  [[nodiscard]] ASTERISM_INLINE WordLanes above(int x) const {
    GreyLanes<Grey> lanes, limit = GreyLanes<Grey>{} + level;
    std::memcpy(&lanes, row + x, 32);
    if (thresholds != nullptr) std::memcpy(&limit, thresholds + x, 32);
    return reinterpret_cast<WordLanes>((lanes ^ flip) > limit);
  }

  /// A bit for each of 32 pixels; those beyond the image are zero.
  [[nodiscard]] ASTERISM_INLINE std::uint32_t bits(int x) const {
    std::uint32_t found = 0;
    if (x + kBlock > width) {
      for (int i = 0; x + i < width; ++i) {
        const Grey limit = thresholds != nullptr ? thresholds[x + i] : level;
        found |= static_cast<std::uint32_t>((row[x + i] ^ flip) > limit) << i;
      }
      return found;
    }
    // Of each lane the bit of its place is kept, and a product adds the lanes of a word up in its top one.
    constexpr bool kBytes = sizeof(Grey) == 1;
    constexpr std::uint64_t kPlaces = kBytes ? 0x8040201008040201 : 0x0008000400020001;
    constexpr std::uint64_t kOnes = kBytes ? 0x0101010101010101 : 0x0001000100010001;
    constexpr int kTop = kBytes ? 56 : 48, kInWord = 8 / sizeof(Grey);
    for (int part = 0; part < kBlock; part += kLanes) {
      const WordLanes words = above(x + part);
      for (int i = 0; i < 4; ++i) {
        found |= static_cast<std::uint32_t>(((words[i] & kPlaces) * kOnes) >> kTop) << (part + i * kInWord);
      }
    }
    return found;
  }
};

ASTERISM_INLINE bool any(WordLanes words) { return (words[0] | words[1] | words[2] | words[3]) != 0; }

template <class Grey>
ASTERISM_INLINE void runs_of_row(const Line<Grey>& line, int y, int x_begin, int x_end,
                                 std::vector<Run>& runs) {
  constexpr int kStride = 4 * Line<Grey>::kLanes;
  OpenRun open;
  int x = x_begin;
  while (x < x_end) {
    // Most of an image is background: leap over it.
    if (open.begin < 0 && x + kStride <= x_end &&
        !any(line.above(x) | line.above(x + kStride / 4) | line.above(x + kStride / 2) |
             line.above(x + kStride * 3 / 4))) {
      x += kStride;
      continue;
    }
    const int leap_end = std::min(x_end, x + kStride);
    for (; x < leap_end; x += kBlock) add_bits(line.bits(x), std::min(kBlock, x_end - x), x, y, open, runs);
    x = std::min(x, x_end);
  }
  if (open.begin >= 0) runs.push_back({y, open.begin, x_end});
}

ASTERISM_CLONES void runs_of_row_8(const Line<std::uint8_t>& line, int y, int x_begin, int x_end,
                                   std::vector<Run>& runs) {
  runs_of_row(line, y, x_begin, x_end, runs);
}

ASTERISM_CLONES void runs_of_row_16(const Line<std::uint16_t>& line, int y, int x_begin, int x_end,
                                    std::vector<Run>& runs) {
  runs_of_row(line, y, x_begin, x_end, runs);
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
void append_runs_of_row(const Raster8& image, int y, int x_begin, int x_end, const std::uint8_t* thresholds,
                        std::uint8_t level, Tone<std::uint8_t> tone, std::vector<Run>& runs) {
  runs_of_row_8({image.row(y), image.width, thresholds, level, tone.flip}, y, x_begin, x_end, runs);
}

template <>
void append_runs_of_row(const Raster16& image, int y, int x_begin, int x_end, const std::uint16_t* thresholds,
                        std::uint16_t level, Tone<std::uint16_t> tone, std::vector<Run>& runs) {
  runs_of_row_16({image.row(y), image.width, thresholds, level, tone.flip}, y, x_begin, x_end, runs);
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
