// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <span>
#include <vector>
namespace asterism {
inline double simple_hypervolume(std::span<const double> f, std::size_t m, std::span<const double> ref) {
  if (m != 2) return 0;
  std::vector<std::pair<double, double>> p;
  for (std::size_t i = 0; i + 1 < f.size(); i += 2)
    if (f[i] < ref[0] && f[i + 1] < ref[1]) p.push_back({f[i], f[i + 1]});
  std::sort(p.begin(), p.end());
  double h = 0, y = ref[1];
  for (auto& [a, b] : p)
    if (b < y) {
      h += (ref[0] - a) * (y - b);
      y = b;
    }
  return h;
}
}  // namespace asterism
