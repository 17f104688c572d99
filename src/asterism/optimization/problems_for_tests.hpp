// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "asterism/optimization/real_problem.hpp"

// Problems whose fronts are known, for tests and benchmarks: ZDT (Zitzler, Deb & Thiele 2000), DTLZ (Deb et
// al. 2002), with constraints BNH, SRN, TNK, OSY (Deb 2001) and C-DTLZ (Jain & Deb 2014).

namespace asterism::problems {

using In = std::span<const double>;
using Out = std::span<double>;

/// A formula of bounded reals. Constraints are dimensionless, their scale is 1.
class FormulaProblem final : public RealProblem {
 public:
  using Formula = void (*)(In x, Out f, Out violations);
  FormulaProblem(std::string name, std::vector<double> lowest, std::vector<double> highest,
                 std::size_t objectives, std::size_t constraints, Formula formula)
      : RealProblem(std::move(lowest), std::move(highest)),
        name_(std::move(name)),
        objectives_(objectives),
        constraints_(constraints),
        formula_(formula) {}

  [[nodiscard]] std::string identity() const override { return name_; }
  [[nodiscard]] std::vector<ObjectiveInfo> objectives() const override {
    std::vector<ObjectiveInfo> infos;
    for (std::size_t i = 0; i < objectives_; ++i) infos.push_back({"f" + std::to_string(i + 1), ""});
    return infos;
  }
  [[nodiscard]] std::vector<ConstraintInfo> constraints() const override {
    std::vector<ConstraintInfo> infos;
    for (std::size_t i = 0; i < constraints_; ++i) infos.push_back({"g" + std::to_string(i + 1), "", 1});
    return infos;
  }
  void evaluate(In genes, Out objectives, Out violations) const override {
    formula_(genes, objectives, violations);
  }

 private:
  std::string name_;
  std::size_t objectives_, constraints_;
  Formula formula_;
};

inline double square(double x) { return x * x; }
/// How much is missing to `value` ≥ 0.
inline double missing(double value) { return std::max(0.0, -value); }

inline double zdt_g(In x) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += x[i];
  return 1 + 9 * sum / static_cast<double>(x.size() - 1);
}
inline void zdt1(In x, Out f, Out) {
  const double g = zdt_g(x);
  f[0] = x[0];
  f[1] = g * (1 - std::sqrt(x[0] / g));
}
inline void zdt2(In x, Out f, Out) {
  const double g = zdt_g(x);
  f[0] = x[0];
  f[1] = g * (1 - square(x[0] / g));
}
inline void zdt3(In x, Out f, Out) {
  const double g = zdt_g(x);
  f[0] = x[0];
  f[1] = g * (1 - std::sqrt(x[0] / g) - x[0] / g * std::sin(10 * std::numbers::pi * x[0]));
}
inline void zdt4(In x, Out f, Out) {
  double g = 1 + 10 * static_cast<double>(x.size() - 1);
  for (std::size_t i = 1; i < x.size(); ++i) g += x[i] * x[i] - 10 * std::cos(4 * std::numbers::pi * x[i]);
  f[0] = x[0];
  f[1] = g * (1 - std::sqrt(x[0] / g));
}
inline void zdt6(In x, Out f, Out) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += x[i];
  const double g = 1 + 9 * std::sqrt(std::sqrt(sum / static_cast<double>(x.size() - 1)));
  const double sine = std::sin(6 * std::numbers::pi * x[0]);
  f[0] = 1 - std::exp(-4 * x[0]) * square(sine * sine * sine);
  f[1] = g * (1 - square(f[0] / g));
}
/// The sphere's directions, `angles` in quarter turns, times 1 + g.
inline void on_sphere(In angles, double g, Out f) {
  const std::size_t m = f.size();
  for (std::size_t i = 0; i < m; ++i) {
    f[i] = 1 + g;
    for (std::size_t j = 0; j + i + 1 < m; ++j) f[i] *= std::cos(angles[j] * std::numbers::pi / 2);
    if (i > 0) f[i] *= std::sin(angles[m - 1 - i] * std::numbers::pi / 2);
  }
}
inline void dtlz2(In x, Out f, Out) {
  double g = 0;
  for (std::size_t i = f.size() - 1; i < x.size(); ++i) g += square(x[i] - 0.5);
  on_sphere(x.first(f.size() - 1), g, f);
}
inline void bnh(In x, Out f, Out v) {
  f[0] = 4 * square(x[0]) + 4 * square(x[1]);
  f[1] = square(x[0] - 5) + square(x[1] - 5);
  v[0] = missing(25 - square(x[0] - 5) - square(x[1]));
  v[1] = missing(square(x[0] - 8) + square(x[1] + 3) - 7.7);
}
inline void srn(In x, Out f, Out v) {
  f[0] = 2 + square(x[0] - 2) + square(x[1] - 1);
  f[1] = 9 * x[0] - square(x[1] - 1);
  v[0] = missing(225 - square(x[0]) - square(x[1]));
  v[1] = missing(3 * x[1] - x[0] - 10);
}
inline void tnk(In x, Out f, Out v) {
  f[0] = x[0];
  f[1] = x[1];
  v[0] = missing(square(x[0]) + square(x[1]) - 1 - 0.1 * std::cos(16 * std::atan2(x[0], x[1])));
  v[1] = missing(0.5 - square(x[0] - 0.5) - square(x[1] - 0.5));
}
inline void osy(In x, Out f, Out v) {
  f[0] = -(25 * square(x[0] - 2) + square(x[1] - 2) + square(x[2] - 1) + square(x[3] - 4) + square(x[4] - 1));
  f[1] = 0;
  for (const double gene : x) f[1] += square(gene);
  v[0] = missing((x[0] + x[1] - 2) / 2);
  v[1] = missing((6 - x[0] - x[1]) / 6);
  v[2] = missing((2 - x[1] + x[0]) / 2);
  v[3] = missing((2 - x[0] + 3 * x[1]) / 2);
  v[4] = missing((4 - square(x[2] - 3) - x[3]) / 4);
  v[5] = missing((square(x[4] - 3) + x[5] - 4) / 4);
}
inline void c1_dtlz1(In x, Out f, Out v) {
  const std::size_t m = f.size();
  double g = static_cast<double>(x.size() - m + 1);
  for (std::size_t i = m - 1; i < x.size(); ++i)
    g += square(x[i] - 0.5) - std::cos(20 * std::numbers::pi * (x[i] - 0.5));
  for (std::size_t i = 0; i < m; ++i) {
    f[i] = 0.5 * (1 + 100 * g);
    for (std::size_t j = 0; j + i + 1 < m; ++j) f[i] *= x[j];
    if (i > 0) f[i] *= 1 - x[m - 1 - i];
  }
  double left = 1 - f[m - 1] / 0.6;
  for (std::size_t i = 0; i + 1 < m; ++i) left -= f[i] / 0.5;
  v[0] = missing(left);
}
inline void c2_dtlz2(In x, Out f, Out v) {
  dtlz2(x, f, {});
  const double r2 = square(f.size() == 3 ? 0.4 : 0.5);
  double norm2 = 0, centre = 0, nearest = 1e300;
  for (const double fi : f) {
    norm2 += square(fi);
    centre += square(fi - 1 / std::sqrt(static_cast<double>(f.size())));
  }
  for (const double fi : f) nearest = std::min(nearest, square(fi - 1) + norm2 - square(fi) - r2);
  v[0] = std::max(0.0, std::min(nearest, centre - r2));
}
inline void c3_dtlz4(In x, Out f, Out v) {
  double g = 0;
  for (std::size_t i = f.size() - 1; i < x.size(); ++i) g += square(x[i] - 0.5);
  std::vector<double> angles;
  for (std::size_t i = 0; i + 1 < f.size(); ++i) angles.push_back(std::pow(x[i], 100));
  on_sphere(angles, g, f);
  double norm2 = 0;
  for (const double fi : f) norm2 += square(fi);
  for (std::size_t i = 0; i < f.size(); ++i) v[i] = missing(norm2 - 0.75 * square(f[i]) - 1);
}

