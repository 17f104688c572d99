// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/student.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/core/result.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

double p_value(double t, double degrees, Alternative alternative) {
  switch (alternative) {
    case Alternative::Less:
      return student_tail(-t, degrees);
    case Alternative::Greater:
      return student_tail(t, degrees);
    case Alternative::TwoSided:
      break;
  }
  return std::min(1.0, 2 * student_tail(std::abs(t), degrees));
}

TTest test_of(double difference, double standard_error, double degrees, double deviation,
              Alternative alternative, double confidence) {
  require(standard_error > 0, "a t-test needs values that vary");
  require(confidence > 0 && confidence < 1, "a confidence lies in (0, 1)");
  TTest test;
  test.difference = difference;
  test.standard_error = standard_error;
  test.t = difference / standard_error;
  test.degrees = degrees;
  test.p = p_value(test.t, degrees, alternative);
  test.effect_size = difference / deviation;
  const double half = student_quantile(0.5 + confidence / 2, degrees) * standard_error;
  test.interval = {difference - half, difference + half};
  return test;
}

double square(double x) { return x * x; }

}  // namespace

TTest paired_t_test(std::span<const double> a, std::span<const double> b, Alternative alternative,
                    double confidence) {
  require(a.size() == b.size(), "a paired test takes pairs");
  std::vector<double> differences(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) differences[i] = a[i] - b[i];
  const Summary pairs = summarize(differences);
  return test_of(pairs.mean, pairs.standard_error(), static_cast<double>(pairs.count - 1), pairs.deviation,
                 alternative, confidence);
}

TTest pooled_t_test(const Summary& a, const Summary& b, Alternative alternative, double confidence) {
  require(a.count >= 2 && b.count >= 2, "a t-test takes samples of two values or more");
  const double na = static_cast<double>(a.count), nb = static_cast<double>(b.count);
  const double degrees = na + nb - 2;
  const double deviation =
      std::sqrt(((na - 1) * square(a.deviation) + (nb - 1) * square(b.deviation)) / degrees);
  return test_of(a.mean - b.mean, deviation * std::sqrt(1 / na + 1 / nb), degrees, deviation, alternative,
                 confidence);
}

TTest welch_t_test(const Summary& a, const Summary& b, Alternative alternative, double confidence) {
  require(a.count >= 2 && b.count >= 2, "a t-test takes samples of two values or more");
  const double va = square(a.standard_error()), vb = square(b.standard_error());
  const double degrees = square(va + vb) / (square(va) / static_cast<double>(a.count - 1) +
                                            square(vb) / static_cast<double>(b.count - 1));
  const double deviation = std::sqrt((square(a.deviation) + square(b.deviation)) / 2);
  return test_of(a.mean - b.mean, std::sqrt(va + vb), degrees, deviation, alternative, confidence);
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return p_values[i] < p_values[j]; });
  std::vector<double> adjusted(p_values.size());
  double so_far = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double left = static_cast<double>(order.size() - k);
    so_far = std::max(so_far, std::min(1.0, left * p_values[order[k]]));
    adjusted[order[k]] = so_far;
  }
  return adjusted;
}

double power_of_t_test(const TTestPlan& plan, std::size_t count) {
  require(count >= 2, "a t-test takes two values or more");
  require(plan.alpha > 0 && plan.alpha < 1, "a level of significance lies in (0, 1)");
  const double n = static_cast<double>(count);
  const bool paired = plan.design == TTestDesign::Paired;
  const double degrees = paired ? n - 1 : 2 * (n - 1);
  const double shift = plan.effect_size * std::sqrt(paired ? n : n / 2);
  const auto beyond = [&](double alpha, double noncentrality) {
    return noncentral_student_tail(student_quantile(1 - alpha, degrees), degrees, noncentrality);
  };
  switch (plan.alternative) {
    case Alternative::Less:
      return beyond(plan.alpha, -shift);
    case Alternative::Greater:
      return beyond(plan.alpha, shift);
    case Alternative::TwoSided:
      break;
  }
  return beyond(plan.alpha / 2, shift) + beyond(plan.alpha / 2, -shift);
}

std::size_t sample_size_for(const TTestPlan& plan, double power) {
  require(power > 0 && power < 1, "a power lies in (0, 1)");
  require(plan.effect_size != 0, "no sample finds a difference of zero");
  std::size_t enough = 2;
  constexpr std::size_t kLargest = std::size_t{1} << 40U;
  while (power_of_t_test(plan, enough) < power) {
    require(enough < kLargest, "the alternative must lie on the side of the difference");
    enough *= 2;
  }
  std::size_t too_few = enough / 2;
  while (enough - too_few > 1) {
    const std::size_t middle = too_few + (enough - too_few) / 2;
    (power_of_t_test(plan, std::max<std::size_t>(2, middle)) < power ? too_few : enough) = middle;
  }
  return std::max<std::size_t>(2, enough);
}

}  // namespace asterism
