// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { BodyTrack } from '../data/report';
import type { Source } from '../data/selection';
import { bodyColour } from '../plots/figures';
import { segments, type Inks } from './ink';
import { pathPieces } from './paths';
import type { Scales } from './scales';

export function trajectoryView(bodies: BodyTrack[], source: Source, scales: Scales, inks: Inks): THREE.Group {
  const group = new THREE.Group();
  bodies.forEach((body, i) => {
    const { measured, predicted } = pathPieces(body, source);
    if (measured.length > 0) group.add(segments(measured, inks.line(bodyColour(i), 1.2, 0.55)));
    if (predicted.length > 0) group.add(segments(predicted, inks.line('--predicted-ink', 1.5, 0.9, 0.008 * scales.span)));
  });
  return group;
}
