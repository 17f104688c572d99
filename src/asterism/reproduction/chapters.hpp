// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asterism/reproduction/verdict.hpp"

// The paper, chapter by chapter: every number it prints with ours beside it, and its figures drawn anew.

namespace asterism {

/// A figure or table of the paper, drawn from computed values. `html` is an SVG or a table.
struct Exhibit {
  std::string id;     // F14, T13
  std::string title;  // Figure 14. …
  std::string caption;
  std::string html;
};

struct Chapter {
  std::string title;
  std::vector<LedgerRow> rows;
  std::vector<Exhibit> exhibits;
};

/// Section 2.1: Figures 1 to 5.
[[nodiscard]] Chapter projection_chapter();
/// Sections 2.2 and 2.3: Tables 1 and 2, Figures 6 to 10.
[[nodiscard]] Chapter frames_chapter();
/// Section 3.3: Figure 14.
[[nodiscard]] Chapter losses_chapter(std::uint64_t seed);
/// Sections 3.2 and 4.2: Tables 3 to 12, Figures 12, 13, 17 to 19.
[[nodiscard]] Chapter layouts_chapter(std::uint64_t seed);
/// Sections 3.1, 4.1 and 4.3 (1): Figures 11, 15, 16 and 20.
[[nodiscard]] Chapter motion_chapter();
/// Section 4.3 (2) and the conclusion: Tables 13 and 14, Figures 21 to 24.
[[nodiscard]] Chapter errors_chapter(std::uint64_t seed);
/// Section 4.3 (3): Tables 15 and 16, Figures 25 and 26.
[[nodiscard]] Chapter scanning_chapter();

}  // namespace asterism
