// SPDX-License-Identifier: Apache-2.0
import type { Vec3 } from './parts';

/// w x y z, unit.
export type Quaternion = [number, number, number, number];

export function conjugate([w, x, y, z]: Quaternion): Quaternion {
  return [w, -x, -y, -z];
}

export function product(a: Quaternion, b: Quaternion): Quaternion {
  const [aw, ax, ay, az] = a;
  const [bw, bx, by, bz] = b;
  return [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];
}

export function rotate([w, x, y, z]: Quaternion, [a, b, c]: Vec3): Vec3 {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/// Axis times angle, rad; the angle in [0, π].
export function rotationVector([w, x, y, z]: Quaternion): Vec3 {
  const sign = w < 0 ? -1 : 1;
  const sine = Math.hypot(x, y, z);
  const scale = sine < 1e-12 ? 2 * sign : (2 * Math.atan2(sine, sign * w) * sign) / sine;
  return [scale * x, scale * y, scale * z];
}

export const kDegPerRad = 180 / Math.PI;
