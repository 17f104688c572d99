// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { colour } from '../dom';
import type { Vec3 } from '../data/parts';

export interface Label {
  text: string;
  at: Vec3;        // in the tracker, mm
  colour: string;  // a custom property of the style sheet
  strong?: boolean;
  below?: boolean;
}

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/// Writes the names over the drawing, in the page's font, with a halo of the ground so that lines do not
/// run through the letters. A name that would cover an earlier one is left out; the bodies' come first.
export function drawLabels(canvas: HTMLCanvasElement, labels: Label[], camera: THREE.Camera): void {
  const ratio = window.devicePixelRatio || 1;
  const context = canvas.getContext('2d')!;
  const [width, height] = [canvas.width / ratio, canvas.height / ratio];
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.lineJoin = 'round';
  context.lineWidth = 3;
  context.strokeStyle = colour('--panel');
  const place = new THREE.Vector3();
  const written: Box[] = [];
  for (const label of [...labels].sort((a, b) => Number(b.strong ?? false) - Number(a.strong ?? false))) {
    place.set(...label.at).project(camera);
    if (Math.abs(place.z) > 1 || Math.abs(place.x) > 1 || Math.abs(place.y) > 1) continue;
    const x = ((place.x + 1) / 2) * width + (label.below ? 0 : 7);
    const y = ((1 - place.y) / 2) * height + (label.below ? 22 : -6);
    context.font = `${label.strong ? '600 12px' : '11px'} system-ui, sans-serif`;
    context.textAlign = label.below ? 'center' : 'left';
    const width_px = context.measureText(label.text).width;
    const left = label.below ? x - width_px / 2 : x;
    const box = { left, right: left + width_px, top: y - 10, bottom: y + 2 };
    if (written.some((other) => box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom)) continue;
    written.push(box);
    context.strokeText(label.text, x, y);
    context.fillStyle = colour(label.colour);
    context.fillText(label.text, x, y);
  }
}
