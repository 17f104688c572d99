// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

namespace asterism::bench {
namespace {

double seconds_of(const std::function<void()>& call, int times) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i) call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

Table::Table(std::string title, std::vector<std::string> columns)
    : title_(std::move(title)), columns_(std::move(columns)) {
  fmt::print(stderr, "\n{}\n", title_);
  for (const auto& column : columns_) fmt::print(stderr, "{:>18}", column);
  fmt::print(stderr, "\n");
}

void Table::row(const std::vector<std::string>& cells) {
  for (const auto& cell : cells) fmt::print(stderr, "{:>18}", cell);
  fmt::print(stderr, "\n");
  rows_.push_back(cells);
}

void Table::print_json() const {
  nlohmann::json json = {{"title", title_},          {"columns", columns_},     {"rows", rows_},
                         {"processor", processor()}, {"compiler", __VERSION__}, {"date", __DATE__}};
  fmt::print("{}\n", json.dump());
}

double median_seconds(const std::function<void()>& call, int repeats) {
  return median_seconds_in_turn({call}, repeats)[0];
}

std::vector<double> median_seconds_in_turn(const std::vector<std::function<void()>>& calls, int repeats) {
  std::vector<int> times;
  for (const auto& call : calls)
    times.push_back(std::max(1, static_cast<int>(2e-3 / std::max(1e-9, seconds_of(call, 1)))));
  std::vector<std::vector<double>> samples(calls.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t i = 0; i < calls.size(); ++i)
      samples[i].push_back(seconds_of(calls[i], times[i]) / times[i]);
  }
  std::vector<double> medians;
  for (auto& sample : samples) medians.push_back(median(std::move(sample)));
  return medians;
}

}  // namespace asterism::bench
