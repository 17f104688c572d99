// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "asterism/core/options.hpp"
#include "asterism/measurement/frame.hpp"
#include "asterism/simulation/stage.hpp"

namespace asterism {

enum class SimulationLevel { Images, Centres };

struct SimulationOptions {
  SimulationLevel level = SimulationLevel::Images;
  std::uint64_t seed = 1;
  // At the level of centres:
  double sigma_px = 0.02;  // of each centre, along each axis
  double dropout = 0;      // share of visible targets each camera misses at random; the cell's own
                           // noise.target_loss takes targets from both cameras at once
  double clutter = 0;      // mean number of false centres an image
};
void describe(SimulationOptions& options, OptionVisitor& visit);

/// What one camera has of one target at the middle of the exposure.
struct TargetTruth {
  int body = 0, target = 0;
  Side side = Side::Left;
  Vec2 centre_px = Vec2::Zero();  // image of the disc's centre
  Ellipse image;                  // px; of the disc: its centre is what a detector should find
  double incidence_rad = 0;
  double brightness = 0;          // relative to a target seen square on
  bool in_image = false;          // the whole disc
  double visible = 0;             // share of it not hidden and inside the image; 0 when it has fallen off
  double blur_px = 0;             // way of its centre during the exposure
  Vec3 in_camera = Vec3::Zero();  // mm; where it truly is, knocked or not
};

struct FrameTruth {
  std::vector<RigidMotion> tracker_from_body;  // one a body, at the middle of the exposure
  std::vector<TargetTruth> targets;            // left camera's first; those behind a camera are left out
};

/// One frame with its truth; `image` or `centres` is filled, by the level.
struct SimulatedFrame {
  int frame = 0;
  double time_s = 0;
  FrameTruth truth;
  StereoImage image;
  StereoCentres centres;
};

/// Makes the frames of a cell in motion. A frame depends on the cell, the seed and its number alone, so
/// frames may be made in any order and on any number of threads.
class Simulator {
 public:
  /// Throws InputError when the cell is not sound (stage_of) or, for images, a target has no diameter.
  Simulator(Cell cell, const SimulationOptions& options);
  [[nodiscard]] SimulatedFrame frame(int number) const;
  [[nodiscard]] const Cell& cell() const { return stage_.cell; }

 private:
  [[nodiscard]] bool loses(int number, Side side) const;
  [[nodiscard]] Image picture(int number, Side side) const;

  Stage stage_;
  SimulationOptions options_;
  Raster<float> left_gain_, right_gain_;  // fixed patterns; empty at the level of centres
};

}  // namespace asterism
