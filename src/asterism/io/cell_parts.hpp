// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "asterism/cell/shape.hpp"
#include "asterism/io/cell_keys.hpp"
#include "asterism/io/cell_section.hpp"

// What several tables of a cell file are made of. For .cpp files only.

namespace asterism {

/// The keys of two lists.
[[nodiscard]] cell_keys::Keys both(cell_keys::Keys first, const cell_keys::Keys& second);

/// A pose by position and angles or quaternion; what is absent is zero. Does not ask for unknown keys.
[[nodiscard]] RigidMotion plain_pose(const CellSection& section);

/// A solid by its `shape`; other keys than its own and those `beside` are refused.
[[nodiscard]] Shape shape_of(const CellSection& section, const cell_keys::Keys& beside);

template <class Options>
std::function<void(OptionVisitor&)> describing_options(Options& options) {
  return [&options](OptionVisitor& visit) { describe(options, visit); };
}

}  // namespace asterism
