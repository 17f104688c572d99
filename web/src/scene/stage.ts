// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { colour, h } from '../dom';
import type { Vec3 } from '../data/parts';
import { standingPoint } from './fit';
import { Inks } from './ink';
import { drawLabels, type Label } from './labels';

export type Vec2 = [number, number];

/// Drawn over the view, also in its PNG and print; px from the left top.
export type Overlay = (context: CanvasRenderingContext2D, width: number, height: number) => void;

/// What a page does with a 3-D view, whatever it shows.
export interface Stage {
  element: HTMLElement;
  scene: THREE.Scene;
  inks: Inks;
  request: () => void;                                         // draw when the browser next does
  stand: (target: Vec3, position: Vec3) => void;
  see: (points: Vec3[], direction: Vec3) => void;              // all points, looking against the direction
  project: (at: Vec3) => Vec2 | null;                          // from the view's left top, px; null outside
  rayAt: (x: number, y: number) => THREE.Raycaster;            // through that place of the view
  onClick: (listener: (x: number, y: number) => void) => void; // a press that does not drag
  onHover: (listener: (at: Vec2 | null) => void) => void;      // no button pressed; null when it leaves
  onTurn: (listener: () => void) => void;                      // the reader looks from elsewhere
  isFitted: () => boolean;                                     // what is to be seen, not where the reader turned it
  pxPerTangent: () => number;                                  // pixels of the drawing that a tangent of 1 spans
  standing: () => { target: Vec3; position: Vec3 };
  refresh: () => void;                                         // after a change of theme or size
  still: () => void;                                           // before printing: browsers print no WebGL
  png: () => Promise<Blob | null>;
}

const kFieldOfView = 32;
const kStill = 4;     // px: a press that moves further turns the view
const kMargin = 0.84;  // of the view is filled

/// A view of things in the tracker's frame (x right, y down, z forward) unless another direction is up, drawn only
/// when something changed.
export function stageOf(words: string, radius: number, labels: () => Label[], overlay: Overlay = () => {}, above: Vec3 = [0, -1, 0]): Stage {
  const drawing = h('canvas', { role: 'img', tabindex: 0, 'aria-label': `${words}. Drag turns, wheel zooms, right drag moves; the arrow keys step on and back.` });
  const names = h('canvas', { class: 'names', 'aria-hidden': 'true' });
  const printed = h('img', { class: 'printed', alt: words });
  const element = h('div', { class: 'scene' }, drawing, names, printed);
  const renderer = new THREE.WebGLRenderer({ canvas: drawing, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(kFieldOfView, 1, radius / 300, radius * 30);
  camera.up.set(...above);
  const controls = new OrbitControls(camera, drawing);
  controls.zoomSpeed = 1.4;
  const inks = new Inks();
  const lamp = new THREE.DirectionalLight(0xffffff, 2.2);
  scene.add(new THREE.HemisphereLight(0xffffff, 0xb0b8c0, 1.6), lamp);

  let waiting = false;
  const draw = () => {
    waiting = false;
    lamp.position.copy(camera.position);
    renderer.render(scene, camera);
    drawLabels(names, labels(), camera);
    overlay(names.getContext('2d')!, size.width, size.height);
  };
  const request = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(draw);
  };
  let size = { width: 0, height: 0, ratio: 1 };
  const resize = (width: number, height: number, ratio: number) => {
    size = { width, height, ratio };
    renderer.setPixelRatio(Math.min(2, ratio));
    renderer.setSize(width, height, false);
    names.width = width * ratio;
    names.height = height * ratio;
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  };
  let fitted: { points: Vec3[]; direction: Vec3 } | null = null;  // until the reader looks from elsewhere
  const refresh = () => {
    const { clientWidth: width, clientHeight: height } = element;
    if (width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    // Printed is the picture as it was on the screen: there the view has no size of its own.
    const printing = size.width > 0 && window.matchMedia('print').matches;
    if (!printing && (width !== size.width || height !== size.height || ratio !== size.ratio)) resize(width, height, ratio);
    if (fitted) see(fitted.points, fitted.direction);
    inks.refresh(size.width, size.height);
    draw();
  };
  const stand = (target: Vec3, position: Vec3) => {
    fitted = null;
    controls.target.set(...target);
    camera.position.set(...position);
    controls.update();
    request();
  };
  const see = (points: Vec3[], direction: Vec3) => {
    const up = kMargin * Math.tan((kFieldOfView * Math.PI) / 360);
    const { target, position } = standingPoint(points, direction, up * camera.aspect, up, above);
    stand(target, position);
    fitted = { points, direction };
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
  const project = (at: Vec3): Vec2 | null => {
    const place = new THREE.Vector3(...at).project(camera);
    if (Math.abs(place.z) > 1) return null;
    return [((place.x + 1) / 2) * size.width, ((1 - place.y) / 2) * size.height];
  };
  const rayAt = (x: number, y: number) => {
    const caster = new THREE.Raycaster();
    camera.updateMatrixWorld();
    caster.setFromCamera(new THREE.Vector2((2 * x) / size.width - 1, 1 - (2 * y) / size.height), camera);
    return caster;
  };
  const onClick = (listener: (x: number, y: number) => void) => {
    let down: Vec2 | null = null;
    drawing.addEventListener('pointerdown', (event) => (down = event.button === 0 ? [event.clientX, event.clientY] : null));
    drawing.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > kStill) return;
      const box = drawing.getBoundingClientRect();
      listener(event.clientX - box.left, event.clientY - box.top);
    });
  };
  const onHover = (listener: (at: Vec2 | null) => void) => {
    drawing.addEventListener('pointerleave', () => listener(null));
    drawing.addEventListener('pointermove', (event) => {
      const box = drawing.getBoundingClientRect();
      listener(event.buttons === 0 ? [event.clientX - box.left, event.clientY - box.top] : null);
    });
  };
  // Where a place of the tracker is on the screen, for who drives the page by script.
  Object.assign(drawing, { project });
  let held = false;
  controls.addEventListener('start', () => (held = true));
  controls.addEventListener('end', () => (held = false));
  controls.addEventListener('change', () => {
    if (held) fitted = null;
    request();
  });
  new ResizeObserver(refresh).observe(element);
  return {
    element, scene, inks, request, stand, see, project, rayAt, onClick, onHover, refresh,
    onTurn: (listener) => controls.addEventListener('change', listener),
    isFitted: () => fitted !== null,
    pxPerTangent: () => drawing.height / (2 * Math.tan((kFieldOfView * Math.PI) / 360)),
    standing: () => ({ target: controls.target.toArray() as Vec3, position: camera.position.toArray() as Vec3 }),
    still: () => {
      printed.src = composed().toDataURL();
    },
    png: () => new Promise((resolve) => composed().toBlob(resolve)),
  };
}
