// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

// What the readers of TOML files share. toml++ takes seconds to compile: include this in .cpp files only.

namespace asterism {

/// Throws InputError when the file cannot be read or is no TOML, with the line.
[[nodiscard]] toml::table parse_toml(const std::filesystem::path& file);

/// "cells/a.toml:12"
[[nodiscard]] std::string toml_place(const std::filesystem::path& file, const toml::node& node);

/// Throws InputError for the first key of `table` that is none of `known`, with the nearest name.
void refuse_unknown_keys(const std::filesystem::path& file, const toml::table& table, const std::string& of,
                         const std::vector<std::string>& known);

/// A number, a text or `count` numbers (0 = any number of them) that must be there, or InputError.
[[nodiscard]] double toml_number(const std::filesystem::path& file, const toml::node& node,
                                 const std::string& name);
[[nodiscard]] std::string toml_text(const std::filesystem::path& file, const toml::node& node,
                                    const std::string& name);
[[nodiscard]] std::vector<double> toml_numbers(const std::filesystem::path& file, const toml::node& node,
                                               const std::string& name, std::size_t count);

}  // namespace asterism
