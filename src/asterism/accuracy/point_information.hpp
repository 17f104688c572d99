// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "asterism/accuracy/accuracy_options.hpp"
#include "asterism/accuracy/error_lanes.hpp"
#include "asterism/camera/lens_lanes.hpp"
#include "asterism/cell/body.hpp"
#include "asterism/visibility/seen_motion.hpp"

namespace asterism {

/// A centre's variance in an image: a constant, and a share by size and incidence, which is tabulated.
class CentreVariance {
 public:
  explicit CentreVariance(const AccuracyOptions& options);
  [[nodiscard]] double constant_px2() const { return constant_; }
  [[nodiscard]] bool by_size() const { return !of_cosine_.empty(); }
  /// Variance times the shorter semi-axis, of the share by size.
  [[nodiscard]] double times_px(double cosine) const;

 private:
  double constant_;
  std::vector<double> of_cosine_;  // evenly from 0 to 1
};

/// One target as the kernels want it.
struct TargetForLanes {
  Vec3 position, normal;
  double radius = 0;        // 0: not known, so its variance is the constant
  std::optional<Mat3> map;  // covariance of its position, along the body's axes
};
[[nodiscard]] TargetForLanes target_for_lanes(const Target& target, const AccuracyOptions& options);

/// In four poses: which lanes of each camera see it.
using SeenLanes = std::array<MaskLanes, 2>;

/// Information of a target's place along the body's axes: Σ over the cameras that see it of Gᵀ G / σ², with
/// G = ∂px/∂X · R; then, where its place in the body is uncertain, (M⁻¹ + Σ)⁻¹ = M (I + Σ M)⁻¹.
/// Inlined into clones.
ASTERISM_INLINE SymmetricLanes point_information(const TargetForLanes& target,
                                                 const std::array<const MotionLanes*, 2>& cameras,
                                                 const std::array<LensForLanes, 2>& lenses,
                                                 const SeenLanes& seen, const CentreVariance& variance) {
  SymmetricLanes m{};
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& r = cameras[side]->rotation;
    const auto& t = cameras[side]->translation;
    const Vec3& p = target.position;
    const DoubleLanes x = r[0][0] * p.x() + r[0][1] * p.y() + r[0][2] * p.z() + t[0];
    const DoubleLanes y = r[1][0] * p.x() + r[1][1] * p.y() + r[1][2] * p.z() + t[1];
    const DoubleLanes z = r[2][0] * p.x() + r[2][1] * p.y() + r[2][2] * p.z() + t[2];
    const MaskLanes counts = seen[side] & (z > 0.0);
    const DoubleLanes inverse_z = 1.0 / (counts ? z : DoubleLanes{} + 1.0);
    const DoubleLanes xn = x * inverse_z, yn = y * inverse_z;
    const PixelLanes px = pixels_of(lenses[side], xn, yn);

    DoubleLanes weight = DoubleLanes{} + 1.0 / variance.constant_px2();
    if (variance.by_size() && target.radius > 0) {
      const Vec3& n = target.normal;
      const double focal = std::sqrt(lenses[side].lens.fx * lenses[side].lens.fy);
      const DoubleLanes towards = -((r[0][0] * n.x() + r[0][1] * n.y() + r[0][2] * n.z()) * xn +
                                    (r[1][0] * n.x() + r[1][1] * n.y() + r[1][2] * n.z()) * yn +
                                    (r[2][0] * n.x() + r[2][1] * n.y() + r[2][2] * n.z()));
      for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) {
        const double ray = std::sqrt(1.0 + xn[lane] * xn[lane] + yn[lane] * yn[lane]);
        const double cosine = n.squaredNorm() > 0 ? towards[lane] / ray : 1.0;
        // Seen edge on there is no image to speak of.
        const double minor = focal * target.radius * inverse_z[lane] * std::max(cosine, 1e-3);
        weight[lane] = 1.0 / (variance.constant_px2() + variance.times_px(cosine) / minor);
      }
    }
    weight = counts ? weight * inverse_z * inverse_z : DoubleLanes{};

    const DoubleLanes by_pixel[2][2] = {{px.ux, px.uy}, {px.vx, px.vy}};
    for (const auto& row : by_pixel) {
      const DoubleLanes along = -(row[0] * xn + row[1] * yn);
      const DoubleLanes gx = row[0] * r[0][0] + row[1] * r[1][0] + along * r[2][0];
      const DoubleLanes gy = row[0] * r[0][1] + row[1] * r[1][1] + along * r[2][1];
      const DoubleLanes gz = row[0] * r[0][2] + row[1] * r[1][2] + along * r[2][2];
      const DoubleLanes wx = weight * gx, wy = weight * gy, wz = weight * gz;
      add(m, {wx * gx, wx * gy, wx * gz, wy * gy, wy * gz, wz * gz});
    }
  }
  return target.map ? less_of_map(m, *target.map) : m;
}

}  // namespace asterism
