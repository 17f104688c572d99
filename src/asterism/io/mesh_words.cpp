// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/mesh_words.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool is_number(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc{} && stop == end && !word.empty();
}

}  // namespace

void MeshWords::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}:{}", file_.string(), line_), what);
}

void MeshWords::skip_blanks() {
  for (; at_ < text_.size(); ++at_) {
    if (is_blank(text_[at_])) continue;
    const std::size_t next = text_[at_] == '\\' ? text_.find_first_not_of('\r', at_ + 1) : text_.npos;
    if (next == text_.npos || text_[next] != '\n') break;
    at_ = next;
    ++line_;
  }
  if (comment_ != 0 && at_ < text_.size() && text_[at_] == comment_) {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
}

std::string_view MeshWords::word_in_line() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != '\n' && !is_blank(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool MeshWords::next_line() {
  for (;;) {
    skip_blanks();
    if (at_ >= text_.size()) return false;
    if (text_[at_] != '\n') return true;
    ++at_;
    ++line_;
  }
}

bool MeshWords::at_end() { return !next_line(); }

std::string_view MeshWords::word() {
  if (!next_line()) refuse("the file ends here, in the middle of what it begins: it is cut off");
  return word_in_line();
}

void MeshWords::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

double MeshWords::any_number(std::string_view word) const {
  double value = 0;
  if (word.empty()) refuse("a number is missing at the end of the line");
  if (!is_number(word, value)) refuse(fmt::format("`{}` is no number", word.substr(0, 40)));
  return value;
}

double MeshWords::number(std::string_view word) const {
  const double value = any_number(word);
  if (!std::isfinite(value))
    refuse(fmt::format("a coordinate is `{}`; it must be finite", word.substr(0, 40)));
  return value;
}

long long MeshWords::whole(std::string_view word) const {
  long long value = 0;
  if (!is_number(word, value)) refuse(fmt::format("`{}` is no whole number", word.substr(0, 40)));
  return value;
}

std::size_t MeshWords::count(const char* of, std::size_t bytes) {
  const long long given = whole();
  const std::size_t left = text_.size() - at_;
  if (given < 0 || static_cast<unsigned long long>(given) > left / bytes + 1) {
    refuse(
        fmt::format("says that {} {} follow, for which the file's other {} bytes do not do: it is cut off or "
                    "damaged",
                    given, of, left));
  }
  return static_cast<std::size_t>(given);
}

std::uint32_t MeshWords::vertex(long long index, std::size_t vertices) const {
  if (index >= 0 && static_cast<unsigned long long>(index) < vertices)
    return static_cast<std::uint32_t>(index);
  refuse(fmt::format("a face has corner {}, counted from 0; the file has {} vertices", index, vertices));
}

void add_fan(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k) {
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
}

}  // namespace asterism
