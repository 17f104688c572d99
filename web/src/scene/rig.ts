// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { apply, inverse, motionOf } from '../data/pose';
import type { Lens, Rig, Vec3 } from '../data/parts';
import { segments, type Inks } from './ink';
import type { Label } from './labels';
import type { RoomScales } from './scales';

/// Both cameras as pyramids, what they see (without distortion), the tracker's axes and the grid.
export function rigView(rig: Rig, scales: RoomScales, inks: Inks): { group: THREE.Group; fields: THREE.Object3D; labels: Label[] } {
  const group = new THREE.Group();
  const fields = new THREE.Group();
  const labels: Label[] = [];
  const near = 0.1 * scales.radius;
  const edge = inks.line('--ink', 1.4);
  const faint = inks.line('--muted', 1, 0.35);
  const glass = inks.flat('--muted', 0.16);
  const cameras: [string, Lens, (p: Vec3) => Vec3][] = [
    ['left', rig.left, (p) => p],
    ['right', rig.right, (p) => apply(inverse(motionOf(rig.right_from_left)), p)],
  ];
  for (const [name, lens, toTracker] of cameras) {
    const eye = toTracker([0, 0, 0]);
    const mouth = corners(lens, near).map(toTracker);
    const end = corners(lens, scales.far).map(toTracker);
    const ring = (c: Vec3[]): Vec3[] => [c[0], c[1], c[1], c[2], c[2], c[3], c[3], c[0]];
    group.add(segments([...mouth.flatMap((c): Vec3[] => [eye, c]), ...ring(mouth)], edge), pane(mouth, glass));
    fields.add(segments([...end.flatMap((c, i): Vec3[] => [mouth[i], c]), ...ring(end)], faint));
    labels.push({ text: `${name} camera`, at: eye, colour: '--ink', below: true });
  }
  group.add(fields, triad(near * 0.9, inks, labels), grid(scales, inks));
  return { group, fields, labels };
}

/// Corners of the image at a depth, in the camera's frame.
export function corners(lens: Lens, depth: number): Vec3[] {
  return [[0, 0], [lens.width_px, 0], [lens.width_px, lens.height_px], [0, lens.height_px]].map(([u, v]): Vec3 => {
    const y = (v - 0.5 - lens.cy) / lens.fy;
    return [((u - 0.5 - lens.cx - lens.skew * y) / lens.fx) * depth, y * depth, depth];
  });
}

function pane(points: Vec3[], material: THREE.Material): THREE.Mesh {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return new THREE.Mesh(geometry, material);
}

function triad(length: number, inks: Inks, labels: Label[]): THREE.Group {
  const group = new THREE.Group();
  (['x', 'y', 'z'] as const).forEach((name, i) => {
    const tip: Vec3 = [0, 0, 0];
    tip[i] = length * 1.6;
    group.add(segments([[0, 0, 0], tip], inks.line(`--axis-${name}`, 2.2)));
    labels.push({ text: name, at: tip, colour: `--axis-${name}` });
  });
  return group;
}

/// Horizontal for an upright tracker, below everything that was seen.
function grid({ grid: { step, y }, middle, radius }: RoomScales, inks: Inks): THREE.Object3D {
  const reach = Math.ceil((radius * 0.8) / step) * step;
  const [cx, cz] = [Math.round(middle[0] / step) * step, Math.round((middle[2] * 0.62) / step) * step];
  const points: Vec3[] = [];
  for (let d = -reach; d <= reach + 1e-6; d += step) {
    points.push([cx + d, y, cz - reach], [cx + d, y, cz + reach], [cx - reach, y, cz + d], [cx + reach, y, cz + d]);
  }
  return segments(points, inks.line('--grid', 1));
}
