// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"

namespace asterism {

/// Shows an options struct to a visitor: [&](OptionVisitor& visit) { describe(options, visit); }
using OptionsDescription = std::function<void(OptionVisitor&)>;

/// What one option is, for `--help` and for forms.
struct OptionHelp {
  std::string name;
  std::string kind;     // "number", "integer", "flag", "text", or the words of a choice: "bright|dark"
  std::string current;  // its value as text
  std::string help;
};
[[nodiscard]] std::vector<OptionHelp> list_options(const OptionsDescription& describe);

/// Sets the options that a TOML file names; a dot in an option's name is a table in the file. Throws
/// InputError, with the line, for what is no TOML, an unknown key, a wrong type, a value out of limits.
void read_options(const std::filesystem::path& file, const OptionsDescription& describe);

/// Sets options from texts, as a command line gives them. Throws InputError for a text that is none of
/// the option's values. `given` is by option name.
void set_options(const std::map<std::string, std::string>& given, const OptionsDescription& describe);

/// The options as they are, to be stored with a result.
[[nodiscard]] nlohmann::ordered_json json_of_options(const OptionsDescription& describe);

/// For any options struct with a `describe`.
template <class Options>
[[nodiscard]] OptionsDescription describing(Options& options) {
  return [&options](OptionVisitor& visit) { describe(options, visit); };
}

}  // namespace asterism
