// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/verification.hpp"

namespace asterism {

void describe(Verification& verification, OptionVisitor& visit) {
  visit.text("body", verification.body, "whose pose counts; the platform's unless told");
  visit.number("tolerance_mm", verification.tolerance_mm, {0, 1e4}, "largest error allowed at a point");
  visit.number("nominal_mm", verification.nominal_mm, {0, 1e4}, "the tracker's nominal accuracy");
}

}  // namespace asterism
