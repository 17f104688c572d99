// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace asterism {

/// How a summary row is marked: in words and colour.
enum class Verdict { Plain, Good, Attention, Bad };

/// One line of the table that the reader sees first.
struct SummaryRow {
  std::string label;  // "Translation error, platform"
  std::string value;  // "0.0048", formatted by who knows what its digits are worth
  std::string unit;   // "mm RMS"
  std::string note;   // what it means, against what
  Verdict verdict = Verdict::Plain;
};

}  // namespace asterism
