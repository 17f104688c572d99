// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asterism {

/// A CSV file with a header line, read strictly: what is wrong is told as an InputError with file, line
/// and column, and nothing is guessed. Columns may come in any order; those nobody asks for are ignored.
class CsvTable {
 public:
  CsvTable(std::filesystem::path file, const std::vector<std::string>& required);

  [[nodiscard]] std::size_t rows() const { return lines_.size(); }
  [[nodiscard]] bool has(std::string_view column) const;

  /// Empty when the cell is empty or the column not there.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
  [[nodiscard]] double number(std::size_t row, std::string_view column) const;
  [[nodiscard]] int integer(std::size_t row, std::string_view column) const;
  [[nodiscard]] std::optional<double> optional_number(std::size_t row, std::string_view column) const;
  [[nodiscard]] std::optional<int> optional_integer(std::size_t row, std::string_view column) const;

  /// "points.csv:12"
  [[nodiscard]] std::string place(std::size_t row) const;
  /// Throws InputError: "points.csv:12: column `x_mm`: …"
  [[noreturn]] void refuse(std::size_t row, std::string_view column, const std::string& what) const;

 private:
  std::filesystem::path file_;
  std::map<std::string, std::size_t, std::less<>> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;  // where each row stands
};

/// Quoted where it holds a comma, a quote or a line's end.
[[nodiscard]] std::string csv_cell(const std::string& text);

}  // namespace asterism
