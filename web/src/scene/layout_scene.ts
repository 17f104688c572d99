// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { LayoutReport } from '../data/layout';
import type { Target, Vec3 } from '../data/parts';
import { apply, motionOf } from '../data/pose';
import { rotate } from '../data/quaternion';
import type { LayoutSelection } from '../data/layout_selection';
import { segments } from './ink';
import type { Label } from './labels';
import { kSeen, placeAt, pointMark, ringMark, seenBy, targetMarks } from './marks';
import { rigView } from './rig';
import { constellation, discScale, roomScales, type RoomScales } from './scales';
import { kDirections } from './scene';
import { bordersOf, meshOf, sheetsOfPatch, sheetsOfSolid } from './solids';
import { stageOf, type Stage } from './stage';
import { volumeEdges } from './volume';

export type LayoutLayer = 'surface' | 'keep-outs' | 'obstacles' | 'volume' | 'fields' | 'sight lines' | 'present' | 'names';
export type LayoutViewPoint = 'targets' | 'onto the surface' | 'cell' | 'left camera' | 'side';

export interface LayoutScales extends RoomScales {
  span: number;
  discs: number;
  body: Vec3[];  // targets, surface and work points in the body's frame
}

export interface LayoutSceneView extends Pick<Stage, 'element' | 'refresh' | 'still' | 'png'> {
  show: (selection: LayoutSelection) => void;
  setLayer: (layer: LayoutLayer, visible: boolean) => void;
  look: (from: LayoutViewPoint) => void;
}

const kInk = '--body-1';
const kSurface = '--body-3';
const kVolume = '--body-4';
const kPresent = '--body-2';

export function layoutScales(report: LayoutReport): LayoutScales {
  const targets = report.layouts.flatMap((layout) => layout.targets);
  const surface = report.patches.flatMap((patch) => sheetsOfPatch(patch).flat(2));
  const body = [...surface, ...targets.map((target) => target.position_mm), ...report.points.map((point) => point.position_mm)];
  if (body.length === 0) body.push([0, 0, 0]);
  const sides = [0, 1, 2].map((k) => body.reduce(([low, high], p) => [Math.min(low, p[k]), Math.max(high, p[k])], [Infinity, -Infinity]));
  const span = Math.max(1, ...sides.map(([low, high]) => high - low));
  const poses = report.motion.pose.filter((_, i, all) => i % Math.max(1, Math.floor(all.length / 20)) === 0).map(motionOf);
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((c): Vec3 => [0, 1, 2].map((k) => sides[k][(c >> k) & 1]) as Vec3);
  const places = poses.flatMap((pose) => corners.map((corner) => apply(pose, corner)));
  return { ...roomScales(report.rig, places.length > 0 ? places : [[0, 0, 2000]], span), span, discs: discScale(targets, span, 0.045), body };
}

