// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/core/random.hpp"

namespace asterism {

/// What a stream of random numbers is drawn for; streams of different purposes are independent.
enum class Purpose : std::uint32_t {
  Centres = 0x51,
  LostFrames,
  Glints,
  FixedPattern,
  PixelNoise,
  ReadOut,
  TargetLoss,
  ScannerPlace,
  ScanLine
};

/// The stream of one frame, camera and image row (0 where rows do not matter).
[[nodiscard]] inline RandomStream stream_of(std::uint64_t seed, int frame, Side side, Purpose purpose,
                                            int row = 0) {
  const auto camera = static_cast<std::uint64_t>(frame) * 2 + static_cast<std::uint64_t>(side);
  return {seed, camera << 20 | static_cast<std::uint64_t>(row), static_cast<std::uint32_t>(purpose)};
}

}  // namespace asterism
