// SPDX-License-Identifier: Apache-2.0
#include "asterism/statistics/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace asterism {

double chi_square_quantile(double p, double degrees) {
  return boost::math::quantile(boost::math::chi_squared(degrees), p);
}

double chi_square_tail(double value, double degrees) {
  if (value <= 0) return 1.0;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), value));
}

double fisher_tail(double value, double numerator_degrees, double denominator_degrees) {
  if (value <= 0) return 1.0;
  return boost::math::cdf(
      boost::math::complement(boost::math::fisher_f(numerator_degrees, denominator_degrees), value));
}

double normal_quantile(double p) { return boost::math::quantile(boost::math::normal(), p); }

double normal_probability(double value) { return boost::math::cdf(boost::math::normal(), value); }

double student_quantile(double p, double degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), p);
}

double student_tail(double value, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::students_t(degrees), value));
}

double noncentral_student_tail(double value, double degrees, double noncentrality) {
  return boost::math::cdf(boost::math::complement(boost::math::non_central_t(degrees, noncentrality), value));
}

}  // namespace asterism
