// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/cell/shape.hpp"

// Values as a cell file spells them.

namespace asterism {

[[nodiscard]] std::string toml_of(const Vec3& v);
[[nodiscard]] std::string toml_of(const std::string& text);  // in quotes
[[nodiscard]] std::string toml_of(const RigidMotion& pose);
/// The lines `shape = …` and the solid's sizes.
[[nodiscard]] std::string toml_of(const Shape& shape);

}  // namespace asterism
