// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// The words of a text file one after the other, with the line for complaints. A line that ends in a
/// backslash goes on in the next.
class MeshWords {
 public:
  /// From a `comment` sign to the end of its line nothing is read; 0 = there is none.
  MeshWords(std::string_view text, std::filesystem::path file, char comment, std::size_t line = 1)
      : text_(text), file_(std::move(file)), comment_(comment), line_(line) {}

  [[noreturn]] void refuse(const std::string& what) const;

  /// The next word of the file; complains at its end.
  [[nodiscard]] std::string_view word();
  /// The next word of this line; empty at its end.
  [[nodiscard]] std::string_view word_in_line();
  /// Goes to the next line that has a word; false at the end of the file.
  bool next_line();
  /// Passes over what is left of this line.
  void skip_line();
  [[nodiscard]] bool at_end();

  /// Complains about a word, read before, that is no number; NaN and infinity are numbers.
  [[nodiscard]] double any_number(std::string_view word) const;
  /// Finite, or it complains.
  [[nodiscard]] double number(std::string_view word) const;
  [[nodiscard]] long long whole(std::string_view word) const;
  [[nodiscard]] double number() { return number(word()); }
  [[nodiscard]] long long whole() { return whole(word()); }
  /// A count that the rest of the file can hold, each in `bytes` or more.
  [[nodiscard]] std::size_t count(const char* of, std::size_t bytes);

  /// Complains unless 0 ≤ index < vertices.
  [[nodiscard]] std::uint32_t vertex(long long index, std::size_t vertices) const;
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  void skip_blanks();

  std::string_view text_;
  std::filesystem::path file_;
  char comment_;
  std::size_t at_ = 0, line_ = 1;
};

/// A polygon as triangles around its first corner.
void add_fan(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace asterism
