// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/cell.hpp"

#include <cmath>

namespace asterism {
void describe(Sensor& sensor, OptionVisitor& visit) {
  visit.integer("bits", sensor.bits, {8, 16}, "grey depth of the images: 8 or 16");
  visit.number("full_well_e", sensor.full_well_e, {1, 1e9}, "electrons at full scale; sets the shot noise");
  visit.number("read_noise_e", sensor.read_noise_e, {0, 1e6}, "read noise, electrons, 1 sigma");
  visit.number("gain_spread", sensor.gain_spread, {0, 0.5},
               "fixed-pattern gain from pixel to pixel, 1 sigma");
  visit.number("offset_level", sensor.offset_level, {0, 0.9},
               "offset of the electronics, share of full scale");
  visit.number("blur_px", sensor.blur_px, {0, 20}, "sigma of the lens's Gaussian blur, in focus");
  visit.number("focus_mm", sensor.focus_mm, {0, 1e6},
               "depth at which the lens is sharp; 0 = sharp everywhere");
  visit.number("aperture_mm", sensor.aperture_mm, {0, 1000},
               "diameter of the lens's opening, by which what is out of focus blurs");
  visit.number("exposure_s", sensor.exposure_s, {0, 10}, "time over which a picture gathers light");
  visit.number("lost_frames", sensor.lost_frames, {0, 1}, "share of frames that each camera loses");
}

void describe(Light& light, OptionVisitor& visit) {
  visit.number("target_level", light.target_level, {0, 2},
               "brightness of a target seen square on, share of full scale");
  visit.number("retro_falloff_deg", light.retro_falloff_deg, {0, 90},
               "incidence at which a retro-reflective target has lost 63 %; 0 = painted, equally bright from "
               "all sides");
  visit.number("background_level", light.background_level, {0, 2},
               "brightness of the background, share of full scale");
  visit.number("gradient_x", light.gradient_x, {-2, 2},
               "background's change from left to right, share of itself");
  visit.number("gradient_y", light.gradient_y, {-2, 2},
               "background's change from top to bottom, share of itself");
  visit.number("vignetting", light.vignetting, {0, 1}, "share of the light lost in the image's corners");
  visit.number("glints", light.glints, {0, 1000}, "mean number of false bright specks and streaks an image");
  visit.number("specular", light.specular, {0, 10},
               "brightness of the part where it mirrors the cameras' lamps back, share of full scale");
}

void describe(Timing& timing, OptionVisitor& visit) {
  visit.integer("frames", timing.frames, {1, 1000000}, "how many pairs of images");
  visit.number("rate_hz", timing.rate_hz, {1e-3, 1e5}, "pairs a second");
}

void describe(CameraPair& pair, OptionVisitor& visit) {
  visit.integer("width_px", pair.width_px, {16, 65536}, "image width");
  visit.integer("height_px", pair.height_px, {16, 65536}, "image height");
  visit.number("focal_px", pair.focal_px, {1, 1e6}, "focal length over pixel pitch");
  visit.number("baseline_mm", pair.baseline_mm, {1, 1e5}, "distance between the cameras");
  visit.number("range_mm", pair.range_mm, {1, 1e6},
               "where the two axes meet, from the middle of the cameras");
}

std::vector<Body> bodies_of(const Cell& cell) {
  std::vector<Body> bodies;
  for (const Mover& mover : cell.movers) bodies.push_back(mover.body);
  return bodies;
}

StereoRig rig_of(const CameraPair& pair) {
  StereoRig rig;
  rig.left.fx = rig.left.fy = pair.focal_px;
  rig.left.cx = 0.5 * (pair.width_px - 1);
  rig.left.cy = 0.5 * (pair.height_px - 1);
  rig.left.width_px = pair.width_px;
  rig.left.height_px = pair.height_px;
  rig.right = rig.left;
  const double half = std::atan(0.5 * pair.baseline_mm / pair.range_mm);
  const RigidMotion left_from_middle = {exp_rotation({0, -half, 0}),
                                        exp_rotation({0, -half, 0}) * Vec3(0.5 * pair.baseline_mm, 0, 0)};
  const RigidMotion right_from_middle = {exp_rotation({0, half, 0}),
                                         exp_rotation({0, half, 0}) * Vec3(-0.5 * pair.baseline_mm, 0, 0)};
  rig.right_from_left = right_from_middle * left_from_middle.inverse();
  return rig;
}

RigidMotion tracker_from_frame(const SeenFrom& seen, const StereoRig& rig) {
  const double ce = std::cos(seen.elevation_rad), se = std::sin(seen.elevation_rad);
  const double ca = std::cos(seen.azimuth_rad), sa = std::sin(seen.azimuth_rad);
  const Vec3 towards_camera(ce * ca, ce * sa, se);
  Mat3 frame_axes;  // the middle camera's axes in the frame
  frame_axes.col(2) = -towards_camera;
  frame_axes.col(0) = Vec3(-sa, ca, 0);
  frame_axes.col(1) = frame_axes.col(2).cross(frame_axes.col(0));
  const RigidMotion frame_from_middle = {quaternion_from_matrix(frame_axes),
                                         seen.at_mm + seen.range_mm * towards_camera};
  return tracker_from_middle(rig) * frame_from_middle.inverse();
}

}  // namespace asterism
