// SPDX-License-Identifier: Apache-2.0
import type * as THREE from 'three';
import type { Vec3 } from '../data/parts';
import type { TrackingReport } from '../data/report';
import type { Selection, Source } from '../data/selection';
import { bodyView, sightLines } from './bodies';
import { segments } from './ink';
import { rigView } from './rig';
import type { Scales } from './scales';
import { stageOf, type Stage } from './stage';
import { trajectoryView } from './trajectory';

export type Layer = 'fields' | 'trajectory' | 'ellipsoids' | 'sight lines' | 'names';
export type ViewPoint = 'cell' | 'bodies' | 'left camera' | 'above' | 'side';

export interface SceneView extends Pick<Stage, 'element' | 'refresh' | 'still' | 'png'> {
  show: (selection: Selection) => void;
  setLayer: (layer: Layer, visible: boolean) => void;
  look: (from: ViewPoint) => void;
}

export const kDirections: Record<Exclude<ViewPoint, 'left camera'>, Vec3> = {
  cell: [-0.66, -0.5, -0.6], bodies: [-0.5, -0.42, -0.76], above: [0, -1, -1e-3], side: [-1, 0, 0],
};

/// The cell in motion.
export function sceneView(report: TrackingReport, scales: Scales, first: Selection): SceneView {
  const layers: Record<Layer, boolean> = { fields: true, trajectory: true, ellipsoids: true, 'sight lines': false, names: true };
  let selection = first;
  const stage = stageOf('Three-dimensional view of the tracker, the bodies and their way', scales.radius, () => (layers.names
    ? [...rig.labels, ...bodies.flatMap((body, i) => body.labels(selection.frame, selection.source, i === selection.body))]
    : []));
  const { scene, inks } = stage;
  const rig = rigView(report.rig, scales, inks);
  const bodies = report.bodies.map((body, i) => bodyView(body, i, scales, inks));
  const paths: Record<Source, THREE.Group> = {
    measured: trajectoryView(report.bodies, 'measured', scales, inks),
    filtered: trajectoryView(report.bodies, 'filtered', scales, inks),
  };
  const rayInk = inks.line('--sight', 1, 0.55);
  let rays = segments([], rayInk);
  scene.add(rig.group, paths.measured, paths.filtered, rays, ...bodies.map((body) => body.group));

  const show = (next: Selection) => {
    selection = next;
    for (const body of bodies) {
      body.show(next.frame, next.source);
      body.ellipsoid.visible = layers.ellipsoids;
    }
    paths.measured.visible = layers.trajectory && next.source === 'measured';
    paths.filtered.visible = layers.trajectory && next.source === 'filtered';
    rig.fields.visible = layers.fields;
    scene.remove(rays);
    rays.geometry.dispose();
    const active = report.bodies[next.body];
    const lines = layers['sight lines'] && active ? sightLines(active, next.frame, next.source, scales.right) : [];
    rays = segments(lines, rayInk);
    rays.visible = lines.length > 0;
    scene.add(rays);
    stage.request();
  };

  /// So that everything just fits into the view.
  const look = (from: ViewPoint) => {
    if (from === 'left camera') stage.stand([0, 0, scales.middle[2]], [0, 0, 0]);
    else stage.see(from === 'bodies' ? scales.places : [...scales.places, [0, 0, 0], scales.right], kDirections[from]);
  };
  return {
    ...stage, show, look,
    setLayer: (layer, visible) => {
      layers[layer] = visible;
      show(selection);
    },
  };
}