/// A layout on its body in one pose of the motion, with all that bounds it.
export function layoutScene(report: LayoutReport, scales: LayoutScales, first: LayoutSelection): LayoutSceneView {
  const layers: Record<LayoutLayer, boolean> = {
    surface: true, 'keep-outs': true, obstacles: true, volume: true, fields: false, 'sight lines': false, present: true, names: true,
  };
  let now = first;
  const stage = stageOf('Three-dimensional view of the layout on its body before the tracker', scales.radius, () => (layers.names ? [...rig.labels, ...bodyLabels(report, now)] : []));
  const { scene, inks } = stage;
  const rig = rigView(report.rig, scales, inks);
  const volume = report.volume ? segments(volumeEdges(report.volume), inks.line(kVolume, 1.4, 0.8)) : new THREE.Group();
  const body = new THREE.Group();
  const filled = (sheets: Vec3[][][], colour: string, opacity: number): THREE.Object3D => new THREE.Group().add(
    meshOf(sheets, inks.flat(colour, opacity)), segments(bordersOf(sheets), inks.line(colour, 1.3, 0.8)));
  const groupOf = (parts: THREE.Object3D[]) => (parts.length > 0 ? new THREE.Group().add(...parts) : new THREE.Group());
  const held: Partial<Record<LayoutLayer, THREE.Object3D>> = {
    surface: groupOf(report.patches.map((patch) => filled(sheetsOfPatch(patch), kSurface, 0.14))),
    'keep-outs': groupOf(report.keep_outs.map((solid) => filled(sheetsOfSolid(solid), '--flag', 0.22))),
    obstacles: groupOf(report.obstacles.map((solid) => filled(sheetsOfSolid(solid), '--muted', 0.1))),
  };
  const most = Math.max(1, ...report.layouts.map((layout) => layout.targets.length));
  const radius = 0.5 * scales.discs * (report.layouts[0]?.targets[0]?.diameter_mm ?? (0.03 * scales.span) / scales.discs);
  const up: Vec3 = [0, 0, 1];
  const pool = Array.from({ length: most }, () => targetMarks(up, radius, [0, 0, 0], kInk, inks, body));
  const ghosts = Array.from({ length: most }, () => ringMark(radius * 1.5, kPresent, inks, body));
  body.add(...Object.values(held), ...report.points.map((point) => pointMark(point.position_mm, 0.025 * scales.span, inks)));
  const lineInk = inks.line(kInk, 1.6, 0.7);
  const rayInk = inks.line('--sight', 1, 0.55);
  let lines = segments([], lineInk);
  let rays = segments([], rayInk);
  scene.add(rig.group, volume, body);

  const redraw = () => {
    const layout = report.layouts[now.layout];
    const motion = motionOf(report.motion.pose[now.frame] ?? [0, 0, 2000, 1, 0, 0, 0]);
    placeAt(body, motion);
    pool.forEach((marks, i) => {
      const seen = seenBy(layout.seen[i]?.[now.frame]);
      for (const kind of kSeen) placeMark(marks[kind], kind === seen ? layout.targets[i] : undefined);
    });
    const ghost = layers.present && now.layout !== now.against && now.against !== null ? report.layouts[now.against].targets : [];
    ghosts.forEach((mark, i) => placeMark(mark, ghost[i]));
    const places = layout.targets.map((target) => target.position_mm);
    for (const old of [lines, rays]) {
      old.removeFromParent();
      old.geometry.dispose();
    }
    lines = segments(constellation(places).flatMap(([a, b]) => [places[a], places[b]]), lineInk);
    body.add(lines);
    rays = segments(layers['sight lines'] ? sightLinesOf(report, now, scales.right) : [], rayInk);
    rays.visible = layers['sight lines'];
    scene.add(rays);
    for (const [layer, object] of Object.entries(held)) object.visible = layers[layer as LayoutLayer];
    volume.visible = layers.volume;
    rig.fields.visible = layers.fields;
    stage.request();
  };
  const look = (from: LayoutViewPoint) => {
    const motion = motionOf(report.motion.pose[now.frame] ?? [0, 0, 2000, 1, 0, 0, 0]);
    const there = scales.body.map((point) => apply(motion, point));
    if (from === 'left camera') stage.stand([0, 0, scales.middle[2]], [0, 0, 0]);
    else if (from === 'targets') stage.see(there, kDirections.bodies);
    else if (from === 'onto the surface') stage.see(there, rotate(motion.rotation, up));
    else stage.see([...scales.places, [0, 0, 0], scales.right], kDirections[from]);
  };
  return {
    ...stage, look,
    show: (next) => {
      now = next;
      redraw();
    },
    setLayer: (layer, visible) => {
      layers[layer] = visible;
      redraw();
    },
  };
}

/// Where its target is; without one it vanishes.
function placeMark(mark: THREE.Object3D, target: Target | undefined): void {
  mark.visible = target !== undefined;
  if (!target) return;
  mark.position.set(...target.position_mm);
  mark.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...(target.normal ?? [0, 0, 1])));
}

function bodyLabels(report: LayoutReport, now: LayoutSelection): Label[] {
  const motion = motionOf(report.motion.pose[now.frame] ?? [0, 0, 2000, 1, 0, 0, 0]);
  const layout = report.layouts[now.layout];
  return [
    ...layout.targets.map((target): Label => ({ text: target.id, at: apply(motion, target.position_mm), colour: kInk, strong: true })),
    ...report.points.map((point): Label => ({ text: point.name, at: apply(motion, point.position_mm), colour: '--ink' })),
  ];
}

/// From the cameras to each target they see in this pose.
function sightLinesOf(report: LayoutReport, now: LayoutSelection, right: Vec3): Vec3[] {
  const layout = report.layouts[now.layout];
  const motion = motionOf(report.motion.pose[now.frame]);
  return layout.targets.flatMap((target, i): Vec3[] => {
    const place = apply(motion, target.position_mm);
    const code = Number(layout.seen[i]?.[now.frame] ?? 0);
    return [...(code & 1 ? [[0, 0, 0] as Vec3, place] : []), ...(code & 2 ? [right, place] : [])];
  });
}
