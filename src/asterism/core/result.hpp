// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <tl/expected.hpp>

namespace asterism {

/// A value, or the reason why this measurement did not come off. For what is normal and frequent:
/// a hidden target, parallel rays, an ambiguous labelling. `Reason` is an enum of the step.
template <class T, class Reason>
using Result = tl::expected<T, Reason>;

template <class Reason>
[[nodiscard]] constexpr auto because(Reason reason) {
  return tl::unexpected<Reason>(reason);
}

/// The input is wrong and the user can mend it. The message says where, what, and what would be right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& file, const std::string& what) : std::runtime_error(file + ": " + what) {}
};

/// The input is sound but the measurement could not be made from it; the message says why.
class MeasurementError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program is wrong: a promise between its parts was broken.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Always on. `promise` names what should hold: require(rows == 3, "a point has three coordinates").
inline void require(bool holds, const char* promise) {
  if (!holds) throw ContractViolation(std::string("broken promise: ") + promise);
}

}  // namespace asterism
