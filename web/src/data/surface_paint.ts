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
      const most_ = Math.max(...sides);
      if (!(most_ > longest)) {
        pieces.push(...own);
        continue;
      }
      const a = 3 * sides.indexOf(most_);
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
  const cubes = new Map<string, number[]>();
  const key = (x: number, y: number, z: number) => `${x},${y},${z}`;
  const step = (value: number) => Math.floor(value / cell);
  for (let i = 0; i < count; ++i) {
    const name = key(step(places[3 * i]), step(places[3 * i + 1]), step(places[3 * i + 2]));
    const own = cubes.get(name);
    if (own) own.push(i);
    else cubes.set(name, [i]);
  }
  return (p, at) => {
    const middle = [0, 1, 2].map((k) => (p[at + k] + p[at + 3 + k] + p[at + 6 + k]) / 3);
    const [u, v] = [3, 6].map((other) => [0, 1, 2].map((k) => p[at + other + k] - p[at + k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const size = 127 * Math.hypot(...normal) || 1;
    const [x, y, z] = middle.map(step);
    let [best, least] = [-1, Infinity];
    for (let dx = -1; dx <= 1; ++dx) for (let dy = -1; dy <= 1; ++dy) for (let dz = -1; dz <= 1; ++dz) {
      for (const i of cubes.get(key(x + dx, y + dy, z + dz)) ?? []) {
        const off = (places[3 * i] - middle[0]) ** 2 + (places[3 * i + 1] - middle[1]) ** 2 + (places[3 * i + 2] - middle[2]) ** 2;
        if (off >= least || normals[3 * i] * normal[0] + normals[3 * i + 1] * normal[1] + normals[3 * i + 2] * normal[2] < kTurned * size) continue;
        [best, least] = [i, off];
      }
    }
    return best;
  };
}
