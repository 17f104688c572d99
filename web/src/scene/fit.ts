// SPDX-License-Identifier: Apache-2.0
import type { Vec3 } from '../data/parts';

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a: Vec3): Vec3 {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
}

/// The nearest place from which all points are seen, looking against `direction` with `above` up, for a view that
/// opens by the tangents `wide` and `high` to each side. Along one axis of the view the place c must keep
/// x − t z ≤ c_x − t c_z and c_x + t c_z ≤ x + t z for every point: the extremes of both sides meet at the
/// nearest depth. Turning is about the points' middle depth.
export function standingPoint(points: Vec3[], direction: Vec3, wide: number, high: number, above: Vec3 = [0, -1, 0]): { target: Vec3; position: Vec3 } {
  const forward = unit([-direction[0], -direction[1], -direction[2]]);
  const right = unit(cross(forward, above));
  const up = cross(right, forward);
  const side = (axis: Vec3, tangent: number) => {
    let least = Infinity;
    let most = -Infinity;
    for (const point of points) {
      const [x, z] = [dot(point, axis), dot(point, forward)];
      most = Math.max(most, x - tangent * z);
      least = Math.min(least, x + tangent * z);
    }
    return { centre: (most + least) / 2, depth: (least - most) / (2 * tangent) };
  };
  const across = side(right, wide);
  const along = side(up, high);
  const depth = Math.min(across.depth, along.depth);
  const depths = points.map((point) => dot(point, forward));
  const middle = Math.max(depth + 1, (Math.min(...depths) + Math.max(...depths)) / 2);
  const at = (z: number): Vec3 => [0, 1, 2].map((k) => right[k] * across.centre + up[k] * along.centre + forward[k] * z) as Vec3;
  return { target: at(middle), position: at(depth) };
}
