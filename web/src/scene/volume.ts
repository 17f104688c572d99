// SPDX-License-Identifier: Apache-2.0
import type { Volume } from '../data/layout';
import type { Vec3 } from '../data/parts';
import { apply, motionOf } from '../data/pose';

/// The twelve edges of the working volume as pieces of line, in the tracker.
export function volumeEdges(volume: Volume): Vec3[] {
  const motion = motionOf(volume.pose);
  const ring = (z: number, [w, h]: [number, number]): Vec3[] => ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as const)
    .map(([x, y]) => apply(motion, [(x * w) / 2, (y * h) / 2, z]));
  const near = ring(volume.near_mm, volume.near_size_mm);
  const far = ring(volume.far_mm, volume.far_size_mm);
  const round = (c: Vec3[]): Vec3[] => c.flatMap((p, i): Vec3[] => [p, c[(i + 1) % 4]]);
  return [...round(near), ...round(far), ...near.flatMap((p, i): Vec3[] => [p, far[i]])];
}
