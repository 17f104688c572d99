// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace asterism {

/// A stream of random numbers that is a pure function of (seed, index, purpose): Philox 4×32-10
/// (Salmon et al., SC 2011). Streams with different keys are independent, so a parallel loop that keys
/// its stream by the item's index gives the same bits on any number of threads.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t index, std::uint32_t purpose = 0);

  std::uint32_t bits();
  /// In [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In {0, …, count − 1}, without bias.
  std::uint32_t below(std::uint32_t count);
  /// Standard normal (Box–Muller; the distributions of <random> differ between libraries).
  double normal();
  /// Number of events when `mean` are expected: Knuth's product below 30, PTRS (Hörmann 1993) above.
  double poisson(double mean);

 private:
  void refill();

  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

}  // namespace asterism
