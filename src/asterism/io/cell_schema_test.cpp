// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_schema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/builtin_cells.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/toml_file.hpp"

namespace asterism {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_toml(std::string_view text) {
  std::ostringstream json;
  json << toml::json_formatter(toml::parse(text));
  return Json::parse(json.str());
}

/// A small validator of the words that cell_schema uses; what is wrong, or nothing.
class Validator {
 public:
  explicit Validator(Json schema) : schema_(std::move(schema)) {}
  [[nodiscard]] std::string fault(const Json& value) const { return fault(value, schema_, "cell"); }

 private:
  [[nodiscard]] std::string fault(const Json& value, const Json& schema, const std::string& at) const {
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"].get<std::string>().substr(std::string("#/$defs/").size());
      return fault(value, schema_.at("$defs").at(name), at);
    }
    if (schema.contains("anyOf")) {
      std::string all;
      for (const Json& one : schema["anyOf"]) {
        const std::string what = fault(value, one, at);
        if (what.empty()) return "";
        all += what + "; ";
      }
      return all;
    }
    const std::string type = schema.at("type");
    const bool right = type == "number"    ? value.is_number()
                       : type == "integer" ? value.is_number_integer()
                       : type == "boolean" ? value.is_boolean()
                       : type == "string"  ? value.is_string()
                       : type == "array"   ? value.is_array()
                                           : value.is_object();
    if (!right) return at + " is no " + type;
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
      return at + " is none of its words";
    }
    if (schema.contains("minimum") && value < schema["minimum"]) return at + " is too small";
    if (schema.contains("maximum") && value > schema["maximum"]) return at + " is too large";
    if (schema.contains("minItems") && value.size() < schema["minItems"]) return at + " is too short";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return at + " is too long";
    return value.is_structured() ? fault_inside(value, schema, at) : "";
  }

  [[nodiscard]] std::string fault_inside(const Json& value, const Json& schema, const std::string& at) const {
    if (value.is_array()) {
      for (const Json& one : value) {
        if (const std::string what = fault(one, schema.at("items"), at + "[]"); !what.empty()) return what;
      }
      return "";
    }
    for (const Json& key : schema.value("required", Json::array())) {
      if (!value.contains(key.get<std::string>())) return at + " lacks " + key.get<std::string>();
    }
    for (const auto& [key, inner] : value.items()) {
      if (!schema.at("properties").contains(key)) return at + " has no " + key;
      const std::string what = fault(inner, schema["properties"][key], at + "." + key);
      if (!what.empty()) return what;
    }
    return "";
  }

  Json schema_;
};

TEST(CellSchema, TakesEveryBuiltInCell) {
  const Validator validator(cell_schema());
  for (const BuiltinCell& cell : builtin_cell_texts()) {
    EXPECT_EQ(validator.fault(json_of_toml(cell.toml)), "") << cell.name;
  }
}

TEST(CellSchema, TakesWhatIsWritten) {
  const Validator validator(cell_schema());
  const TestFolder folder;
  for (const std::string name : {"engine_casing", "paper_cell"}) {
    write_cell(folder / "cell.toml", cell_of(name));
    EXPECT_EQ(validator.fault(json_of_toml(folder.read("cell.toml"))), "") << name;
  }
}

TEST(CellSchema, RefusesWhatTheReaderRefuses) {
  const Validator validator(cell_schema());
  Json cell = json_of_toml(builtin_cell_texts()[0].toml);
  cell["workpiece"]["casing"]["wall"] = 12;
  EXPECT_TELLS(validator.fault(cell), "cell.workpiece.casing has no wall");
  cell = json_of_toml(builtin_cell_texts()[0].toml);
  cell["platform"]["stroke"]["yaw_deg"] = 1000;
  EXPECT_EQ(validator.fault(cell), "cell.platform.stroke.yaw_deg is too large");
  cell = json_of_toml(builtin_cell_texts()[0].toml);
  cell["body"][0]["motion"]["kind"] = "sweeps";
  EXPECT_TELLS(validator.fault(cell), "cell.body[].motion.kind is none of its words");
  cell.erase("tracker");
  EXPECT_EQ(validator.fault(cell), "cell lacks tracker");
}

TEST(CellSchema, TellsDefaultsLimitsAndHelp) {
  const Json schema = cell_schema();
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  const Json& yaw = schema.at("$defs").at("platform.stroke").at("properties").at("yaw_deg");
  EXPECT_EQ(yaw.at("default"), 15);
  EXPECT_EQ(yaw.at("maximum"), 180);
  EXPECT_EQ(yaw.at("description"), "to either side of rest, about z");
  const Json& kind = schema.at("$defs").at("fault").at("properties").at("kind");
  EXPECT_EQ(kind.at("enum"), Json({"falls-off", "knocked"}));
}

/// Every property of every table tells what it is, so that the schema can stand for a manual.
void expect_help(const Json& schema, const std::string& at) {
  if (!schema.contains("properties")) return;
  for (const auto& [key, inner] : schema["properties"].items()) {
    EXPECT_FALSE(inner.value("description", "").empty()) << at << "." << key;
  }
}

TEST(CellSchema, ExplainsEachKey) {
  const Json schema = cell_schema();
  expect_help(schema, "cell");
  for (const auto& [name, definition] : schema.at("$defs").items()) expect_help(definition, name);
}

}  // namespace
}  // namespace asterism
