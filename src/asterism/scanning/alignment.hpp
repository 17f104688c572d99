// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/geometry/surface_tree.hpp"
#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// Where the part sits on the platform. Without it no scan is in the workpiece's frame.
struct Alignment {
  std::string method;  // "points", "3-2-1", "best fit"
  RigidMotion platform_from_workpiece;
  Mat6 covariance = Mat6::Zero();  // ω (rad), δ (mm) at the workpiece's origin, along the platform's axes
  std::size_t points = 0;
  double rms_mm = 0;                        // of the residuals: between points, or along the normals
  double chi2 = 0, degrees = 0;             // of the residuals against their covariance
  std::vector<double> residuals_mm;         // one a point
  std::vector<std::string> not_determined;  // motions that the points leave free, in words
};

/// A point of the part that was touched, as told in the platform's frame.
struct ProbedPoint {
  std::string name;  // of the nominal point or feature it belongs to; may be empty for a best fit
  Vec3 in_platform = Vec3::Zero();                   // mm
  Mat3 covariance = 0.02 * 0.02 * Mat3::Identity();  // mm²
};

/// A named place of the part's drawing.
struct NominalPoint {
  std::string name;
  Vec3 in_workpiece = Vec3::Zero();  // mm
};

/// By points that correspond by name: the motion of least χ². Three at least that do not lie on a line.
/// Throws InputError for a name that is not there, a place that is probed twice, too few points.
[[nodiscard]] Alignment align_points(std::span<const ProbedPoint> probed,
                                     std::span<const NominalPoint> nominal);

/// A plane of the part's drawing: normal outwards, through a point.
struct NominalPlane {
  Vec3 at = Vec3::Zero(), normal = Vec3::UnitZ();
};
/// Datum planes of a 3-2-1: the first takes three points or more, the second two, the third one.
struct DatumPlanes {
  NominalPlane primary, secondary, tertiary;
};
/// 3-2-1: the part such that the first plane fits its points, the second, kept square to it, its own, and the
/// third its own. Each point's name tells its plane: "primary", "secondary", "tertiary". `ball_mm` is the
/// radius of the probe's ball, whose centre was told. Throws InputError for too few points, for points on a
/// line in the first, and for planes that leave a motion free.
[[nodiscard]] Alignment align_3_2_1(std::span<const ProbedPoint> probed, const DatumPlanes& planes,
                                    double ball_mm = 0);

struct BestFitOptions {
  double ball_mm = 0;      // radius of the probe's ball: its centre lies so far outside the surface
  double within_mm = 200;  // how far off the surface the first guess may be
  int most_steps = 100;
  double free_mm = 0.5;  // a motion known worse than this, at the part's rim, is called not determined
};
/// Best fit of probed points to the surface, from each start in turn; the best one counts. Motions that
/// the shape leaves free are named in `not_determined`, and their variance is infinite in words only: the
/// covariance holds only what is determined, and along the rest the part stays where the start had it.
/// Throws MeasurementError when two starts fit alike and differ: the part fits in two ways.
[[nodiscard]] Alignment align_best_fit(std::span<const ProbedPoint> probed, const SurfaceTree& surface,
                                       std::span<const RigidMotion> starts, const BestFitOptions& options);

}  // namespace asterism
