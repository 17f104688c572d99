// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace asterism {

/// The JSON schema (draft 2020-12) of a cell file, made from the very forms that read_cell holds a file to:
/// every key with its help, type, words, limits and default. What a schema cannot say (that a named body
/// is there, that a part is no larger than a house) check_cell does.
[[nodiscard]] nlohmann::ordered_json cell_schema();

}  // namespace asterism
