// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "asterism/camera/image.hpp"
#include "asterism/simulation/scene.hpp"

namespace asterism {

/// Draws the surfaces over what `light` holds, the nearest before the others, lit by the lamp at the camera,
/// blurred by the lens and by what moves during the exposure. `scenes` are its instants, of which at most
/// twelve are drawn. Looks only: what surfaces hide of a disc is cut out of it by rays.
void draw_surfaces(Raster<float>& light, std::span<const Scene> scenes, const Lens& lens, const Cell& cell);

}  // namespace asterism
