// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asterism/io/cell_forms.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

/// The options of a struct as properties.
class PropertyWriter : public OptionVisitor {
 public:
  explicit PropertyWriter(Json& properties) : properties_(properties) {}
  void number(std::string_view name, double& value, Limits limits, std::string_view help) override {
    add_limits(add(name, "number", help, value), limits);
  }
  void integer(std::string_view name, int& value, Limits limits, std::string_view help) override {
    add_limits(add(name, "integer", help, value), limits);
  }
  void flag(std::string_view name, bool& value, std::string_view help) override {
    add(name, "boolean", help, value);
  }
  void text(std::string_view name, std::string& value, std::string_view help) override {
    add(name, "string", help, value);
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view help) override {
    add(name, "string", help, words.at(static_cast<std::size_t>(index)))["enum"] = words;
  }

 private:
  Json& add(std::string_view name, const char* type, std::string_view help, const Json& value) {
    Json& property = properties_[std::string(name)];
    property = {{"type", type}, {"description", help}, {"default", value}};
    return property;
  }
  static void add_limits(Json& property, Limits limits) {
    if (std::isfinite(limits.lowest)) property["minimum"] = limits.lowest;
    if (std::isfinite(limits.highest)) property["maximum"] = limits.highest;
  }

  Json& properties_;
};

/// "[platform.stroke]" → "platform.stroke", "a cylinder-side" → "cylinder-side".
std::string plain_name(std::string of) {
  for (const std::string_view article : {"a ", "an ", "["}) {
    if (!of.starts_with(article)) continue;
    of.erase(0, article.size());
    break;
  }
  if (of.ends_with(']')) of.pop_back();
  std::replace(of.begin(), of.end(), ' ', '-');
  return of;
}

/// Forms that stand at several places are told once, under $defs.
class Definitions {
 public:
  Json of_form(const Form& form) {
    Json properties = Json::object(), required = Json::array();
    for (const Key& key : form.keys) {
      properties[key.name] = of_key(key);
      if (key.needed) required.push_back(key.name);
    }
    PropertyWriter options(properties);
    if (form.options) form.options(options);
    Json schema = {{"type", "object"}, {"properties", properties}};
    if (!required.empty()) schema["required"] = required;
    schema["additionalProperties"] = false;
    return schema;
  }
  [[nodiscard]] const Json& all() const { return all_; }

 private:
  Json reference_to(const Form& form) {
    const Json schema = of_form(form);
    const std::string plain = plain_name(form.of);
    std::string name = plain;
    for (int other = 2; all_.contains(name) && all_[name] != schema; ++other) {
      name = fmt::format("{}-{}", plain, other);
    }
    all_[name] = schema;
    return {{"$ref", "#/$defs/" + name}};
  }

  Json one_of(const std::vector<Form>& forms) {
    if (forms.size() == 1) return reference_to(forms[0]);
    Json choices = Json::array();
    for (const Form& form : forms) choices.push_back(reference_to(form));
    return {{"anyOf", choices}};
  }

  Json of_value(const Key& key) {
    switch (key.holds) {
      case Holds::Number:
        return {{"type", "number"}};
      case Holds::Whole:
        return {{"type", "integer"}};
      case Holds::Flag:
        return {{"type", "boolean"}};
      case Holds::Text:
        return {{"type", "string"}};
      case Holds::Word:
        return {{"type", "string"}, {"enum", key.words}};
      case Holds::Numbers:
        break;
      case Holds::Table:
        return one_of(key.forms);
      case Holds::Tables:
        return {{"type", "array"}, {"items", one_of(key.forms)}};
    }
    Json numbers = {{"type", "array"}, {"items", {{"type", "number"}}}};
    if (key.count > 0) numbers["minItems"] = numbers["maxItems"] = key.count;
    return numbers;
  }

  Json of_key(const Key& key) {
    Json schema = of_value(key);
    schema["description"] = key.help;
    return schema;
  }

  Json all_ = Json::object();
};

}  // namespace

nlohmann::ordered_json cell_schema() {
  Definitions definitions;
  Json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "A measuring cell of asterism"},
      {"description", "Lengths in mm, times in s, angles in degrees; levels are shares of full scale."}};
  schema.update(definitions.of_form(forms::cell()));
  schema["$defs"] = definitions.all();
  return schema;
}

}  // namespace asterism