inline FormulaProblem unit_cube(const char* name, std::size_t genes, std::size_t objectives,
                                std::size_t constraints, FormulaProblem::Formula formula) {
  return {name,   std::vector<double>(genes, 0.0), std::vector<double>(genes, 1.0), objectives, constraints,
          formula};
}
inline FormulaProblem make_zdt4() {
  std::vector<double> low(10, -5.0), high(10, 5.0);
  low[0] = 0;
  high[0] = 1;
  return {"ZDT4", low, high, 2, 0, zdt4};
}

/// ZDT1–4 and 6, DTLZ2 with two and three objectives.
inline std::vector<FormulaProblem> unconstrained() {
  return {unit_cube("ZDT1", 30, 2, 0, zdt1),       unit_cube("ZDT2", 30, 2, 0, zdt2),
          unit_cube("ZDT3", 30, 2, 0, zdt3),       make_zdt4(),
          unit_cube("ZDT6", 10, 2, 0, zdt6),       unit_cube("DTLZ2, M=2", 11, 2, 0, dtlz2),
          unit_cube("DTLZ2, M=3", 12, 3, 0, dtlz2)};
}
inline std::vector<FormulaProblem> constrained() {
  return {{"BNH", {0, 0}, {5, 3}, 2, 2, bnh},
          {"SRN", {-20, -20}, {20, 20}, 2, 2, srn},
          {"TNK", {0, 0}, {std::numbers::pi, std::numbers::pi}, 2, 2, tnk},
          {"OSY", {0, 0, 1, 0, 1, 0}, {10, 10, 5, 6, 5, 10}, 2, 6, osy},
          unit_cube("C1-DTLZ1", 7, 3, 1, c1_dtlz1),
          unit_cube("C2-DTLZ2", 12, 3, 1, c2_dtlz2),
          unit_cube("C3-DTLZ4", 7, 3, 3, c3_dtlz4)};
}

}  // namespace asterism::problems
