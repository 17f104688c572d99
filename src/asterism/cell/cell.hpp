// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/cell/disturbance.hpp"
#include "asterism/cell/layout_task.hpp"
#include "asterism/cell/motion.hpp"
#include "asterism/cell/platform.hpp"
#include "asterism/cell/robot.hpp"
#include "asterism/cell/scan_task.hpp"
#include "asterism/cell/scanner.hpp"
#include "asterism/cell/shape.hpp"
#include "asterism/cell/solid.hpp"
#include "asterism/cell/verification.hpp"
#include "asterism/cell/working_volume.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// What the two cameras' sensors do to light. Levels are shares of full scale, 0 to 1.
struct Sensor {
  int bits = 8;                // 8 or 16
  double full_well_e = 10500;  // electrons at full scale
  double read_noise_e = 7;
  double gain_spread = 0.004;   // fixed-pattern gain, 1σ; the same in every frame
  double offset_level = 0.016;  // added by the electronics, without shot noise
  double blur_px = 0.55;        // σ of the Gaussian point spread, in focus
  double focus_mm = 0;          // depth at which the lens is sharp; 0 = sharp everywhere
  double aperture_mm = 8;       // diameter of the lens's opening: what is out of focus blurs by it
  double exposure_s = 0.001;
  double lost_frames = 0;  // share of frames each camera loses
};
void describe(Sensor& sensor, OptionVisitor& visit);

/// What is bright and what is dark. Bright targets send light back to the lamp beside each camera:
/// brightness = target_level · exp(−(incidence / retro_falloff)⁴).
struct Light {
  double target_level = 0.75;     // of a target seen square on
  double retro_falloff_deg = 52;  // 0 = painted targets, equally bright from all sides
  double background_level = 0.03;
  double gradient_x = 0;  // background's change from the left to the right edge, share of itself
  double gradient_y = 0;
  double vignetting = 0;  // share of the light lost in the image's corners
  double glints = 0;      // mean number of false bright specks and streaks an image
  double specular = 0;    // brightness of the part where its surface mirrors the cameras' lamps back to them
};
void describe(Light& light, OptionVisitor& visit);

/// When pictures are taken.
struct Timing {
  int frames = 100;
  double rate_hz = 20;
};
void describe(Timing& timing, OptionVisitor& visit);

/// Something that carries targets, and how it moves.
struct Mover {
  Body body;
  Motion motion;
};

/// A measuring cell. Its root frame is `tracker`, the left camera.
struct Cell {
  std::string name;
  StereoRig rig;
  std::vector<Mover> movers;
  std::vector<Obstacle> obstacles;
  std::optional<Platform> platform;
  std::optional<Solid> workpiece;  // carried by the platform
  std::vector<Solid> fixtures;     // clamps, the platform's own body, the scanner's housing
  std::optional<Scanner> scanner;
  std::optional<Robot> robot;    // carries the scanner; none: a hand does, which reaches everywhere
  ScanTask scan_task;            // what a plan of views is asked for
  std::vector<ScanPass> passes;  // when the scanner measures
  Sensor sensor;
  Light light;
  Timing timing;
  std::optional<WorkingVolume> volume;  // where the tracker is good; none: wherever both cameras see
  std::optional<LayoutTask> layout;     // what is asked of the targets of one body
  NoiseModel noise;
  std::vector<TargetFault> faults;
  std::vector<Lamp> lamps;
  Verification verification;
};

/// Throws InputError for: a bad rig or body (check_rig, check_bodies), key times that do not increase, a
/// sweep that jumps, whatever names a body or target that is not there, an obstacle without extent, a solid
/// without surface, too small or too large to be one (5 mm to 50 m) or with a target inside it, a platform
/// that is moved beyond its stroke or rates, options outside their limits, a working volume or layout task
/// that is none.
void check_cell(const Cell& cell, const std::string& where);

[[nodiscard]] std::vector<Body> bodies_of(const Cell& cell);

/// What is allowed but worth a look, in words: surfaces of solids that are open, not manifold, or made of
/// triangles that face different ways. They hide targets all the same.
[[nodiscard]] std::vector<std::string> remarks_on(const Cell& cell);

/// Two like cameras side by side, turned in so that their axes meet `range_mm` ahead of their middle.
struct CameraPair {
  int width_px = 2048, height_px = 1536;
  double focal_px = 3200;
  double baseline_mm = 1000;
  double range_mm = 2300;
};
void describe(CameraPair& pair, OptionVisitor& visit);
[[nodiscard]] StereoRig rig_of(const CameraPair& pair);

/// Where a frame is when the middle of the two cameras looks at its point `at_mm` from `range_mm` away,
/// `elevation` above the frame's xy plane and `azimuth` from its x towards its y axis, the image's down
/// being the frame's −z as nearly as can be.
struct SeenFrom {
  Vec3 at_mm = Vec3::Zero();
  double range_mm = 2000;
  double elevation_rad = 0;
  double azimuth_rad = 0;
};
[[nodiscard]] RigidMotion tracker_from_frame(const SeenFrom& seen, const StereoRig& rig);

}  // namespace asterism
