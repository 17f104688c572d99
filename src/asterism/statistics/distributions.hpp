// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asterism {

/// The value a χ² variable with `degrees` of freedom stays below with probability `p` in (0, 1).
[[nodiscard]] double chi_square_quantile(double p, double degrees);

/// P(χ² > value).
[[nodiscard]] double chi_square_tail(double value, double degrees);

/// P(F > value) for Fisher's F with the degrees of freedom of its numerator and denominator.
[[nodiscard]] double fisher_tail(double value, double numerator_degrees, double denominator_degrees);

/// The value a standard normal variable stays below with probability `p` in (0, 1).
[[nodiscard]] double normal_quantile(double p);

/// P(standard normal < value).
[[nodiscard]] double normal_probability(double value);

/// The value Student's t with `degrees` of freedom stays below with probability `p` in (0, 1).
[[nodiscard]] double student_quantile(double p, double degrees);

/// P(T > value) for Student's t.
[[nodiscard]] double student_tail(double value, double degrees);

/// P(T > value) for the noncentral t: what Student's t becomes when the true difference is
/// `noncentrality` standard errors.
[[nodiscard]] double noncentral_student_tail(double value, double degrees, double noncentrality);

}  // namespace asterism
