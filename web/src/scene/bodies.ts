// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { kEllipsoid95 } from '../data/bands';
import { posesOf, statusOf } from '../data/errors';
import { apply, cholesky, motionOf, pointCovariance, type Motion } from '../data/pose';
import type { BodyTrack, Vec3 } from '../data/report';
import type { Source } from '../data/selection';
import { bodyColour } from '../plots/figures';
import { segments, type Inks } from './ink';
import type { Label } from './labels';
import { constellation, type Scales } from './scales';

export type Seen = 'both' | 'one' | 'hidden';

export function seenAt(body: BodyTrack, target: number, frame: number): Seen {
  const code = body.sightings[target]?.seen[frame];
  return code === '3' ? 'both' : code === '1' || code === '2' ? 'one' : 'hidden';
}

export interface BodyView {
  group: THREE.Object3D;
  ellipsoid: THREE.Object3D;
  show: (frame: number, source: Source) => void;
  labels: (frame: number, source: Source, active: boolean) => Label[];
}

interface TargetMarks {
  both: THREE.Object3D;
  one: THREE.Object3D;
  hidden: THREE.Object3D;
}

/// A body as its constellation. Measured: full lines, discs by how they were seen. Predicted: dashed, every
/// disc an empty ring, the ellipsoid a mesh. Ambiguous or lost: nothing is drawn.
export function bodyView(body: BodyTrack, index: number, scales: Scales, inks: Inks): BodyView {
  const name = bodyColour(index);
  const group = new THREE.Group();
  const moving = new THREE.Group();
  const positions = body.targets.map((target) => target.position_mm);
  const lines = constellation(positions).flatMap(([a, b]) => [positions[a], positions[b]]);
  const measuredLines = segments(lines, inks.line(name, 2));
  const predictedLines = segments(lines, inks.line('--predicted-ink', 1.6, 1, 0.02 * scales.span));
  const marks = body.targets.map((target) => targetMarks(target.normal, 0.5 * (target.diameter_mm ?? 0.03 * scales.span / scales.discs) * scales.discs, target.position_mm, name, inks, moving));
  moving.add(measuredLines, predictedLines, pointMark(body.point.position_mm, 0.02 * scales.span, inks));

  const sphere = new THREE.SphereGeometry(1, 40, 24);
  const full = new THREE.Mesh(sphere, inks.solid(name, 0.42));
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 16, 10), inks.solid('--predicted-ink', 0.6, true));
  const ellipsoid = new THREE.Group();
  ellipsoid.add(full, mesh);
  for (const part of [full, mesh]) part.matrixAutoUpdate = false;
  group.add(moving, ellipsoid);

  const show = (frame: number, source: Source) => {
    const row = posesOf(body, source)[frame];
    group.visible = row !== null && row !== undefined;
    if (!row) return;
    const motion = motionOf(row);
    place(moving, motion);
    const predicted = statusOf(body, source)[frame] === 'R';
    measuredLines.visible = full.visible = !predicted;
    predictedLines.visible = mesh.visible = predicted;
    marks.forEach((mark, i) => {
      const seen = predicted ? 'hidden' : seenAt(body, i, frame);
      for (const kind of ['both', 'one', 'hidden'] as const) mark[kind].visible = kind === seen;
    });
    const [a, b, c, d, e, f] = cholesky(pointCovariance(row)).map((v) => v * kEllipsoid95 * scales.ellipsoids);
    const [x, y, z] = apply(motion, body.point.position_mm);
    for (const part of [full, mesh]) {
      part.matrix.set(a, 0, 0, x, b, c, 0, y, d, e, f, z, 0, 0, 0, 1);
      part.matrixWorldNeedsUpdate = true;
    }
  };

  const labels = (frame: number, source: Source, active: boolean): Label[] => {
    const row = posesOf(body, source)[frame];
    if (!row) return [];
    const motion = motionOf(row);
    const predicted = statusOf(body, source)[frame] === 'R';
    const at = apply(motion, body.point.position_mm);
    const own: Label[] = [{ text: predicted ? `${body.name} (predicted)` : body.name, at, colour: predicted ? '--predicted-ink' : name, strong: true, below: true }];
    if (!active) return own;
    return [...own, ...body.targets.map((target): Label => ({ text: target.id, at: apply(motion, target.position_mm), colour: '--muted' }))];
  };
  return { group, ellipsoid, show, labels };
}

function place(object: THREE.Object3D, { translation, rotation: [w, x, y, z] }: Motion): void {
  object.position.set(...translation);
  object.quaternion.set(x, y, z, w);
}

function targetMarks(normal: Vec3 | undefined, radius: number, at: Vec3, name: string, inks: Inks, into: THREE.Group): TargetMarks {
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
  return { both: make(name, disc), one: make(name, ring, dot), hidden: make('--hidden', ring) };
}

/// A small cross where accuracy is told.
function pointMark(at: Vec3, size: number, inks: Inks): THREE.Object3D {
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

/// From the cameras to each target they saw, in the tracker.
export function sightLines(body: BodyTrack, frame: number, source: Source, right: Vec3): Vec3[] {
  const row = posesOf(body, source)[frame];
  if (!row) return [];
  const motion = motionOf(row);
  return body.sightings.flatMap((sighting, i): Vec3[] => {
    const place = apply(motion, body.targets[i].position_mm);
    const code = Number(sighting.seen[frame]);
    return [...(code & 1 ? [[0, 0, 0] as Vec3, place] : []), ...(code & 2 ? [right, place] : [])];
  });
}
