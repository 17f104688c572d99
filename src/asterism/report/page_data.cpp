// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/result.hpp"
#include "asterism/report/page.hpp"

namespace asterism {
namespace {

constexpr std::string_view kBlock = "<script type=\"application/json\" id=\"report-data\">";

}  // namespace

std::string page_with_data(std::string_view page, std::string_view json) {
  const std::size_t block = page.find(kBlock);
  require(block != std::string_view::npos, "the report page has a data block");
  const std::size_t begin = block + kBlock.size();
  const std::size_t end = page.find("</script>", begin);
  require(end != std::string_view::npos, "the report page's data block ends");

  std::string whole;
  whole.reserve(page.size() + json.size() + json.size() / 64);
  whole += page.substr(0, begin);
  // In JSON '<' occurs inside strings only, where its escape means the same.
  for (const char c : json) {
    if (c == '<') {
      whole += "\\u003c";
    } else {
      whole += c;
    }
  }
  whole += page.substr(end);
  return whole;
}

}  // namespace asterism
