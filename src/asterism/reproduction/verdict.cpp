// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kStandardErrors = 4;
constexpr double kRounding = 1e-9;  // of binary numbers at the half unit itself

/// Two digits more than were printed; a count stays a count.
std::string text_of(double computed, int decimals) {
  if (std::isinf(computed)) return computed > 0 ? "Inf" : "-Inf";
  if (decimals == 0 && computed == std::round(computed)) return fmt::format("{:.0f}", computed);
  return fmt::format("{:.{}f}", computed, decimals + 2);
}

LedgerRow row_of(const Claim& claim, std::string computed, Verdict verdict, const Account& account,
                 const std::string& differs = "") {
  LedgerRow row{claim, std::move(computed), account.definition, verdict, account.note};
  if (verdict == Verdict::Mismatch) {
    row.reason = differs;
    if (!account.if_not.empty()) row.reason += (differs.empty() ? "" : "; ") + account.if_not;
  }
  return row;
}

PrintedNumber number_of(const Claim& claim) {
  const auto printed = printed_number(claim.published);
  require(printed.has_value(), "a number is compared with a printed number");
  return *printed;
}

}  // namespace

std::string words(Verdict verdict) {
  switch (verdict) {
    case Verdict::Match:
      return "match";
    case Verdict::MatchWithinMonteCarloError:
      return "match within Monte Carlo error";
    case Verdict::Mismatch:
      return "mismatch";
    case Verdict::CannotBeDetermined:
      return "cannot be determined";
  }
  return "";
}

std::optional<PrintedNumber> printed_number(const std::string& text) {
  if (text == "Inf") return PrintedNumber{INFINITY, 0, 0};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const auto length = static_cast<std::size_t>(end - text.c_str());
  if (length == 0) return std::nullopt;
  const std::size_t point = text.substr(0, length).find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(length - point - 1);
  return PrintedNumber{value, 0.5 * std::pow(10.0, -decimals), decimals};
}

LedgerRow compare(const Claim& claim, double computed, const Account& account) {
  const PrintedNumber printed = number_of(claim);
  const double gap = std::abs(computed - printed.value);
  const bool same = computed == printed.value || gap <= printed.half_unit + kRounding;
  return row_of(claim, text_of(computed, printed.decimals), same ? Verdict::Match : Verdict::Mismatch,
                account, fmt::format("differs by {:.4g}, rounding allows {:g}", gap, printed.half_unit));
}

bool drawn_fits(const std::string& published, double expected, double standard_error) {
  const auto printed = printed_number(published);
  require(printed.has_value(), "a number is compared with a printed number");
  return std::abs(expected - printed->value) <=
         kStandardErrors * standard_error + printed->half_unit + kRounding;
}

LedgerRow compare_drawn(const Claim& claim, double expected, double standard_error, const Account& account) {
  const PrintedNumber printed = number_of(claim);
  const double errors = standard_error > 0 ? std::abs(expected - printed.value) / standard_error : INFINITY;
  const bool fits = drawn_fits(claim.published, expected, standard_error);
  LedgerRow row = row_of(claim, text_of(expected, printed.decimals),
                         fits ? Verdict::MatchWithinMonteCarloError : Verdict::Mismatch, account,
                         fmt::format("{:.1f} standard errors away", errors));
  if (!fits) return row;
  const std::string how_far = fmt::format("{:.1f} standard errors of {:.3g} apart", errors, standard_error);
  row.reason = row.reason.empty() ? how_far : how_far + "; " + row.reason;
  return row;
}

LedgerRow compare_text(const Claim& claim, const std::string& computed, const Account& account) {
  return judge(claim, computed, computed == claim.published, account);
}

LedgerRow judge(const Claim& claim, const std::string& computed, bool holds, const Account& account) {
  return row_of(claim, computed, holds ? Verdict::Match : Verdict::Mismatch, account);
}

LedgerRow compare_readings(const Claim& claim, const std::vector<Reading>& readings,
                           const std::string& open) {
  require(!readings.empty(), "a claim is read in one way or more");
  std::string fitting, failing;
  std::size_t fits = 0;
  for (const Reading& reading : readings) {
    std::string& list = reading.fits ? fitting : failing;
    list += fmt::format("{}{}: {}", list.empty() ? "" : "; ", reading.definition, reading.computed);
    fits += reading.fits;
  }
  LedgerRow row{claim, readings.front().computed, readings.front().definition, Verdict::Match, ""};
  if (fits == readings.size()) {
    row.reason = fmt::format("however it is read ({})", fitting);
  } else if (fits == 0) {
    row.verdict = Verdict::Mismatch;
    row.reason = fmt::format("however it is read ({})", failing);
  } else {
    row.verdict = Verdict::CannotBeDetermined;
    row.reason = fmt::format("{}. It fits with {}. It does not with {}", open, fitting, failing);
  }
  return row;
}

LedgerRow compare_setting(const Claim& claim, const std::vector<Reading>& values) {
  require(values.size() >= 2, "a setting is told from others");
  std::string all;
  bool others = false;
  for (const Reading& value : values) {
    all += fmt::format("{}{}: {}, {}", all.empty() ? "" : "; ", value.definition, value.computed,
                       value.fits ? "fits" : "does not");
    others = others || (value.fits && &value != &values.front());
  }
  LedgerRow row{claim, values.front().definition, "what gives the printed figures", Verdict::Match, all};
  if (!values.front().fits) {
    row.verdict = Verdict::Mismatch;
  } else if (others) {
    row.verdict = Verdict::CannotBeDetermined;
    row.reason = "other values give the printed figures as well: " + all;
  }
  return row;
}

LedgerRow not_computable(const Claim& claim, const std::string& why, const std::string& computed,
                         const std::string& definition) {
  return {claim, computed, definition, Verdict::CannotBeDetermined, why};
}

LedgerRow told_again(LedgerRow row, const std::string& id, const std::string& where) {
  row.definition = "as " + row.claim.id;
  row.claim.id = id;
  row.claim.where = where;
  return row;
}

}  // namespace asterism
