// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/camera/lens.hpp"
#include "asterism/core/lanes.hpp"

// The lens model for four points at a time, the same as `project` of camera/lens.hpp (a test holds them
// together). For functions compiled with ASTERISM_CLONES: all is inlined.

namespace asterism {

/// A lens with what all its points share.
struct LensForLanes {
  explicit LensForLanes(const Lens& of) : lens(of), tilt(sensor_tilt(of)) {}
  Lens lens;
  Mat3 tilt;
};

struct alignas(kLanesAlignment) PixelLanes {
  DoubleLanes u, v;      // px
  DoubleLanes ux, uy;    // ∂u / ∂ undistorted x, y
  DoubleLanes vx, vy;    // ∂v / ∂ undistorted x, y
  DoubleLanes unfolded;  // the Jacobian's determinant: positive where the distortion does not fold back
};

namespace lens_lanes {

struct Distorted {
  DoubleLanes x, y, xx, xy, yx, yy;
};

ASTERISM_INLINE Distorted distort_lanes(const LensForLanes& of, const DoubleLanes& x, const DoubleLanes& y) {
  const auto& d = of.lens.distortion;
  const double k1 = d[0], k2 = d[1], p1 = d[2], p2 = d[3], k3 = d[4], k4 = d[5], k5 = d[6], k6 = d[7];
  const double s1 = d[8], s2 = d[9], s3 = d[10], s4 = d[11];
  const DoubleLanes r2 = x * x + y * y;
  const DoubleLanes inverse = 1.0 / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  const DoubleLanes radial = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) * inverse;
  const DoubleLanes radial_by_r2 =
      (k1 + r2 * (2 * k2 + 3 * k3 * r2) - radial * (k4 + r2 * (2 * k5 + 3 * k6 * r2))) * inverse;
  const DoubleLanes prism_x = s1 + 2 * s2 * r2, prism_y = s3 + 2 * s4 * r2;
  const DoubleLanes mixed = 2.0 * x * y * radial_by_r2;
  Distorted out;
  out.x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2.0 * x * x) + r2 * (s1 + r2 * s2);
  out.y = y * radial + p1 * (r2 + 2.0 * y * y) + 2 * p2 * x * y + r2 * (s3 + r2 * s4);
  out.xx = radial + 2.0 * x * x * radial_by_r2 + 2 * p1 * y + 6 * p2 * x + 2.0 * x * prism_x;
  out.xy = mixed + 2 * p1 * x + 2 * p2 * y + 2.0 * y * prism_x;
  out.yx = mixed + 2 * p1 * x + 2 * p2 * y + 2.0 * x * prism_y;
  out.yy = radial + 2.0 * y * y * radial_by_r2 + 6 * p1 * y + 2 * p2 * x + 2.0 * y * prism_y;
  if (of.lens.coefficients < 14) return out;

  const Mat3& h = of.tilt;
  const DoubleLanes w = 1.0 / (h(2, 0) * out.x + h(2, 1) * out.y + h(2, 2));
  const DoubleLanes tx = (h(0, 0) * out.x + h(0, 1) * out.y + h(0, 2)) * w;
  const DoubleLanes ty = (h(1, 0) * out.x + h(1, 1) * out.y + h(1, 2)) * w;
  const DoubleLanes a = (h(0, 0) - tx * h(2, 0)) * w, b = (h(0, 1) - tx * h(2, 1)) * w;
  const DoubleLanes c = (h(1, 0) - ty * h(2, 0)) * w, e = (h(1, 1) - ty * h(2, 1)) * w;
  return {tx,
          ty,
          a * out.xx + b * out.yx,
          a * out.xy + b * out.yy,
          c * out.xx + e * out.yx,
          c * out.xy + e * out.yy};
}

}  // namespace lens_lanes

/// Undistorted normalised coordinates to pixels.
ASTERISM_INLINE PixelLanes pixels_of(const LensForLanes& of, const DoubleLanes& x, const DoubleLanes& y) {
  const Lens& lens = of.lens;
  if (lens.coefficients == 0) {
    const DoubleLanes zero{};
    return {lens.fx * x + lens.skew * y + lens.cx,
            lens.fy * y + lens.cy,
            zero + lens.fx,
            zero + lens.skew,
            zero,
            zero + lens.fy,
            zero + 1.0};
  }
  const lens_lanes::Distorted d = lens_lanes::distort_lanes(of, x, y);
  return {lens.fx * d.x + lens.skew * d.y + lens.cx,
          lens.fy * d.y + lens.cy,
          lens.fx * d.xx + lens.skew * d.yx,
          lens.fx * d.xy + lens.skew * d.yy,
          lens.fy * d.yx,
          lens.fy * d.yy,
          d.xx * d.yy - d.xy * d.yx};
}

}  // namespace asterism
