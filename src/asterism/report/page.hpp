// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace asterism {

/// The built page (web/, one HTML file with styles and script inside), without data.
[[nodiscard]] std::string_view report_page();

/// The page with `json` in its data block. What HTML could read as markup is escaped, so that no name in
/// the data can end the block early.
[[nodiscard]] std::string page_with_data(std::string_view page, std::string_view json);

}  // namespace asterism
