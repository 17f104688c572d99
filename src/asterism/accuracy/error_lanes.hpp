// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/core/lanes.hpp"
#include "asterism/geometry/types.hpp"

// Information of a pose and the error at a point, for four poses at a time; inlined into clones.
//
// Errors are told along the body's axes at a reference point of the body: X = R (exp(ω) p + δ). A target at
// p with information M (3 × 3, of its place) gives, with P = [p]×,
//
//   I_δδ = M,   I_ωδ = P M,   I_ωω = P M Pᵀ

namespace asterism {

/// xx xy xz yy yz zz.
struct alignas(kLanesAlignment) SymmetricLanes {
  DoubleLanes xx, xy, xz, yy, yz, zz;
};

/// What one target, or several, say of the pose.
struct alignas(kLanesAlignment) InformationLanes {
  SymmetricLanes dd;     // I_δδ
  DoubleLanes wd[3][3];  // I_ωδ
  SymmetricLanes ww;     // I_ωω
};

ASTERISM_INLINE void add(SymmetricLanes& sum, const SymmetricLanes& other) {
  sum.xx += other.xx;
  sum.xy += other.xy;
  sum.xz += other.xz;
  sum.yy += other.yy;
  sum.yz += other.yz;
  sum.zz += other.zz;
}

ASTERISM_INLINE void add(InformationLanes& sum, const InformationLanes& other) {
  add(sum.dd, other.dd);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) sum.wd[a][b] += other.wd[a][b];
  }
  add(sum.ww, other.ww);
}

