// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

// What the paper says against what comes out. A verdict is always the outcome of a comparison made here;
// nobody writes one down.

namespace asterism {

enum class Verdict { Match, MatchWithinMonteCarloError, Mismatch, CannotBeDetermined };
[[nodiscard]] std::string words(Verdict verdict);

/// A statement of the paper.
struct Claim {
  std::string id;         // T10.S1.f1
  std::string where;      // Table 10
  std::string quantity;   // S1 f1, mm
  std::string published;  // as printed
};

struct LedgerRow {
  Claim claim;
  std::string computed;
  std::string definition;  // how
  Verdict verdict = Verdict::CannotBeDetermined;
  std::string reason;  // why not, or what is worth knowing where it matches
};

/// How a number was reached, and why it may differ from print.
struct Account {
  std::string definition;
  std::string if_not;  // the reason told when the comparison fails
  std::string note;    // told when it holds
};

/// A printed number and the half unit of its last digit. Empty where `text` does not begin with a number.
struct PrintedNumber {
  double value = 0;
  double half_unit = 0;
  int decimals = 0;
};
[[nodiscard]] std::optional<PrintedNumber> printed_number(const std::string& text);

/// Match when the computed number, rounded as printed, is the printed one ("Inf" for infinity).
[[nodiscard]] LedgerRow compare(const Claim& claim, double computed, const Account& account);

/// For a printed number that was drawn at random: match within Monte Carlo error up to four standard
/// errors (and the half unit of print) from what is expected.
[[nodiscard]] LedgerRow compare_drawn(const Claim& claim, double expected, double standard_error,
                                      const Account& account);

/// Match when both texts are the same.
[[nodiscard]] LedgerRow compare_text(const Claim& claim, const std::string& computed, const Account& account);

/// For a bound, a count, an order: `holds` is the outcome of the comparison.
[[nodiscard]] LedgerRow judge(const Claim& claim, const std::string& computed, bool holds,
                              const Account& account);

/// One way to read a claim whose definition the paper leaves open.
struct Reading {
  std::string definition;
  std::string computed;
  bool fits = false;
};

/// Match when it holds however it is read, mismatch when it never does; else it hangs on what the paper
/// does not say, and cannot be determined. `open` names what that is.
[[nodiscard]] LedgerRow compare_readings(const Claim& claim, const std::vector<Reading>& readings,
                                         const std::string& open);

/// A setting that the paper states, the first of `values`: match when it alone gives what is printed,
/// mismatch when it does not; cannot be determined when others give it as well.
[[nodiscard]] LedgerRow compare_setting(const Claim& claim, const std::vector<Reading>& values);

/// Nothing to compare with: `why` says what is missing.
[[nodiscard]] LedgerRow not_computable(const Claim& claim, const std::string& why,
                                       const std::string& computed = "", const std::string& definition = "");

/// A row's number where the paper tells it once more.
[[nodiscard]] LedgerRow told_again(LedgerRow row, const std::string& id, const std::string& where);

/// Is `value` as close to the printed number as drawing it at random allows?
[[nodiscard]] bool drawn_fits(const std::string& published, double expected, double standard_error);

}  // namespace asterism
