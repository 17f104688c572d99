// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Vec3 } from '../data/parts';
import type { Motion } from '../data/pose';
import { segments, type Inks } from './ink';

/// By how many cameras a target is seen; drawn as a full disc, a ring with a dot, an empty ring.
export type Seen = 'both' | 'one' | 'hidden';
export const kSeen: Seen[] = ['both', 'one', 'hidden'];

/// 0 hidden, 1 left, 2 right, 3 both.
export function seenBy(code: string | undefined): Seen {
  return code === '3' ? 'both' : code === '1' || code === '2' ? 'one' : 'hidden';
}

/// A custom property of the style sheet for each way of being seen.
export type SeenColours = Record<Seen, string>;

export type TargetMarks = Record<Seen, THREE.Object3D>;

export function placeAt(object: THREE.Object3D, { translation, rotation: [w, x, y, z] }: Motion): void {
  object.position.set(...translation);
  object.quaternion.set(x, y, z, w);
}

/// A disc with a pin along its normal, in its three ways of being seen; added to `into`.
export function targetMarks(normal: Vec3 | undefined, radius: number, at: Vec3, name: string | SeenColours, inks: Inks, into: THREE.Group): TargetMarks {
  const disc = new THREE.CircleGeometry(radius, 32);
  const ring = new THREE.RingGeometry(radius * 0.74, radius, 32);
  const dot = new THREE.CircleGeometry(radius * 0.5, 24);
  const facing = normal ?? [0, 0, -1];
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...facing));
  const pin: Vec3[] = [[0, 0, 0], [0, 0, radius * 2.2]];
  const make = (colour: string, ...shapes: THREE.BufferGeometry[]) => {
    const group = new THREE.Group();
    for (const shape of shapes) group.add(new THREE.Mesh(shape, inks.flat(colour)));
    if (normal) group.add(segments(pin, inks.line(colour, 1.6)));
    group.position.set(...at);
    group.quaternion.copy(turn);
    into.add(group);
    return group;
  };
  const colours = typeof name === 'string' ? { both: name, one: name, hidden: '--hidden' } : name;
  return { both: make(colours.both, disc), one: make(colours.one, ring, dot), hidden: make(colours.hidden, ring) };
}

/// A ring around where a target is not, but was or will be.
export function ringMark(radius: number, colour: string, inks: Inks, into: THREE.Group): THREE.Object3D {
  const ring = new THREE.Mesh(new THREE.RingGeometry(radius * 0.8, radius, 32), inks.flat(colour));
  into.add(ring);
  return ring;
}

/// A small cross where accuracy is told.
export function pointMark(at: Vec3, size: number, inks: Inks): THREE.Object3D {
  const points: Vec3[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const sign of [-1, 1]) {
      const end: Vec3 = [...at];
      end[axis] += sign * size;
      points.push(end);
    }
  }
  return segments(points, inks.line('--ink', 1.2));
}
