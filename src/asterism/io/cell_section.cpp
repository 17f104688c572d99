// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

class SectionReader : public OptionVisitor {
 public:
  explicit SectionReader(const CellSection& section) : section_(section) {}
  void number(std::string_view name, double& value, Limits limits, std::string_view) override {
    if (section_.has(std::string(name))) value = checked(name, limits);
  }
  void integer(std::string_view name, int& value, Limits limits, std::string_view) override {
    if (!section_.has(std::string(name))) return;
    const double given = checked(name, limits);
    if (given != std::floor(given)) refuse(name, "must be a whole number");
    value = static_cast<int>(given);
  }
  void flag(std::string_view name, bool& value, std::string_view) override {
    if (!section_.has(std::string(name))) return;
    value = section_.flag(std::string(name));
  }
  void text(std::string_view name, std::string& value, std::string_view) override {
    if (section_.has(std::string(name))) value = section_.text(std::string(name));
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view) override {
    if (!section_.has(std::string(name))) return;
    const std::string given = section_.word(std::string(name), words);
    index = static_cast<int>(std::find(words.begin(), words.end(), given) - words.begin());
  }

 private:
  [[noreturn]] void refuse(std::string_view name, const std::string& what) const {
    throw InputError(toml_place(section_.file, section_.needed(std::string(name))),
                     fmt::format("`{}` {}", name, what));
  }
  [[nodiscard]] double checked(std::string_view name, Limits limits) const {
    const double value = section_.number(std::string(name));
    try {
      check_number(name, value, limits);
    } catch (const InputError& error) {
      throw InputError(toml_place(section_.file, section_.needed(std::string(name))), error.what());
    }
    return value;
  }

  const CellSection& section_;
};

/// Reads what stands there as what the form says it is, for the complaint alone.
void check_key(const CellSection& section, const Key& key) {
  switch (key.holds) {
    case Holds::Number:
      static_cast<void>(section.number(key.name));
      return;
    case Holds::Whole: {
      const double given = section.number(key.name);
      if (given == std::floor(given) && std::abs(given) < 1e9) return;
      throw InputError(toml_place(section.file, section.needed(key.name)),
                       fmt::format("`{}` must be a whole number", key.name));
    }
    case Holds::Flag:
      static_cast<void>(section.flag(key.name));
      return;
    case Holds::Text:
      static_cast<void>(section.text(key.name));
      return;
    case Holds::Word:
      static_cast<void>(section.word(key.name, key.words));
      return;
    case Holds::Numbers:
      static_cast<void>(section.numbers(key.name, key.count));
      return;
    case Holds::Table:
      static_cast<void>(section.section(key.name, ""));
      return;
    case Holds::Tables:
      static_cast<void>(section.sections(key.name, ""));
      return;
  }
}

}  // namespace

void CellSection::must_be(const Form& form) const {
  refuse_unknown_keys(file, table, form.of, form.names());
  for (const Key& key : form.keys) {
    if (has(key.name)) {
      check_key(*this, key);
    } else if (key.needed) {
      refuse(fmt::format("{} has no `{}`", form.of, key.name));
    }
  }
}

void CellSection::only_keys_of(const std::vector<Form>& forms) const {
  std::vector<std::string> known;
  for (const Form& form : forms) {
    for (std::string& name : form.names()) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(std::move(name));
    }
  }
  refuse_unknown_keys(file, table, of, known);
}

void CellSection::refuse(const std::string& what) const { throw InputError(toml_place(file, table), what); }

const toml::node& CellSection::needed(const std::string& key) const {
  if (const toml::node* node = table.get(key)) return *node;
  refuse(fmt::format("{} has no `{}`", of, key));
}

double CellSection::number(const std::string& key) const { return toml_number(file, needed(key), key); }

double CellSection::number_or(const std::string& key, double otherwise) const {
  return has(key) ? number(key) : otherwise;
}

bool CellSection::flag(const std::string& key) const {
  if (const auto given = needed(key).value_exact<bool>()) return *given;
  throw InputError(toml_place(file, needed(key)), fmt::format("`{}` must be true or false", key));
}

std::string CellSection::text(const std::string& key) const { return toml_text(file, needed(key), key); }

std::vector<double> CellSection::numbers(const std::string& key, std::size_t count) const {
  return toml_numbers(file, needed(key), key, count);
}

Vec3 CellSection::vector(const std::string& key) const {
  const std::vector<double> values = numbers(key, 3);
  return {values[0], values[1], values[2]};
}

Vec3 CellSection::vector_or_zero(const std::string& key) const {
  return has(key) ? vector(key) : Vec3::Zero();
}

std::string CellSection::word(const std::string& key, const std::vector<std::string>& words) const {
  std::string given = text(key);
  if (std::find(words.begin(), words.end(), given) != words.end()) return given;
  throw InputError(toml_place(file, needed(key)),
                   fmt::format("`{}` is `{}`; it must be one of: {}", key, given, fmt::join(words, ", ")));
}

CellSection CellSection::section(const std::string& key, const std::string& inner_of) const {
  const toml::node& node = needed(key);
  const toml::table* inner = node.as_table();
  if (inner == nullptr) throw InputError(toml_place(file, node), fmt::format("`{}` must be a table", key));
  return {file, *inner, inner_of};
}

std::vector<CellSection> CellSection::sections(const std::string& key, const std::string& inner_of) const {
  std::vector<CellSection> inner;
  const toml::node* node = table.get(key);
  if (node == nullptr) return inner;
  const toml::array* array = node->as_array();
  const bool all_tables =
      array != nullptr &&
      std::all_of(array->begin(), array->end(), [](const toml::node& one) { return one.is_table(); });
  if (!all_tables) {
    throw InputError(toml_place(file, *node),
                     fmt::format("`{}` must be tables, each begun by [[…{}]]", key, key));
  }
  for (const toml::node& one : *array) inner.push_back({file, *one.as_table(), inner_of});
  return inner;
}

void read_options_of(const CellSection& section, const std::function<void(OptionVisitor&)>& describe) {
  SectionReader reader(section);
  describe(reader);
}

}  // namespace asterism
