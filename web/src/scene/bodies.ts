// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { posesOf, statusOf } from '../data/errors';
import { apply, motionOf, pointCovariance } from '../data/pose';
import type { Vec3 } from '../data/parts';
import type { BodyTrack } from '../data/report';
import type { Source } from '../data/selection';
import { bodyColour } from '../plots/figures';
import { errorEllipsoid, placeEllipsoid } from './error_ellipsoid';
import { segments, type Inks } from './ink';
import type { Label } from './labels';
import { kSeen, placeAt, pointMark, seenBy, targetMarks } from './marks';
import { constellation, type Scales } from './scales';

export interface BodyView {
  group: THREE.Object3D;
  ellipsoid: THREE.Object3D;
  show: (frame: number, source: Source) => void;
  labels: (frame: number, source: Source, active: boolean) => Label[];
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

  const full = errorEllipsoid(inks.solid(name, 0.42));
  const mesh = errorEllipsoid(inks.solid('--predicted-ink', 0.6, true), [16, 10]);
  const ellipsoid = new THREE.Group();
  ellipsoid.add(full, mesh);
  group.add(moving, ellipsoid);

  const show = (frame: number, source: Source) => {
    const row = posesOf(body, source)[frame];
    group.visible = row !== null && row !== undefined;
    if (!row) return;
    const motion = motionOf(row);
    placeAt(moving, motion);
    const predicted = statusOf(body, source)[frame] === 'R';
    measuredLines.visible = full.visible = !predicted;
    predictedLines.visible = mesh.visible = predicted;
    marks.forEach((mark, i) => {
      const seen = predicted ? 'hidden' : seenBy(body.sightings[i]?.seen[frame]);
      for (const kind of kSeen) mark[kind].visible = kind === seen;
    });
    for (const part of [full, mesh]) placeEllipsoid(part, pointCovariance(row), apply(motion, body.point.position_mm), scales.ellipsoids);
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
