// SPDX-License-Identifier: Apache-2.0
import { conjugate, rotate, type Quaternion } from './quaternion';
import type { MotionRow, Vec3 } from './parts';
import type { PoseRow } from './report';

/// xx xy xz yy yz zz.
export type Covariance = [number, number, number, number, number, number];

export interface Motion {
  translation: Vec3;  // mm
  rotation: Quaternion;
}

export function motionOf(row: MotionRow | PoseRow): Motion {
  return { translation: [row[0], row[1], row[2]], rotation: [row[3], row[4], row[5], row[6]] };
}

export function pointCovariance(row: PoseRow): Covariance {
  return row.slice(7, 13) as Covariance;
}

export function rotationCovariance(row: PoseRow): Covariance {
  return row.slice(13, 19) as Covariance;
}

export function apply(motion: Motion, point: Vec3): Vec3 {
  return add(rotate(motion.rotation, point), motion.translation);
}

export function inverse(motion: Motion): Motion {
  const rotation = conjugate(motion.rotation);
  const [x, y, z] = rotate(rotation, motion.translation);
  return { rotation, translation: [-x, -y, -z] };
}

export function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/// One standard deviation along x, y, z.
export function sigmas(c: Covariance): Vec3 {
  return [Math.sqrt(Math.max(0, c[0])), Math.sqrt(Math.max(0, c[3])), Math.sqrt(Math.max(0, c[5]))];
}

/// Lower Cholesky factor by rows: l00, l10, l11, l20, l21, l22. It carries the unit sphere onto the
/// one-sigma ellipsoid. Rounding may leave a pivot a little below zero: that axis then has no length.
export function cholesky([xx, xy, xz, yy, yz, zz]: Covariance): [number, number, number, number, number, number] {
  const root = (value: number) => Math.sqrt(Math.max(0, value));
  const over = (value: number, pivot: number) => (pivot > 0 ? value / pivot : 0);
  const l00 = root(xx);
  const l10 = over(xy, l00);
  const l20 = over(xz, l00);
  const l11 = root(yy - l10 * l10);
  const l21 = over(yz - l20 * l10, l11);
  return [l00, l10, l11, l20, l21, root(zz - l20 * l20 - l21 * l21)];
}
