// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/scan_plan.hpp"

namespace asterism {

std::string_view text_of(ScanLimit limit) {
  switch (limit) {
    case ScanLimit::Range:
      return "range";
    case ScanLimit::Field:
      return "field";
    case ScanLimit::Incidence:
      return "incidence";
    case ScanLimit::Sight:
      return "free sight";
    case ScanLimit::Clearance:
      return "clearance of the scanner";
    case ScanLimit::Floor:
      return "floor";
    case ScanLimit::Reach:
      return "reach of the robot";
    case ScanLimit::ScannerTargets:
      return "scanner's targets seen";
    case ScanLimit::PlatformTargets:
      return "platform's targets seen";
    case ScanLimit::Uncertainty:
      return "uncertainty";
  }
  return "";
}

}  // namespace asterism
