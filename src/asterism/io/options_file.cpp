// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/options_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "asterism/core/result.hpp"
#include "asterism/io/toml_file.hpp"

namespace asterism {
namespace {

int place_of(const std::string& word, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<int>(found - words.begin());
  throw InputError(fmt::format("is `{}`; it must be one of: {}", word, fmt::join(words, ", ")));
}

class Lister : public OptionVisitor {
 public:
  std::vector<OptionHelp> options;

  void number(std::string_view name, double& value, Limits, std::string_view help) override {
    add(name, "number", fmt::format("{}", value), help);
  }
  void integer(std::string_view name, int& value, Limits, std::string_view help) override {
    add(name, "integer", fmt::format("{}", value), help);
  }
  void flag(std::string_view name, bool& value, std::string_view help) override {
    add(name, "flag", value ? "true" : "false", help);
  }
  void text(std::string_view name, std::string& value, std::string_view help) override {
    add(name, "text", value, help);
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view help) override {
    add(name, fmt::format("{}", fmt::join(words, "|")), words.at(static_cast<std::size_t>(index)), help);
  }

 private:
  void add(std::string_view name, std::string kind, std::string current, std::string_view help) {
    options.push_back({std::string(name), std::move(kind), std::move(current), std::string(help)});
  }
};

class JsonWriter : public OptionVisitor {
 public:
  nlohmann::ordered_json json = nlohmann::ordered_json::object();

  void number(std::string_view name, double& value, Limits, std::string_view) override { at(name) = value; }
  void integer(std::string_view name, int& value, Limits, std::string_view) override { at(name) = value; }
  void flag(std::string_view name, bool& value, std::string_view) override { at(name) = value; }
  void text(std::string_view name, std::string& value, std::string_view) override { at(name) = value; }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view) override {
    at(name) = words.at(static_cast<std::size_t>(index));
  }

 private:
  nlohmann::ordered_json& at(std::string_view name) {
    nlohmann::ordered_json* node = &json;
    for (std::size_t dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
      node = &(*node)[std::string(name.substr(0, dot))];
      name.remove_prefix(dot + 1);
    }
    return (*node)[std::string(name)];
  }
};

template <class Number>
Number number_of(const std::string& text, const char* kind) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || text.empty()) {
    throw InputError(fmt::format("is `{}`; it must be {}", text, kind));
  }
  return value;
}

/// Calls `set` when the option is given; what goes wrong is told with the option's name in front.
class TextReader : public OptionVisitor {
 public:
  explicit TextReader(const std::map<std::string, std::string>& given) : given_(given) {}

  void number(std::string_view name, double& value, Limits limits, std::string_view) override {
    read(name, [&](const std::string& text) {
      const double given = number_of<double>(text, "a number");
      check_number(name, given, limits);
      value = given;
    });
  }
  void integer(std::string_view name, int& value, Limits limits, std::string_view) override {
    read(name, [&](const std::string& text) {
      const int given = number_of<int>(text, "a whole number");
      check_number(name, given, limits);
      value = given;
    });
  }
  void flag(std::string_view name, bool& value, std::string_view) override {
    read(name, [&](const std::string& text) { value = place_of(text, {"false", "true"}) == 1; });
  }
  void text(std::string_view name, std::string& value, std::string_view) override {
    read(name, [&](const std::string& text) { value = text; });
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view) override {
    read(name, [&](const std::string& text) { index = place_of(text, words); });
  }

 private:
  template <class Set>
  void read(std::string_view name, const Set& set) {
    const auto found = given_.find(std::string(name));
    if (found == given_.end()) return;
    try {
      set(found->second);
    } catch (const InputError& error) {
      const std::string message = error.what();
      throw InputError(message.starts_with('`') ? message : fmt::format("`{}` {}", name, message));
    }
  }

  const std::map<std::string, std::string>& given_;
};

/// All leaves of a table as texts, keys joined by dots, each with its line.
void collect(const toml::table& table, const std::string& prefix, std::map<std::string, std::string>& texts,
             std::map<std::string, const toml::node*>& nodes) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, name + ".", texts, nodes);
      continue;
    }
    nodes[name] = &node;
    if (const auto* value = node.as_floating_point()) texts[name] = fmt::format("{}", value->get());
    if (const auto* value = node.as_integer()) texts[name] = fmt::format("{}", value->get());
    if (const auto* value = node.as_boolean()) texts[name] = value->get() ? "true" : "false";
    if (const auto* value = node.as_string()) texts[name] = value->get();
  }
}

}  // namespace

std::vector<OptionHelp> list_options(const OptionsDescription& describe) {
  Lister lister;
  describe(lister);
  return lister.options;
}

nlohmann::ordered_json json_of_options(const OptionsDescription& describe) {
  JsonWriter writer;
  describe(writer);
  return writer.json;
}

void set_options(const std::map<std::string, std::string>& given, const OptionsDescription& describe) {
  TextReader reader(given);
  describe(reader);
}

void read_options(const std::filesystem::path& file, const OptionsDescription& describe) {
  const toml::table table = parse_toml(file);
  std::map<std::string, std::string> texts;
  std::map<std::string, const toml::node*> nodes;
  collect(table, "", texts, nodes);
  std::vector<std::string> known;
  for (const OptionHelp& option : list_options(describe)) known.push_back(option.name);
  for (const auto& [name, node] : nodes) {
    const std::string where = toml_place(file, *node);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError(where, unknown_name_message(name, "the options", known));
    }
    if (!texts.contains(name)) throw InputError(where, fmt::format("`{}` must be one value, no list", name));
    try {
      set_options({{name, texts[name]}}, describe);
    } catch (const InputError& error) {
      throw InputError(where, error.what());
    }
  }
}

}  // namespace asterism
