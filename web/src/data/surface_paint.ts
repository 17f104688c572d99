// SPDX-License-Identifier: Apache-2.0
import type { Mesh } from './mesh';
import type { Samples } from './scan';

/// A surface cut so finely that each piece belongs to one sample.
export interface PaintedSurface {
  positions: Float32Array;  // nine a piece
  sample: Int32Array;       // by piece; −1 = none is near
}

const kMostPieces = 120_000;
const kFine = 0.6;   // of the samples' spacing: the longest side of a piece
const kTurned = 0.3; // cosine: a sample on the other side of a thin wall is no neighbour

/// Each piece takes the nearest sample that faces the same way: the samples' Voronoi cells on the surface.
export function paintedSurface(mesh: Mesh, samples: Samples): PaintedSurface {
  const spacing = Math.sqrt(samples.areas.reduce((sum, area) => sum + area, 0) / Math.max(1, samples.count));
  let positions = cut(mesh, kFine * spacing);
  for (let side = kFine * spacing; positions === null; ) positions = cut(mesh, (side *= 1.35));
  const near = sampleGrid(samples, 1.5 * spacing);
  const sample = new Int32Array(positions.length / 9);
  for (let t = 0; t < sample.length; ++t) sample[t] = near(positions, 9 * t);
  return { positions, sample };
}

/// Halves each triangle across its longest side until that is short enough; null when that makes too many.
function cut({ positions, corners }: Mesh, longest: number): Float32Array | null {
  const pieces: number[] = [];
  const most = Math.max(kMostPieces, corners.length / 3);
  const open: number[][] = [];
  for (let t = 0; t < corners.length; t += 3) {
    open.push([0, 1, 2].flatMap((c) => [0, 1, 2].map((k) => positions[3 * corners[t + c] + k])));
    while (open.length > 0) {
      const own = open.pop()!;
      const sides = [0, 3, 6].map((a) => Math.hypot(own[a] - own[(a + 3) % 9], own[a + 1] - own[((a + 3) % 9) + 1], own[a + 2] - own[((a + 3) % 9) + 2]));
      const length = Math.max(...sides);
      if (!(length > longest)) {
        pieces.push(...own);
        continue;
      }
      const a = 3 * sides.indexOf(length);
      const [b, c] = [(a + 3) % 9, (a + 6) % 9];
      const [p, q, r] = [a, b, c].map((i) => own.slice(i, i + 3));
      const middle = p.map((value, k) => (value + q[k]) / 2);
      open.push([...p, ...middle, ...r], [...middle, ...q, ...r]);
    }
    if (pieces.length > 9 * most) return null;
  }
  return new Float32Array(pieces);
}

/// Looks samples up by cubes of the grid about a piece's middle.
function sampleGrid({ count, places, normals }: Samples, cell: number): (positions: Float32Array, at: number) => number {
  const side = (k: number, pick: (a: number, b: number) => number, start: number) => places.reduce((found, value, i) => (i % 3 === k ? pick(found, value) : found), start);
  const low = [0, 1, 2].map((k) => side(k, Math.min, Infinity) - cell);
  const [nx, ny, nz] = [0, 1, 2].map((k) => Math.ceil((side(k, Math.max, -Infinity) + cell - low[k]) / cell) + 1);
  const step = (value: number, k: number) => Math.floor((value - low[k]) / cell);
  const key = (x: number, y: number, z: number) => (x * ny + y) * nz + z;
  const cubes = new Map<number, number[]>();
  for (let i = 0; i < count; ++i) {
    const name = key(step(places[3 * i], 0), step(places[3 * i + 1], 1), step(places[3 * i + 2], 2));
    const own = cubes.get(name);
    if (own) own.push(i);
    else cubes.set(name, [i]);
  }
  return (p, at) => {
    const [mx, my, mz] = [0, 1, 2].map((k) => (p[at + k] + p[at + 3 + k] + p[at + 6 + k]) / 3);
    const [ux, uy, uz, vx, vy, vz] = [3, 4, 5, 6, 7, 8].map((i) => p[at + i] - p[at + (i % 3)]);
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const least_turn = kTurned * 127 * Math.hypot(x, y, z);
    const [cx, cy, cz] = [step(mx, 0), step(my, 1), step(mz, 2)];
    let [best, least] = [-1, Infinity];
    for (let a = Math.max(0, cx - 1); a <= Math.min(nx - 1, cx + 1); ++a) for (let b = Math.max(0, cy - 1); b <= Math.min(ny - 1, cy + 1); ++b) for (let c = Math.max(0, cz - 1); c <= Math.min(nz - 1, cz + 1); ++c) {
      for (const i of cubes.get(key(a, b, c)) ?? []) {
        const off = (places[3 * i] - mx) ** 2 + (places[3 * i + 1] - my) ** 2 + (places[3 * i + 2] - mz) ** 2;
        if (off < least && normals[3 * i] * x + normals[3 * i + 1] * y + normals[3 * i + 2] * z >= least_turn) [best, least] = [i, off];
      }
    }
    return best;
  };
}
