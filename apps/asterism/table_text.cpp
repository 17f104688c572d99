// SPDX-License-Identifier: Apache-2.0
#include "table_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace asterism::app {
namespace {

std::string text_of(const ReportTable::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.6g}", *number);
  return "–";
}

/// How many columns of a terminal a text takes: bytes that go on a character are none.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return left ? text + space : space + text;
}

}  // namespace

std::string text_of_table(const ReportTable& table) {
  std::vector<std::vector<std::string>> rows = {table.columns};
  for (const auto& row : table.rows) {
    auto& texts = rows.emplace_back();
    for (const ReportTable::Value& value : row) texts.push_back(text_of(value));
  }
  std::string text = "\n" + table.title + "\n";
  for (const auto& row : rows) {
    text += " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, width_of(other[i]));
      text += " " + padded(row[i], width + 1, i == 0);
    }
    text += "\n";
  }
  return text + (table.note.empty() ? "" : "  " + table.note + "\n");
}

}  // namespace asterism::app
