// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/csv_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "asterism/core/options.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// One record of RFC 4180; `rest` is moved behind it, `line` counts the lines it takes.
std::vector<std::string> take_record(std::string_view& rest, int& line, const std::string& file) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  const int first_line = line;
  std::size_t i = 0;
  for (; i < rest.size(); ++i) {
    const char c = rest[i];
    if (c == '\n') ++line;
    if (quoted && c == '"' && i + 1 < rest.size() && rest[i + 1] == '"') {
      cells.back() += rest[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      cells.emplace_back();
    } else if (!quoted && c == '\n') {
      break;
    } else if (quoted || c != '\r') {
      cells.back() += c;
    }
  }
  if (quoted) throw InputError(fmt::format("{}:{}", file, first_line), "a quote is opened and never closed");
  rest.remove_prefix(std::min(i + 1, rest.size()));
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

template <class Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

CsvTable::CsvTable(std::filesystem::path file, const std::vector<std::string>& required)
    : file_(std::move(file)) {
  const std::string content = read_file(file_);
  std::string_view rest = content;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  int line = 1;
  const std::vector<std::string> header = take_record(rest, line, file_.string());
  const std::string head = fmt::format("{}:1", file_.string());
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (!columns_.emplace(header[i], i).second) {
      throw InputError(head, fmt::format("column `{}` is given twice", header[i]));
    }
  }
  for (const std::string& column : required) {
    if (has(column)) continue;
    const std::string nearest = nearest_name(column, header);
    throw InputError(head, fmt::format("column `{}` is missing{}; needed are: {}", column,
                                       nearest.empty() ? "" : fmt::format(" (is it `{}`?)", nearest),
                                       fmt::join(required, ",")));
  }
  while (!rest.empty()) {
    const int first_line = line;
    std::vector<std::string> cells = take_record(rest, line, file_.string());
    if (cells.size() == 1 && cells.front().empty()) continue;
    if (cells.size() != header.size()) {
      throw InputError(fmt::format("{}:{}", file_.string(), first_line),
                       fmt::format("has {} cells where the header has {}", cells.size(), header.size()));
    }
    cells_.push_back(std::move(cells));
    lines_.push_back(first_line);
  }
}

bool CsvTable::has(std::string_view column) const { return columns_.find(column) != columns_.end(); }

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  static const std::string empty;
  const auto found = columns_.find(column);
  return found == columns_.end() ? empty : cells_[row][found->second];
}

std::optional<double> CsvTable::optional_number(std::size_t row, std::string_view column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::nullopt;
  const auto value = parsed<double>(cell);
  if (!value || !std::isfinite(*value)) refuse(row, column, fmt::format("`{}` is no finite number", cell));
  return value;
}

std::optional<int> CsvTable::optional_integer(std::size_t row, std::string_view column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::nullopt;
  const auto value = parsed<int>(cell);
  if (!value) refuse(row, column, fmt::format("`{}` is no whole number", cell));
  return value;
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  const auto value = optional_number(row, column);
  if (!value) refuse(row, column, "is empty; a number is needed");
  return *value;
}

int CsvTable::integer(std::size_t row, std::string_view column) const {
  const auto value = optional_integer(row, column);
  if (!value) refuse(row, column, "is empty; a whole number is needed");
  return *value;
}

std::string CsvTable::place(std::size_t row) const {
  return fmt::format("{}:{}", file_.string(), lines_[row]);
}

void CsvTable::refuse(std::size_t row, std::string_view column, const std::string& what) const {
  throw InputError(place(row), fmt::format("column `{}`: {}", column, what));
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace asterism
