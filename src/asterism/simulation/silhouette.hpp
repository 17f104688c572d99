// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/image.hpp"
#include "asterism/simulation/scene.hpp"

namespace asterism {

/// The outline of a solid in the image: the hull of its rim in the undistorted plane, through the lens.
/// Empty when part of it is behind the camera.
[[nodiscard]] Outline outline_of_solid(const Lens& lens, const SceneSolid& solid);

/// Paints the solids that have a level of their own, the farthest first, their edges blurred by the lens.
/// Looks only: what they hide is cut out of each disc by rays. A solid that reaches behind the camera is
/// left out of the picture.
void paint_silhouettes(Raster<float>& light, const Scene& scene, const Lens& lens, double blur_px);

}  // namespace asterism
