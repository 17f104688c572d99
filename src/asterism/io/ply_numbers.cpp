// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/ply_numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

constexpr std::size_t kLongestWord = 400;

}  // namespace

void PlyNumbers::refuse(const std::string& what) const {
  const std::string file = stream_.file().string();
  throw InputError(encoding_ == PlyEncoding::Text ? fmt::format("{}:{}", file, line_)
                                                  : fmt::format("{}: byte {}", file, stream_.at()),
                   what);
}

std::size_t PlyNumbers::least(PlyNumber type) const {
  return encoding_ == PlyEncoding::Text ? 2 : size_of(type);
}

std::size_t PlyNumbers::left() const { return stream_.left() + (encoding_ == PlyEncoding::Text ? 1U : 0U); }

void PlyNumbers::check_count(const PlyElement& element) const {
  std::size_t bytes = 0;  // of one at least; a list may be empty
  for (const PlyProperty& one : element.properties) bytes += least(one.count.value_or(one.value));
  if (bytes == 0 || element.count <= left() / bytes) return;
  refuse(
      fmt::format("the header says that {} of element `{}` follow, for which the file's other {} bytes "
                  "do not do: it is cut off or damaged",
                  element.count, element.name, stream_.left()));
}

std::string_view PlyNumbers::word() {
  for (;;) {
    const std::string_view bytes = stream_.ready(kLongestWord);
    std::size_t begin = 0;
    for (; begin < bytes.size() && is_blank(bytes[begin]); ++begin) line_ += bytes[begin] == '\n' ? 1U : 0U;
    std::size_t end = begin;
    while (end < bytes.size() && !is_blank(bytes[end])) ++end;
    if (bytes.empty()) refuse("the file ends here: it is cut off");
    stream_.take(begin);
    if (end < bytes.size() || end - begin >= kLongestWord || stream_.left() == end - begin) {
      if (end == begin) continue;
      stream_.take(end - begin);
      return bytes.substr(begin, end - begin);
    }
  }
}

double PlyNumbers::next(PlyNumber type) {
  if (encoding_ != PlyEncoding::Text) {
    const std::string_view bytes = stream_.ready(size_of(type));
    if (bytes.size() < size_of(type)) refuse("the file ends here: it is cut off");
    stream_.take(size_of(type));
    return number_of(type, bytes, order_);
  }
  std::string_view text = word();
  const std::string_view whole = text;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) refuse(fmt::format("`{}` is no number", whole.substr(0, 40)));
  return value;
}

std::size_t PlyNumbers::list_size(const PlyProperty& list) {
  const double count = next(*list.count);
  if (!(count >= 0) || count != std::floor(count) ||
      count > static_cast<double>(left() / least(list.value))) {
    refuse(
        fmt::format("a list of `{}` says that {} numbers follow, for which the file's other {} bytes do "
                    "not do: it is cut off or damaged",
                    list.name, count, stream_.left()));
  }
  return static_cast<std::size_t>(count);
}

}  // namespace asterism
