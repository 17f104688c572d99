// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "asterism/cell/shape.hpp"
#include "asterism/io/cell_forms.hpp"
#include "asterism/io/cell_section.hpp"

// What several tables of a cell file are made of. For .cpp files only.

namespace asterism {

/// A pose by position and angles or quaternion; what is absent is zero.
[[nodiscard]] RigidMotion plain_pose(const CellSection& section);
/// The same from a table whose keys were looked at before.
[[nodiscard]] RigidMotion pose_of_numbers(const CellSection& section);

/// A solid by its `shape`; `with` has the other keys of its table.
[[nodiscard]] Shape shape_of(const CellSection& section, const Form& with);

template <class Options>
std::function<void(OptionVisitor&)> describing_options(Options& options) {
  return [&options](OptionVisitor& visit) { describe(options, visit); };
}

}  // namespace asterism
