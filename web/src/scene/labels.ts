// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { colour } from '../dom';
import type { Vec3 } from '../data/report';

export interface Label {
  text: string;
  at: Vec3;        // in the tracker, mm
  colour: string;  // a custom property of the style sheet
  strong?: boolean;
  below?: boolean;
}

/// Writes the names over the drawing, in the page's font, with a halo of the ground so that lines do not
/// run through the letters.
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
  for (const label of labels) {
    place.set(...label.at).project(camera);
    if (Math.abs(place.z) > 1 || Math.abs(place.x) > 1 || Math.abs(place.y) > 1) continue;
    const x = ((place.x + 1) / 2) * width + (label.below ? 0 : 7);
    const y = ((1 - place.y) / 2) * height + (label.below ? 22 : -6);
    context.font = `${label.strong ? '600 12px' : '11px'} system-ui, sans-serif`;
    context.textAlign = label.below ? 'center' : 'left';
    context.strokeText(label.text, x, y);
    context.fillStyle = colour(label.colour);
    context.fillText(label.text, x, y);
  }
}
