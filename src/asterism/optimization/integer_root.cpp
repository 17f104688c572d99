// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/integer_root.hpp"

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Newton from above: the iterates fall until rounding stops them.
double root_of(double x, int n, double start) {
  double root = start;
  for (;;) {
    const double next = root - root * (1 - x / integer_power(root, n)) / n;
    if (!(next < root)) return root;
    root = next;
  }
}

}  // namespace

IntegerRoot::IntegerRoot(int n) : exponent_root_(2048) {
  require(n >= 1 && n <= 1000, "the degree of a root is 1 to 1000");
  double coefficient = 1;
  for (int i = 0; i < 5; ++i) {
    coefficient *= (1.0 / n - i) / (i + 1);
    series_[static_cast<std::size_t>(i)] = coefficient;
  }
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double centre = 1 + (static_cast<double>(cell) + 0.5) / kCells;
    cell_inverse_[cell] = 1 / centre;
    cell_root_[cell] = root_of(centre, n, 1 + (centre - 1) / n);
  }
  std::vector<double> root_of_two_power;
  for (int k = 0; k < n; ++k)
    root_of_two_power.push_back(root_of(std::ldexp(1.0, k), n, 1 + static_cast<double>(k) / n));
  for (int biased = 1; biased < 2047; ++biased) {
    const int exponent = biased - 1023;
    const int whole = exponent >= 0 ? exponent / n : -((n - 1 - exponent) / n);
    const auto rest = static_cast<std::size_t>(exponent - whole * n);
    exponent_root_[static_cast<std::size_t>(biased)] = std::ldexp(root_of_two_power[rest], whole);
  }
}

}  // namespace asterism
