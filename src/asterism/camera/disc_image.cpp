// SPDX-License-Identifier: Apache-2.0
#include "asterism/camera/disc_image.hpp"

#include <cmath>

namespace asterism {
namespace {

/// How far distortion moves the centre of a small ellipse with shape matrix S (normalised coordinates)
/// beyond the image of its centre: (H_jk S_jk + 2 S_ik H^j_jk) / 8 with H the second derivatives of the
/// distortion. The same for the centroid of the blob and for a fit to its edge.
/// `at` is the distortion at xy.
Vec2 shift_by_distortion(const Lens& lens, const Vec2& xy, const DistortionResult& at, const Mat2& shape) {
  if (lens.coefficients == 0) return Vec2::Zero();
  constexpr double kStep = 1e-5;  // the shift is some 0.01 px: one-sided differences give it to 1e-6 px
  const Mat2 by_x = (distort(lens, xy + Vec2(kStep, 0)).by_xy - at.by_xy) / kStep;
  const Mat2 by_y = (distort(lens, xy + Vec2(0, kStep)).by_xy - at.by_xy) / kStep;
  const Mat2 undo = at.by_xy.inverse();
  // The ellipse lives in the distorted image, so H is read back through the local linear map.
  const Vec2 curvature = by_x * shape.col(0) + by_y * shape.col(1);
  const Vec2 divergence((undo * by_x).trace(), (undo * by_y).trace());
  return (curvature + 2.0 * at.by_xy * shape * divergence) / 8.0;
}

Mat3 dual_conic(const Disc& disc) {
  return disc.centre * disc.centre.transpose() -
         disc.radius * disc.radius * (Mat3::Identity() - disc.normal * disc.normal.transpose());
}

Result<Ellipse, LensFailure> through_lens(const Lens& lens, const Mat3& dual) {
  const auto undistorted = ellipse_from_dual_conic(dual);
  if (!undistorted) return because(LensFailure::BehindCamera);
  const DistortionResult at = distort(lens, undistorted->centre);
  const Mat2 map = pixel_by_normalised(lens) * at.by_xy;
  const Mat2 shape = shape_matrix(*undistorted);
  const Vec2 centre = at.xy + shift_by_distortion(lens, undistorted->centre, at, shape);
  return ellipse_from_shape(pixel_from_normalised(lens, centre), map * shape * map.transpose());
}

}  // namespace

Result<DiscCentre, LensFailure> project_disc_centre(const Lens& lens, const Disc& disc) {
  const Vec3& c = disc.centre;
  const Vec3& n = disc.normal;
  const double r2 = disc.radius * disc.radius;
  const double weight = c.z() * c.z() - r2 * (1.0 - n.z() * n.z());
  if (!(c.z() > 0) || !(weight > 0)) return because(LensFailure::BehindCamera);
  const double inverse = 1.0 / weight;
  const Vec2 xy = (c.head<2>() * c.z() + r2 * n.z() * n.head<2>()) * inverse;

  Mat23 xy_by_centre;
  xy_by_centre << c.z() * inverse, 0, (c.x() - 2 * c.z() * xy.x()) * inverse,  //
      0, c.z() * inverse, (c.y() - 2 * c.z() * xy.y()) * inverse;
  Mat23 xy_by_normal;
  xy_by_normal << n.z(), 0, n.x() - 2 * n.z() * xy.x(),  //
      0, n.z(), n.y() - 2 * n.z() * xy.y();
  xy_by_normal *= r2 * inverse;

  const DistortionResult at = distort(lens, xy);
  Vec2 centre = at.xy;
  if (lens.coefficients > 0 && r2 > 0) {
    const Mat3 dual = dual_conic(disc) * inverse;
    const Mat2 shape = xy * xy.transpose() - dual.topLeftCorner<2, 2>();
    centre += shift_by_distortion(lens, xy, at, shape);
  }
  const Mat2 map = pixel_by_normalised(lens) * at.by_xy;
  return DiscCentre{pixel_from_normalised(lens, centre), map * xy_by_centre, map * xy_by_normal};
}

Result<Ellipse, LensFailure> image_of_disc(const Lens& lens, const Disc& disc) {
  if (!(disc.centre.z() > disc.radius)) return because(LensFailure::BehindCamera);
  return through_lens(lens, dual_conic(disc));
}

Result<Ellipse, LensFailure> image_of_sphere(const Lens& lens, const Vec3& centre, double radius) {
  if (!(centre.z() > radius)) return because(LensFailure::BehindCamera);
  return through_lens(lens, centre * centre.transpose() - radius * radius * Mat3::Identity());
}

}  // namespace asterism
