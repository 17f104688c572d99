// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/core/options.hpp"
#include "asterism/geometry/types.hpp"
#include "asterism/io/cell_forms.hpp"
#include "asterism/io/toml_file.hpp"

namespace asterism {

/// One table of a TOML file with what is needed to complain about it. For .cpp files only.
struct CellSection {
  std::filesystem::path file;
  const toml::table& table;
  std::string of;  // "a sweep"

  /// Complains of the first unknown key, of a wrong type, of what is needed and not there.
  void must_be(const Form& form) const;
  /// Complains of a key that none of the forms knows; for tables whose form is told by a key.
  void only_keys_of(const std::vector<Form>& forms) const;
  [[nodiscard]] bool has(const std::string& key) const { return table.contains(key); }
  [[noreturn]] void refuse(const std::string& what) const;
  /// Complains when the key is not there.
  [[nodiscard]] const toml::node& needed(const std::string& key) const;

  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] double number_or(const std::string& key, double otherwise) const;
  [[nodiscard]] bool flag(const std::string& key) const;
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

/// The values of an options struct from a table (unknown keys are not its business).
void read_options_of(const CellSection& section, const std::function<void(OptionVisitor&)>& describe);

}  // namespace asterism
