// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_schema.hpp"

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {

void add_schema(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "schema", "The JSON schema of a cell file, for editors and forms",
                  "asterism schema > cell.schema.json");
  on_call(*command, common, [&common] {
    const nlohmann::ordered_json schema = cell_schema();
    print_result(common, schema, schema.dump(2) + "\n");
  });
}

}  // namespace asterism::app
