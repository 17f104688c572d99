// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// What the stations of Tables 15 and 16 measure of a part like the paper's, what the rescan adds, how many
/// views would do, and what the gain is when the platform's turn takes time: rows and Figures 25 and 26.
void add_scan_coverage(Chapter& chapter);

}  // namespace asterism
