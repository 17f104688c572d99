// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "asterism/cell/shape.hpp"
#include "asterism/core/options.hpp"

namespace asterism {

/// Where targets may stand, in the frame of the body that carries them; mm. Angles run from +x towards +y.

/// The side of an upright cylinder (axis along z); targets face outwards.
struct CylinderSide {
  Vec3 base_mm = Vec3::Zero();  // centre of the lower rim
  double radius_mm = 1;
  double height_mm = 1;
  double from_rad = 0;
  double to_rad = 2 * std::numbers::pi;
};

/// A level ring, or a disc when the inner radius is 0; targets face up (+z).
struct Annulus {
  Vec3 centre_mm = Vec3::Zero();
  double inner_radius_mm = 0;
  double outer_radius_mm = 1;
  double from_rad = 0;
  double to_rad = 2 * std::numbers::pi;
};

/// A flat rectangle in any place, centred on its frame's origin; targets face along its +z.
struct Plate {
  RigidMotion body_from_plate;
  double width_mm = 1;   // along its x
  double height_mm = 1;  // along its y
};

/// Anywhere inside an upright cylinder: feet of various heights, as the paper's layouts stand (Table 1:
/// radius 350, z 580 to 620). Targets face up, tilted outwards from the axis by `tilt_rad`.
struct CylinderRoom {
  Vec3 base_mm = Vec3::Zero();  // centre of the lower end
  double radius_mm = 1;
  double height_mm = 1;
  double tilt_rad = 0;
};

using Patch = std::variant<CylinderSide, Annulus, Plate, CylinderRoom>;

struct NamedPatch {
  std::string name;
  Patch patch;
};

/// Where nothing may stand: lifting eyes, clamps, the part itself.
struct KeepOut {
  std::string name;
  Shape shape;
  RigidMotion body_from_shape;
};

struct DeployableSurface {
  std::vector<NamedPatch> patches;
  std::vector<KeepOut> keep_outs;
};

/// A place where accuracy counts: a point of the part, in the frame of the body that carries the targets.
struct WorkPoint {
  std::string name;
  Vec3 in_body_mm;
};

/// What is asked of a layout of targets.
struct LayoutTask {
  std::string body;  // whose targets are to be placed
  DeployableSurface surface;
  std::vector<WorkPoint> points;  // none: the centroid of the targets
  int fewest = 4;                 // targets
  int most = 12;
  double spacing_mm = 100;         // d_min of the paper's Eq. 28, between the centres of two targets
  double diameter_mm = 12;         // of each target
  int poses = 200;                 // the motion is looked at this often, evenly in time
  int losses = 1;                  // any so many targets may be lost and the task must still be done
  double loss_probability = 0.05;  // of each target, independently (the paper's Section 3.3)
  double identifiability_mm = 1;   // smallest RMS at which a wrong labelling may fit
};
void describe(LayoutTask& task, OptionVisitor& visit);

/// Throws InputError for: no patch, a patch or keep-out without extent, a name given twice, more than one
/// turn of angle, fewer than four targets, `most` below `fewest`, points that are not finite.
void check_layout_task(const LayoutTask& task, const std::string& where);

}  // namespace asterism