/// Of a target at p with the information m of its place.
ASTERISM_INLINE void lift(const SymmetricLanes& m, const Vec3& p, InformationLanes& out) {
  const double x = p.x(), y = p.y(), z = p.z();
  out.dd = m;
  const DoubleLanes rows[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  for (int b = 0; b < 3; ++b) {
    out.wd[0][b] = y * rows[2][b] - z * rows[1][b];
    out.wd[1][b] = z * rows[0][b] - x * rows[2][b];
    out.wd[2][b] = x * rows[1][b] - y * rows[0][b];
  }
  const auto& a = out.wd;
  out.ww = {y * a[0][2] - z * a[0][1], z * a[0][0] - x * a[0][2], x * a[0][1] - y * a[0][0],
            z * a[1][0] - x * a[1][2], x * a[1][1] - y * a[1][0], x * a[2][1] - y * a[2][0]};
}

/// M (I + Σ M)⁻¹: what is left of a place's information when the map itself is uncertain by Σ.
ASTERISM_INLINE SymmetricLanes less_of_map(const SymmetricLanes& m, const Mat3& map) {
  const DoubleLanes rows[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  DoubleLanes a[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      a[i][j] = map(i, 0) * rows[0][j] + map(i, 1) * rows[1][j] + map(i, 2) * rows[2][j];
    }
    a[i][i] += 1.0;
  }
  DoubleLanes cofactor[3][3];  // transposed: the adjugate
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactor[j][i] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
    }
  }
  const DoubleLanes scale =
      1.0 / (a[0][0] * cofactor[0][0] + a[0][1] * cofactor[1][0] + a[0][2] * cofactor[2][0]);
  const auto entry = [&](int i, int j) {
    return (rows[i][0] * cofactor[0][j] + rows[i][1] * cofactor[1][j] + rows[i][2] * cofactor[2][j]) * scale;
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

/// The inverse by cofactors, and which lanes have one: the determinant is not lost in rounding.
ASTERISM_INLINE SymmetricLanes inverse(const SymmetricLanes& m, MaskLanes& sound) {
  const DoubleLanes xx = m.yy * m.zz - m.yz * m.yz;
  const DoubleLanes xy = m.xz * m.yz - m.xy * m.zz;
  const DoubleLanes xz = m.xy * m.yz - m.xz * m.yy;
  const DoubleLanes yy = m.xx * m.zz - m.xz * m.xz;
  const DoubleLanes yz = m.xy * m.xz - m.xx * m.yz;
  const DoubleLanes zz = m.xx * m.yy - m.xy * m.xy;
  const DoubleLanes determinant = m.xx * xx + m.xy * xy + m.xz * xz;
  constexpr double kLost = 1e-11;
  sound &= (m.xx > 0.0) & (xx > 0.0) & (zz > 0.0) & (determinant > kLost * (m.xx * m.yy * m.zz));
  const DoubleLanes scale = 1.0 / determinant;
  return {xx * scale, xy * scale, xz * scale, yy * scale, yz * scale, zz * scale};
}

/// Square of the error √tr Σ at a point r of the body: constant + Q : (|r|² I − r rᵀ) + 2 r · linear.
struct alignas(kLanesAlignment) ErrorLanes {
  DoubleLanes constant;
  SymmetricLanes rotation;  // Q, covariance of the rotation
  DoubleLanes linear[3];
  MaskLanes determined;
};

/// With W = I_δδ⁻¹, B = I_ωδ W and Q = (I_ωω − B I_δω)⁻¹ the covariance is
///   Σ_ωω = Q,   Σ_ωδ = −Q B,   Σ_δδ = W + Bᵀ Q B.
ASTERISM_INLINE ErrorLanes error_of(const InformationLanes& info, double max_rotation_variance) {
  ErrorLanes error;
  error.determined = MaskLanes{} - 1;
  const SymmetricLanes w = inverse(info.dd, error.determined);
  DoubleLanes b[3][3];
  for (int i = 0; i < 3; ++i) {
    const auto& row = info.wd[i];
    b[i][0] = row[0] * w.xx + row[1] * w.xy + row[2] * w.xz;
    b[i][1] = row[0] * w.xy + row[1] * w.yy + row[2] * w.yz;
    b[i][2] = row[0] * w.xz + row[1] * w.yz + row[2] * w.zz;
  }
  const auto through = [&](int i, int j) {
    return b[i][0] * info.wd[j][0] + b[i][1] * info.wd[j][1] + b[i][2] * info.wd[j][2];
  };
  const SymmetricLanes schur = {info.ww.xx - through(0, 0), info.ww.xy - through(0, 1),
                                info.ww.xz - through(0, 2), info.ww.yy - through(1, 1),
                                info.ww.yz - through(1, 2), info.ww.zz - through(2, 2)};
  const SymmetricLanes q = inverse(schur, error.determined);
  error.rotation = q;
  error.determined &= q.xx + q.yy + q.zz <= max_rotation_variance;
  DoubleLanes f[3][3];  // Q B
  for (int j = 0; j < 3; ++j) {
    f[0][j] = q.xx * b[0][j] + q.xy * b[1][j] + q.xz * b[2][j];
    f[1][j] = q.xy * b[0][j] + q.yy * b[1][j] + q.yz * b[2][j];
    f[2][j] = q.xz * b[0][j] + q.yz * b[1][j] + q.zz * b[2][j];
  }
  error.constant = w.xx + w.yy + w.zz;
  for (int i = 0; i < 3; ++i) {
    error.constant += b[i][0] * f[i][0] + b[i][1] * f[i][1] + b[i][2] * f[i][2];
  }
  error.linear[0] = 2.0 * (f[1][2] - f[2][1]);
  error.linear[1] = 2.0 * (f[2][0] - f[0][2]);
  error.linear[2] = 2.0 * (f[0][1] - f[1][0]);
  return error;
}

/// A point with what it is multiplied by.
struct PointForLanes {
  explicit PointForLanes(const Vec3& r)
      : at{r.x(), r.y(), r.z()}, arm{r.y() * r.y() + r.z() * r.z(),
                                     -2 * r.x() * r.y(),
                                     -2 * r.x() * r.z(),
                                     r.x() * r.x() + r.z() * r.z(),
                                     -2 * r.y() * r.z(),
                                     r.x() * r.x() + r.y() * r.y()} {}
  double at[3], arm[6];
};

ASTERISM_INLINE DoubleLanes square_at(const ErrorLanes& error, const PointForLanes& point) {
  const SymmetricLanes& q = error.rotation;
  return error.constant + (q.xx * point.arm[0] + q.xy * point.arm[1] + q.xz * point.arm[2]) +
         (q.yy * point.arm[3] + q.yz * point.arm[4] + q.zz * point.arm[5]) +
         (error.linear[0] * point.at[0] + error.linear[1] * point.at[1] + error.linear[2] * point.at[2]);
}

}  // namespace asterism
