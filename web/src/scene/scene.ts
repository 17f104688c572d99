// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour, h } from '../dom';
import type { TrackingReport, Vec3 } from '../data/report';
import type { Selection, Source } from '../data/selection';
import { bodyView, sightLines } from './bodies';
import { standingPoint } from './fit';
import { Inks, segments } from './ink';
import { drawLabels } from './labels';
import { rigView } from './rig';
import type { Scales } from './scales';
import { trajectoryView } from './trajectory';

export type Layer = 'fields' | 'trajectory' | 'ellipsoids' | 'sight lines' | 'names';
export type ViewPoint = 'cell' | 'bodies' | 'left camera' | 'above' | 'side';

export interface SceneView {
  element: HTMLElement;
  show: (selection: Selection) => void;
  setLayer: (layer: Layer, visible: boolean) => void;
  look: (from: ViewPoint) => void;
  refresh: () => void;  // after a change of theme or size
  still: () => void;    // before printing: browsers print no WebGL
  png: () => Promise<Blob | null>;
}

const kFieldOfView = 32;

/// The cell in the tracker's frame (x right, y down, z forward), drawn only when something changed.
export function sceneView(report: TrackingReport, scales: Scales, first: Selection): SceneView {
  const drawing = h('canvas', { role: 'img', tabindex: 0, 'aria-label': 'Three-dimensional view of the tracker, the bodies and their way. Drag turns, wheel zooms, right drag moves; the arrow keys step through the frames.' });
  const names = h('canvas', { class: 'names', 'aria-hidden': 'true' });
  const printed = h('img', { class: 'printed', alt: 'Three-dimensional view of the tracker, the bodies and their way' });
  const element = h('div', { class: 'scene' }, drawing, names, printed);
  const renderer = new THREE.WebGLRenderer({ canvas: drawing, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(kFieldOfView, 1, scales.radius / 300, scales.radius * 30);
  camera.up.set(0, -1, 0);
  const controls = new OrbitControls(camera, drawing);
  controls.zoomSpeed = 1.4;
  const inks = new Inks();
  const rig = rigView(report, scales, inks);
  const bodies = report.bodies.map((body, i) => bodyView(body, i, scales, inks));
  const paths: Record<Source, THREE.Group> = {
    measured: trajectoryView(report.bodies, 'measured', scales, inks),
    filtered: trajectoryView(report.bodies, 'filtered', scales, inks),
  };
  const rayInk = inks.line('--sight', 1, 0.55);
  let rays = segments([], rayInk);
  const lamp = new THREE.DirectionalLight(0xffffff, 2.2);
  scene.add(new THREE.HemisphereLight(0xffffff, 0xb0b8c0, 1.6), lamp, rig.group, paths.measured, paths.filtered, rays, ...bodies.map((body) => body.group));

  const layers: Record<Layer, boolean> = { fields: true, trajectory: true, ellipsoids: true, 'sight lines': false, names: true };
  let selection = first;
  let waiting = false;

  const draw = () => {
    waiting = false;
    lamp.position.copy(camera.position);
    renderer.render(scene, camera);
    const labels = layers.names
      ? [...rig.labels, ...bodies.flatMap((body, i) => body.labels(selection.frame, selection.source, i === selection.body))]
      : [];
    drawLabels(names, labels, camera);
  };
  const request = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(draw);
  };

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
    request();
  };

  const refresh = () => {
    const [width, height] = [element.clientWidth, element.clientHeight];
    if (width === 0 || height === 0) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    renderer.setPixelRatio(ratio);
    renderer.setSize(width, height, false);
    names.width = width * (window.devicePixelRatio || 1);
    names.height = height * (window.devicePixelRatio || 1);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    inks.refresh(width, height);
    draw();
  };

  const look = (from: ViewPoint) => {
    const { target, position } = viewPoint(from, scales, camera.aspect);
    controls.target.set(...target);
    camera.position.set(...position);
    controls.update();
    request();
  };

  const composed = (): HTMLCanvasElement => {
    draw();
    const both = h('canvas', { width: drawing.width, height: drawing.height });
    const context = both.getContext('2d')!;
    context.fillStyle = colour('--panel');
    context.fillRect(0, 0, both.width, both.height);
    context.drawImage(drawing, 0, 0);
    context.drawImage(names, 0, 0, both.width, both.height);
    return both;
  };

  controls.addEventListener('change', request);
  new ResizeObserver(refresh).observe(element);
  return {
    element, show, look, refresh,
    setLayer: (layer, visible) => {
      layers[layer] = visible;
      show(selection);
    },
    still: () => {
      printed.src = composed().toDataURL();
    },
    png: () => new Promise((resolve) => composed().toBlob(resolve)),
  };
}

const kDirections: Record<Exclude<ViewPoint, 'left camera'>, Vec3> = {
  cell: [-0.66, -0.5, -0.6], bodies: [-0.5, -0.42, -0.76], above: [0, -1, -1e-3], side: [-1, 0, 0],
};

/// Where to stand, and what to turn about, so that everything just fits into the view.
export function viewPoint(from: ViewPoint, scales: Scales, aspect: number): { target: Vec3; position: Vec3 } {
  if (from === 'left camera') return { target: [0, 0, scales.middle[2]], position: [0, 0, 0] };
  const points = from === 'bodies' ? scales.places : [...scales.places, [0, 0, 0] as Vec3, scales.right];
  const up = Math.tan((kFieldOfView * Math.PI) / 360);
  return standingPoint(points, kDirections[from], 0.84 * up * aspect, 0.84 * up);
}
