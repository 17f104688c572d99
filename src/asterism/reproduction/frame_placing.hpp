// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// Figure 11: the measurement frames O_c, O_p, O_g, O_s, O_1 (Eqs. 19–22), placed by the cell of
/// chain_cell.hpp, since the paper gives none of the transforms.
[[nodiscard]] Exhibit frame_placing();

/// By how much the chain's two ways from scanner to tracker differ over the motion, mm at 500 mm from the
/// scanner: over the workpiece, and straight. A closed chain has none but rounding.
[[nodiscard]] double chain_misclosure_mm();

}  // namespace asterism
