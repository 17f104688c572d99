// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/knee.hpp"

#include <algorithm>
#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {

std::vector<double> by_range(std::span<const double> objectives, std::size_t m) {
  require(m > 0 && objectives.size() % m == 0, "a front is so many rows of its objectives");
  const std::size_t count = objectives.size() / m;
  std::vector<double> shares(objectives.size());
  for (std::size_t k = 0; k < m; ++k) {
    double best = std::numeric_limits<double>::infinity();
    double worst = -best;
    for (std::size_t i = 0; i < count; ++i) {
      best = std::min(best, objectives[i * m + k]);
      worst = std::max(worst, objectives[i * m + k]);
    }
    if (!(worst > best)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      shares[i * m + k] = (objectives[i * m + k] - best) / (worst - best);
    }
  }
  return shares;
}

std::size_t knee_of(std::span<const double> objectives, std::size_t m) {
  const std::vector<double> shares = by_range(objectives, m);
  require(!shares.empty(), "a front without candidates has no knee");
  std::size_t knee = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shares.size() / m; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < m; ++k) sum += shares[i * m + k];
    if (!(sum < least)) continue;
    least = sum;
    knee = i;
  }
  return knee;
}

std::vector<std::size_t> thinned(std::span<const double> objectives, std::size_t m, std::size_t most) {
  const std::vector<double> shares = by_range(objectives, m);
  const std::size_t count = shares.size() / m;
  std::vector<std::size_t> chosen;
  if (count == 0 || most == 0) return chosen;
  std::vector<double> apart(count, std::numeric_limits<double>::infinity());  // from what is chosen, squared
  const auto choose = [&](std::size_t i) {
    if (chosen.size() >= most || !(apart[i] > 0)) return;
    chosen.push_back(i);
    for (std::size_t j = 0; j < count; ++j) {
      double square = 0;
      for (std::size_t k = 0; k < m; ++k) {
        const double off = shares[i * m + k] - shares[j * m + k];
        square += off * off;
      }
      apart[j] = std::min(apart[j], square);
    }
    apart[i] = 0;
  };
  choose(knee_of(objectives, m));
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (shares[i * m + k] < shares[best * m + k]) best = i;
    }
    choose(best);
  }
  while (chosen.size() < most) {
    const auto farthest =
        static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    if (!(apart[farthest] > 0)) break;
    choose(farthest);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace asterism
