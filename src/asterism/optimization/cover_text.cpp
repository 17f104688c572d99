// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/cover_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPerLine = 20;

template <class Numbers>
void append(std::string& text, const Numbers& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    fmt::format_to(std::back_inserter(text), "{}{}", numbers[k],
                   (k + 1) % kPerLine == 0 || k + 1 == numbers.size() ? "\n" : " ");
}

/// The text's words one after the other.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// Empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  double number(const char* what) {
    const std::string_view word = next();
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty()) fail(fmt::format("ends where {} should be", what));
    if (error != std::errc{} || end != word.data() + word.size())
      fail(fmt::format("`{}` where {} should be", word, what));
    return value;
  }

  std::size_t count(const char* what, double least, double most) {
    const double value = number(what);
    if (!(value >= least && value <= most) || value != static_cast<double>(static_cast<std::size_t>(value)))
      fail(fmt::format("{} is {}; it must be a whole number from {} to {}", what, value, least, most));
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}", name_, line_), what);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void read_rows(Words& words, SetCoverProblem& problem) {
  const auto columns = static_cast<double>(problem.columns.size());
  for (std::size_t i = 0; i < problem.rows; ++i) {
    const std::size_t count = words.count("how many columns cover a row", 0, columns);
    for (std::size_t k = 0; k < count; ++k) {
      auto& column = problem.columns[words.count("a column", 1, columns) - 1];
      const auto row = static_cast<std::uint32_t>(i);
      if (column.empty() || column.back() != row) column.push_back(row);
    }
  }
}

void read_more(Words& words, SetCoverProblem& problem) {
  for (auto word = words.next(); !word.empty(); word = words.next()) {
    if (word == "share") {
      problem.share = words.number("the share");
    } else if (word == "weights") {
      for (std::size_t i = 0; i < problem.rows; ++i) problem.weight.push_back(words.number("a row's weight"));
    } else if (word == "demands") {
      for (std::size_t i = 0; i < problem.rows; ++i)
        problem.demand.push_back(static_cast<int>(words.count("a row's demand", 0, 1e9)));
    } else if (word == "group_costs") {
      const std::size_t groups = words.count("how many groups there are", 0, 1e9);
      for (std::size_t g = 0; g < groups; ++g) problem.group_cost.push_back(words.number("a group's cost"));
    } else if (word == "groups") {
      for (std::size_t j = 0; j < problem.columns.size(); ++j)
        problem.group.push_back(static_cast<std::uint32_t>(words.count("a column's group", 1, 1e9) - 1));
    } else {
      words.fail(
          fmt::format("`{}` is no part of a cover problem; share, weights, demands, group_costs or groups "
                      "may follow its rows",
                      word));
    }
  }
}

}  // namespace

std::string text_of(const SetCoverProblem& problem) {
  std::vector<std::vector<std::uint32_t>> covering(problem.rows);
  for (std::uint32_t j = 0; j < problem.columns.size(); ++j)
    for (const std::uint32_t row : problem.columns[j]) covering[row].push_back(j + 1);
  std::vector<double> weights;
  std::vector<int> demands;
  std::string rows;
  std::size_t count = 0;
  for (std::size_t i = 0; i < problem.rows; ++i) {
    if (covering[i].empty()) continue;
    ++count;
    rows += fmt::format("{}\n", covering[i].size());
    append(rows, covering[i]);
    if (!problem.weight.empty()) weights.push_back(problem.weight[i]);
    if (!problem.demand.empty()) demands.push_back(problem.demand[i]);
  }
  std::string text = fmt::format("{} {}\n", count, problem.columns.size());
  append(text, problem.cost.empty() ? std::vector<double>(problem.columns.size(), 1.0) : problem.cost);
  text += rows;
  if (problem.share < 1) text += fmt::format("share {}\n", problem.share);
  if (!weights.empty()) append(text += "weights\n", weights);
  if (!demands.empty()) append(text += "demands\n", demands);
  if (!problem.group.empty()) {
    text += fmt::format("group_costs {}\n", problem.group_cost.size());
    append(text, problem.group_cost);
    std::vector<std::uint32_t> groups = problem.group;
    for (std::uint32_t& group : groups) ++group;
    append(text += "groups\n", groups);
  }
  return text;
}

SetCoverProblem cover_problem_of(std::string_view text, const std::string& name) {
  Words words(text, name);
  SetCoverProblem problem;
  problem.rows = words.count("the number of rows", 0, 1e8);
  // each column has a cost of two characters at least: no more memory than the text is worth
  problem.columns.resize(words.count("the number of columns", 0, static_cast<double>(text.size())));
  for (std::size_t j = 0; j < problem.columns.size(); ++j)
    problem.cost.push_back(words.number("a column's cost"));
  read_rows(words, problem);
  read_more(words, problem);
  return problem;
}

}  // namespace asterism
