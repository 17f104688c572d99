// SPDX-License-Identifier: Apache-2.0
import type { CellReport, CellSolid } from './cell_report';
import { countsOf, floatsOf } from './packed';
import type { Vec3 } from './parts';

/// A surface as numbers, with the box that holds it.
export interface Mesh {
  positions: Float32Array;  // x y z, mm, in its carrier's frame
  corners: Uint32Array;     // three a triangle
  low: Vec3;
  high: Vec3;
}

export function meshOfSolid(solid: Pick<CellSolid, 'vertices' | 'triangles'>): Mesh {
  const positions = floatsOf(solid.vertices);
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3], value);
    high[i % 3] = Math.max(high[i % 3], value);
  });
  return { positions, corners: countsOf(solid.triangles), low, high };
}

export function boxCorners({ low, high }: Pick<Mesh, 'low' | 'high'>): Vec3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((c): Vec3 => [0, 1, 2].map((k) => ((c >> k) & 1 ? high : low)[k]) as Vec3);
}

/// The least and the largest error on all surfaces that have a map; null where none has.
export function mapRange(solids: Pick<CellReport, 'solids'>['solids']): [number, number] | null {
  let range: [number, number] | null = null;
  for (const { error_mm } of solids) {
    for (const value of error_mm) {
      if (value === null) continue;
      range = range ? [Math.min(range[0], value), Math.max(range[1], value)] : [value, value];
    }
  }
  return range;
}
