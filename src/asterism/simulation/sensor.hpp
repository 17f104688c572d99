// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "asterism/camera/image.hpp"
#include "asterism/cell/cell.hpp"

namespace asterism {

/// Each pixel's gain relative to the mean: the same in every frame.
[[nodiscard]] Raster<float> fixed_pattern(const Sensor& sensor, const Lens& lens, Side side,
                                          std::uint64_t seed);

/// Light (share of full scale) to grey levels: electrons with the pixel's gain, shot noise and read noise
/// together as one normal draw (shot noise is nearly normal above some 20 electrons; var = e + read²),
/// offset, rounding, ceiling. Each row has a stream of its own.
[[nodiscard]] Image expose(const Raster<float>& light, const Raster<float>& gain, const Sensor& sensor,
                           Side side, std::uint64_t seed, int frame);

}  // namespace asterism
