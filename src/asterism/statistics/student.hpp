// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/statistics/intervals.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {

/// What is held against "no difference": a ≠ b, a < b or a > b.
enum class Alternative { TwoSided, Less, Greater };

struct TTest {
  double difference = 0;  // mean of a − mean of b, in the samples' unit
  double standard_error = 0;
  double t = 0;
  double degrees = 0;      // of freedom
  double p = 1;            // probability of such a t, or a stronger one, without any difference
  double effect_size = 0;  // difference over the standard deviation (Cohen's d; of the pairs when paired)
  Interval interval;       // of the difference; two-sided
};

/// a[i] and b[i] belong together: the same run under two conditions. Two pairs or more, which must differ
/// by more than a constant.
[[nodiscard]] TTest paired_t_test(std::span<const double> a, std::span<const double> b,
                                  Alternative alternative = Alternative::TwoSided, double confidence = 0.95);

/// Independent samples of the same spread (Student).
[[nodiscard]] TTest pooled_t_test(const Summary& a, const Summary& b,
                                  Alternative alternative = Alternative::TwoSided, double confidence = 0.95);

/// Independent samples of any spread (Welch 1947, degrees of freedom by Satterthwaite).
[[nodiscard]] TTest welch_t_test(const Summary& a, const Summary& b,
                                 Alternative alternative = Alternative::TwoSided, double confidence = 0.95);

/// p-values made good for their number (Holm 1979), in the order given: what stays below α is
/// significant with at most the probability α of any false alarm among all.
[[nodiscard]] std::vector<double> holm_adjusted(std::span<const double> p_values);

/// How a sample size is counted: pairs, or values in each of two independent samples.
enum class TTestDesign { Paired, TwoSamples };

/// What a t-test is planned with.
struct TTestPlan {
  double effect_size = 0;  // true difference over the standard deviation (of the pairs when paired)
  double alpha = 0.05;
  Alternative alternative = Alternative::TwoSided;
  TTestDesign design = TTestDesign::Paired;
};

/// Probability that a test of `count` pairs (or values a sample) finds the difference: noncentral t.
[[nodiscard]] double power_of_t_test(const TTestPlan& plan, std::size_t count);

/// The fewest pairs (or values a sample) that find the difference with probability `power`.
[[nodiscard]] std::size_t sample_size_for(const TTestPlan& plan, double power = 0.8);

}  // namespace asterism
