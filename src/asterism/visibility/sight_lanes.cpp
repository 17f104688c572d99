// SPDX-License-Identifier: Apache-2.0
#include "asterism/visibility/sight_lanes.hpp"

#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {

SightConditions::SightConditions(std::span<const Target> targets, const StereoRig& rig,
                                 const std::optional<WorkingVolume>& volume, const VisibilityOptions& options)
    : count_(targets.size()),
      lenses_{LensForLanes(rig.left), LensForLanes(rig.right)},
      volume_(volume),
      margin_px_(options.margin_px),
      guard_px_(options.guard_px) {
  require(targets.size() <= kMaxTargets, "a body has at most 64 targets");
  for (std::size_t i = 0; i < count_; ++i) {
    const Target& target = targets[i];
    const Vec3 normal = target.normal.value_or(Vec3::Zero());
    Disc& disc = discs_[i];
    for (int axis = 0; axis < 3; ++axis) {
      disc.position[axis] = target.position(axis);
      disc.normal[axis] = normal(axis);
    }
    disc.radius = 0.5 * target.diameter_mm.value_or(0.0);
    disc.has_normal = target.normal.has_value();
    disc.has_size = target.diameter_mm.has_value();
  }
  const RigidMotion middle_from_tracker = tracker_from_middle(rig).inverse();
  middle_from_tracker_ = middle_from_tracker.rotation.toRotationMatrix();
  tracker_in_middle_ = middle_from_tracker.translation;
  const double cosine = std::cos(rad_from_deg(options.max_incidence_deg));
  min_cosine_square_ = cosine * cosine;
  min_minor_square_ = 0.25 * options.min_diameter_px * options.min_diameter_px;
}

struct SightKernel {
  using Lanes = DoubleLanes;

  ASTERISM_INLINE static MaskLanes outside_volume(const SightConditions& c, const Lanes& x, const Lanes& y,
                                                  const Lanes& z) {
    const WorkingVolume& volume = *c.volume_;
    const Mat3& r = c.middle_from_tracker_;
    const Vec3& t = c.tracker_in_middle_;
    const Lanes mx = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + t.x();
    const Lanes my = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + t.y();
    const Lanes mz = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + t.z();
    const Lanes share = (mz - volume.near_mm) * (1.0 / (volume.far_mm - volume.near_mm));
    const Lanes half_width =
        0.5 * volume.near_width_mm + (0.5 * (volume.far_width_mm - volume.near_width_mm)) * share;
    const Lanes half_height =
        0.5 * volume.near_height_mm + (0.5 * (volume.far_height_mm - volume.near_height_mm)) * share;
    return (share < 0.0) | (share > 1.0) | (mx * mx > half_width * half_width) |
           (my * my > half_height * half_height);
  }

  /// All conditions but those between two targets. `outside` says which poses put it outside the volume.
  ASTERISM_INLINE static void look_alone(const SightConditions& c, const SightConditions::Disc& disc,
                                         const LensForLanes& lens, const MotionLanes& m, bool is_left,
                                         MaskLanes& outside, SightLanes& sight) {
    const double* p = disc.position;
    const auto& r = m.rotation;
    const Lanes x = r[0][0] * p[0] + r[0][1] * p[1] + r[0][2] * p[2] + m.translation[0];
    const Lanes y = r[1][0] * p[0] + r[1][1] * p[1] + r[1][2] * p[2] + m.translation[1];
    const Lanes z = r[2][0] * p[0] + r[2][1] * p[1] + r[2][2] * p[2] + m.translation[2];
    if (is_left) outside = c.volume_ ? outside_volume(c, x, y, z) : MaskLanes{};
    const MaskLanes behind = z <= 0.0;
    const Lanes inverse_z = 1.0 / (behind ? Lanes{} + 1.0 : z);
    const Lanes xn = x * inverse_z, yn = y * inverse_z;
    const PixelLanes px = pixels_of(lens, xn, yn);
    const Lanes radius_square = xn * xn + yn * yn;

    sight.cosine_square = Lanes{} + 1.0;
    if (disc.has_normal) {
      const double* n = disc.normal;
      const Lanes towards = -((r[0][0] * n[0] + r[0][1] * n[1] + r[0][2] * n[2]) * xn +
                              (r[1][0] * n[0] + r[1][1] * n[1] + r[1][2] * n[2]) * yn +
                              (r[2][0] * n[0] + r[2][1] * n[1] + r[2][2] * n[2]));
      const Lanes square = towards * towards / (1.0 + radius_square);
      sight.cosine_square = towards > 0.0 ? square : -square;
    }
    const double focal = std::sqrt(lens.lens.fx * lens.lens.fy);
    const Lanes size = focal * disc.radius * inverse_z;
    sight.u = px.u;
    sight.v = px.v;
    sight.major = size * (1.0 + 0.5 * radius_square);
    sight.minor_square = size * size * sight.cosine_square;
    sight.shines = ~behind & (sight.cosine_square > 0.0);

    const Lanes border = sight.major + c.margin_px_;
    const MaskLanes off_image = (px.u < border) | (px.u > (lens.lens.width_px - 1.0) - border) |
                                (px.v < border) | (px.v > (lens.lens.height_px - 1.0) - border) |
                                (px.unfolded <= 0.0);
    const auto code = [](SightFailure failure) {
      return MaskLanes{} + (1 + static_cast<std::int64_t>(failure));
    };
    MaskLanes failure{};
    if (disc.has_size) {
      failure = sight.minor_square < c.min_minor_square_ ? code(SightFailure::TooSmall) : failure;
    }
    failure = off_image ? code(SightFailure::OutsideImage) : failure;
    failure = sight.cosine_square < c.min_cosine_square_ ? code(SightFailure::TooOblique) : failure;
    failure = outside ? code(SightFailure::OutsideVolume) : failure;
    sight.failure = behind ? code(SightFailure::BehindCamera) : failure;
  }

  ASTERISM_INLINE static void keep_apart(const SightConditions& c, std::array<SightLanes, kMaxTargets>& all) {
    const MaskLanes too_close = MaskLanes{} + (1 + static_cast<std::int64_t>(SightFailure::TooClose));
    for (std::size_t i = 1; i < c.count_; ++i) {
      SightLanes& a = all[i];
      for (std::size_t j = 0; j < i; ++j) {
        SightLanes& b = all[j];
        const Lanes du = a.u - b.u, dv = a.v - b.v;
        const Lanes reach = a.major + b.major + c.guard_px_;
        const MaskLanes meet = (du * du + dv * dv < reach * reach) & a.shines & b.shines;
        a.failure = meet & (a.failure == 0) ? too_close : a.failure;
        b.failure = meet & (b.failure == 0) ? too_close : b.failure;
      }
    }
  }

  ASTERISM_CLONES static void look(const SightConditions& c, const MotionLanes& left,
                                   const MotionLanes& right, SightConditions::Sights& sights) {
    for (std::size_t i = 0; i < c.count_; ++i) {
      MaskLanes outside{};
      look_alone(c, c.discs_[i], c.lenses_[0], left, true, outside, sights[0][i]);
      look_alone(c, c.discs_[i], c.lenses_[1], right, false, outside, sights[1][i]);
    }
    keep_apart(c, sights[0]);
    keep_apart(c, sights[1]);
  }
};

void SightConditions::look(const MotionLanes& left, const MotionLanes& right, Sights& sights) const {
  SightKernel::look(*this, left, right, sights);
}

}  // namespace asterism
