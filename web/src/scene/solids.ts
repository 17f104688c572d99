// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Patch, Solid } from '../data/layout';
import type { Vec3 } from '../data/parts';
import { apply, motionOf } from '../data/pose';
import { kDegPerRad } from '../data/quaternion';

/// A piece of a surface as rows of points; neighbours form its faces.
export type Sheet = Vec3[][];

const kTurn = 2 * Math.PI;
const kSteps = 64;  // of a full turn

function between(from: number, to: number, steps: number): number[] {
  return Array.from({ length: steps + 1 }, (_, i) => from + ((to - from) * i) / steps);
}

function ringOf([x, y, z]: Vec3, radius: number, from: number, to: number, dz = 0): Vec3[] {
  const steps = Math.max(2, Math.ceil((kSteps * Math.abs(to - from)) / kTurn));
  return between(from, to, steps).map((angle) => [x + radius * Math.cos(angle), y + radius * Math.sin(angle), z + dz]);
}

/// The sheets of a patch, in its body's frame.
export function sheetsOfPatch(patch: Patch): Sheet[] {
  switch (patch.kind) {
    case 'side': {
      const [from, to] = [patch.from_deg / kDegPerRad, patch.to_deg / kDegPerRad];
      return [[ringOf(patch.base_mm, patch.radius_mm, from, to), ringOf(patch.base_mm, patch.radius_mm, from, to, patch.height_mm)]];
    }
    case 'ring': {
      const [from, to] = [patch.from_deg / kDegPerRad, patch.to_deg / kDegPerRad];
      return [[ringOf(patch.centre_mm, patch.inner_radius_mm, from, to), ringOf(patch.centre_mm, patch.outer_radius_mm, from, to)]];
    }
    case 'plate': {
      const [w, h] = [patch.width_mm / 2, patch.height_mm / 2];
      const motion = motionOf(patch.pose);
      return [[-h, h].map((y) => [-w, w].map((x) => apply(motion, [x, y, 0])))];
    }
    case 'room': {
      const lower = ringOf(patch.base_mm, patch.radius_mm, 0, kTurn);
      const upper = ringOf(patch.base_mm, patch.radius_mm, 0, kTurn, patch.height_mm);
      return [[lower, upper], [ringOf(patch.base_mm, 0, 0, kTurn, patch.height_mm), upper]];
    }
  }
}

/// The sheets of a solid, in its carrier's frame.
export function sheetsOfSolid(solid: Solid): Sheet[] {
  const motion = motionOf(solid.pose);
  return ownSheets(solid).map((sheet) => sheet.map((row) => row.map((point) => apply(motion, point))));
}

function ownSheets(solid: Solid): Sheet[] {
  switch (solid.shape) {
    case 'box': {
      const [x, y, z] = solid.size_mm.map((size) => size / 2);
      const around: Vec3[] = [[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0], [-x, -y, 0]];
      const lid = (at: number): Sheet => [[[-x, -y, at], [x, -y, at]], [[-x, y, at], [x, y, at]]];
      return [[-z, z].map((at) => around.map(([a, b]): Vec3 => [a, b, at])), lid(-z), lid(z)];
    }
    case 'frustum': {
      const { bottom_radius_mm: bottom, top_radius_mm: top, height_mm: height } = solid;
      return [[0, bottom, 0], [bottom, top, height], [top, 0, 0]].map(([a, b, rise], i): Sheet => {
        const at: Vec3 = [0, 0, i === 2 ? height : 0];
        return [ringOf(at, a, 0, kTurn), ringOf(at, b, 0, kTurn, rise)];
      });
    }
    case 'capsule': return [capsule(solid.from_mm, solid.to_mm, solid.radius_mm)];
  }
}

/// Rings along the axis, closed by half a ball at each end.
function capsule(from: Vec3, to: Vec3, radius: number): Sheet {
  const axis = new THREE.Vector3(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  const length = axis.length();
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), length > 0 ? axis.normalize() : new THREE.Vector3(0, 0, 1));
  const profile = [...between(-Math.PI / 2, 0, 6).map((a) => [Math.cos(a), Math.sin(a) * radius]), ...between(0, Math.PI / 2, 6).map((a) => [Math.cos(a), Math.sin(a) * radius + length])];
  return profile.map(([share, along]) => ringOf([0, 0, along], radius * share, 0, kTurn).map((point): Vec3 => {
    const turned = new THREE.Vector3(...point).applyQuaternion(turn);
    return [turned.x + from[0], turned.y + from[1], turned.z + from[2]];
  }));
}

export function meshOf(sheets: Sheet[], material: THREE.Material): THREE.Mesh {
  const points: number[] = [];
  const faces: number[] = [];
  for (const sheet of sheets) {
    const first = points.length / 3;
    const width = sheet[0].length;
    points.push(...sheet.flat(2));
    for (let r = 0; r + 1 < sheet.length; ++r) {
      for (let c = 0; c + 1 < width; ++c) {
        const a = first + r * width + c;
        faces.push(a, a + 1, a + width + 1, a, a + width + 1, a + width);
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  geometry.setIndex(faces);
  geometry.computeVertexNormals();
  return new THREE.Mesh(geometry, material);
}

/// The borders of the sheets as pieces of line: first and last row, first and last column. Where a sheet
/// closes on itself its two ends fall together, and that seam is left out.
export function bordersOf(sheets: Sheet[]): Vec3[] {
  const pieces = (row: Vec3[]) => row.slice(1).flatMap((point, i): Vec3[] => [row[i], point]);
  return sheets.flatMap((sheet) => {
    const last = sheet[0].length - 1;
    const closed = sheet.every((row) => Math.hypot(...row[0].map((v, k) => v - row[last][k])) < 1e-6);
    const ends = closed ? [] : [0, last].map((c) => sheet.map((row) => row[c]));
    return [sheet[0], sheet[sheet.length - 1], ...ends].flatMap(pieces);
  });
}
