// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour, h } from '../dom';
import type { TrackingReport, Vec3 } from '../data/report';
import type { Selection, Source } from '../data/selection';
import { bodyView, sightLines } from './bodies';
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
  png: () => Promise<Blob | null>;
}

const kFieldOfView = 32;

/// The cell in the tracker's frame (x right, y down, z forward), drawn only when something changed.
export function sceneView(report: TrackingReport, scales: Scales, first: Selection): SceneView {
  const drawing = h('canvas', { role: 'img', tabindex: 0, 'aria-label': 'Three-dimensional view of the tracker, the bodies and their way. Drag turns, wheel zooms, right drag moves; the arrow keys step through the frames.' });
  const names = h('canvas', { class: 'names', 'aria-hidden': 'true' });
  const element = h('div', { class: 'scene' }, drawing, names);
  const renderer = new THREE.WebGLRenderer({ canvas: drawing, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(kFieldOfView, 1, scales.cell.radius / 500, scales.cell.radius * 30);
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

  controls.addEventListener('change', request);
  new ResizeObserver(refresh).observe(element);
  return {
    element, show, look, refresh,
    setLayer: (layer, visible) => {
      layers[layer] = visible;
      show(selection);
    },
    png: () => new Promise((resolve) => {
      draw();
      const both = h('canvas', { width: drawing.width, height: drawing.height });
      const context = both.getContext('2d')!;
      context.fillStyle = colour('--panel');
      context.fillRect(0, 0, both.width, both.height);
      context.drawImage(drawing, 0, 0);
      context.drawImage(names, 0, 0, both.width, both.height);
      both.toBlob(resolve);
    }),
  };
}

/// Where to stand so that a ball fills the view.
export function viewPoint(from: ViewPoint, scales: Scales, aspect: number): { target: Vec3; position: Vec3 } {
  const { centre, radius } = from === 'bodies' || from === 'left camera' ? scales.bodies : scales.cell;
  if (from === 'left camera') return { target: [0, 0, centre[2]], position: [0, 0, 0] };
  const directions: Record<Exclude<ViewPoint, 'left camera'>, Vec3> = {
    cell: [-0.78, -0.46, -0.42], bodies: [-0.5, -0.42, -0.76], above: [0, -1, -1e-3], side: [-1, 0, 0],
  };
  const direction = directions[from];
  const half = Math.atan(Math.tan((kFieldOfView * Math.PI) / 360) * Math.min(1, aspect));
  const distance = (radius * 0.92) / Math.sin(half) / Math.hypot(...direction);
  return { target: centre, position: [centre[0] + direction[0] * distance, centre[1] + direction[1] * distance, centre[2] + direction[2] * distance] };
}
