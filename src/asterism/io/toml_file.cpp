// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"

namespace asterism {

toml::table parse_toml(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file.string(), "is a folder, not a TOML file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "cannot be opened; does the file exist?");
  std::ostringstream text;
  text << stream.rdbuf();
  try {
    return toml::parse(text.str(), file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", file.string(), error.source().begin.line),
                     fmt::format("is no valid TOML: {}", error.description()));
  }
}

std::string toml_place(const std::filesystem::path& file, const toml::node& node) {
  return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

void refuse_unknown_keys(const std::filesystem::path& file, const toml::table& table, const std::string& of,
                         const std::vector<std::string>& known) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}:{}", file.string(), key.source().begin.line),
                     unknown_name_message(name, of, known));
  }
}

double toml_number(const std::filesystem::path& file, const toml::node& node, const std::string& name) {
  if (const auto value = node.value_exact<double>()) return *value;
  if (const auto value = node.value_exact<std::int64_t>()) return static_cast<double>(*value);
  throw InputError(toml_place(file, node), fmt::format("`{}` must be a number", name));
}

std::string toml_text(const std::filesystem::path& file, const toml::node& node, const std::string& name) {
  if (auto value = node.value_exact<std::string>()) return *std::move(value);
  throw InputError(toml_place(file, node), fmt::format("`{}` must be a text in quotes", name));
}

std::vector<double> toml_numbers(const std::filesystem::path& file, const toml::node& node,
                                 const std::string& name, std::size_t count) {
  const toml::array* array = node.as_array();
  if (array == nullptr || (count > 0 && array->size() != count)) {
    throw InputError(toml_place(file, node), fmt::format("`{}` must be a list of {} numbers", name, count));
  }
  std::vector<double> numbers;
  for (const toml::node& element : *array) numbers.push_back(toml_number(file, element, name));
  return numbers;
}

}  // namespace asterism
