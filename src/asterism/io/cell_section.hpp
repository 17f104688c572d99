// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/core/options.hpp"
#include "asterism/geometry/types.hpp"
#include "asterism/io/toml_file.hpp"

namespace asterism {

/// One table of a TOML file with what is needed to complain about it. For .cpp files only.
struct CellSection {
  std::filesystem::path file;
  const toml::table& table;
  std::string of;  // "a sweep"

  void only(const std::vector<std::string>& keys) const { refuse_unknown_keys(file, table, of, keys); }
  [[nodiscard]] bool has(const std::string& key) const { return table.contains(key); }
  [[noreturn]] void refuse(const std::string& what) const;
  /// Complains when the key is not there.
  [[nodiscard]] const toml::node& needed(const std::string& key) const;

  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] double number_or(const std::string& key, double otherwise) const;
  [[nodiscard]] std::string text(const std::string& key) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] Vec3 vector(const std::string& key) const;
  [[nodiscard]] Vec3 vector_or_zero(const std::string& key) const;
  /// One of `words`.
  [[nodiscard]] std::string word(const std::string& key, const std::vector<std::string>& words) const;
  [[nodiscard]] CellSection section(const std::string& key, const std::string& inner_of) const;
  /// Those of an array of tables; none when the key is not there.
  [[nodiscard]] std::vector<CellSection> sections(const std::string& key, const std::string& inner_of) const;
};

/// The names of an options struct, and its values from a table (unknown keys are not its business).
[[nodiscard]] std::vector<std::string> option_names(const std::function<void(OptionVisitor&)>& describe);
void read_options_of(const CellSection& section, const std::function<void(OptionVisitor&)>& describe);

}  // namespace asterism
