// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/measurement/reading.hpp"

namespace asterism {

/// Where the frame is in which a cell's platform tells its pose: a sweep's place of rest, the first key of a
/// keyed motion. Throws InputError when the cell has no platform.
[[nodiscard]] RigidMotion tracker_from_base(const Cell& cell);

/// What the platform says of itself while a cell's frames are taken, by its ReadOut: readings stamped from 0
/// until the last frame is told of, each of where the platform was one latency earlier, with normal noise
/// about each axis and at the pivot, and now and then a jump of the pivot in any direction. Noise with a
/// correlation time τ is a first-order Gauss–Markov process: e(t + dt) = ρ e(t) + √(1 − ρ²) w, ρ =
/// exp(−dt/τ).
///
/// The covariance stated is that of all errors, the jumps' second moment included; `correlated` is the
/// noise's when it has a correlation time. Throws InputError when the cell has no platform.
[[nodiscard]] std::vector<PlatformReading> simulate_read_out(const Cell& cell, std::uint64_t seed);

/// One reading without error: rest_from_body at a moment, and the covariances such a reading has.
[[nodiscard]] PlatformReading true_reading(const Cell& cell, double time_s);

}  // namespace asterism
