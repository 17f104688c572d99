// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/bundle_terms.hpp"

namespace asterism {
namespace {

/// ∂(R p) by the error of R: R = exp(ω) R̂.
Mat3 by_rotation(const Vec3& rotated) { return -skew(rotated); }

/// The image centre in undistorted normalised coordinates, where the lens parameters act.
Vec2 normalised_centre(const Disc& disc) {
  const double r2 = disc.radius * disc.radius;
  const Vec3& c = disc.centre;
  const Vec3& n = disc.normal;
  return (c.head<2>() * c.z() + r2 * n.z() * n.head<2>()) / (c.z() * c.z() - r2 * (1 - n.z() * n.z()));
}

}  // namespace

std::optional<MarkImage> image_of_mark(const BoardMark& mark, Side side, const StereoRig& rig,
                                       const RigidMotion& tracker_from_board) {
  const bool right = side == Side::Right;
  const Lens& lens = rig.lens(side);
  const Quaternion& to_camera = rig.right_from_left.rotation;
  const Vec3 turned = tracker_from_board.rotation * mark.in_board;
  const Vec3 normal = tracker_from_board.rotation * Vec3::UnitZ();
  const Vec3 in_tracker = turned + tracker_from_board.translation;
  const Disc disc{right ? rig.right_from_left * in_tracker : in_tracker,
                  right ? Vec3(to_camera * normal) : normal, mark.radius_mm};
  const auto image = project_disc_centre(lens, disc);
  if (!image) return std::nullopt;

  MarkImage result;
  result.px = image->px;
  result.by_lens = pixel_by_parameters(lens, normalised_centre(disc));
  const Mat3 camera_by_tracker = right ? to_camera.toRotationMatrix() : Mat3::Identity();
  const Mat23 by_point = image->by_centre * camera_by_tracker;
  const Mat23 by_normal = image->by_normal * camera_by_tracker;
  result.by_board << by_point * by_rotation(turned) + by_normal * by_rotation(normal), by_point;
  result.by_scale = by_point * turned;
  result.by_rig.setZero();
  if (right) {
    const Vec3 rotated = to_camera * in_tracker;
    result.by_rig << image->by_centre * by_rotation(rotated) + image->by_normal * by_rotation(disc.normal),
        image->by_centre;
  }
  result.by_radius.setZero();
  if (mark.radius_mm > 0) {
    constexpr double kStep = 1e-3;  // mm; smooth in r², so a difference is exact to 1e-9
    Disc wider = disc, narrower = disc;
    wider.radius += kStep;
    narrower.radius -= kStep;
    const auto outer = project_disc_centre(lens, wider), inner = project_disc_centre(lens, narrower);
    if (outer && inner) result.by_radius = (outer->px - inner->px) / (2 * kStep);
  }
  return result;
}

}  // namespace asterism
