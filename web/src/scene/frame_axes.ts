// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { CellAxes } from '../data/cell_report';
import type { Vec3 } from '../data/parts';
import { motionOf } from '../data/pose';
import { segments, type Inks } from './ink';
import { placeAt } from './marks';

/// A frame as three arrows x, y, z in their colours, in its carrier.
export function frameAxes(axes: CellAxes, length: number, inks: Inks): THREE.Group {
  const group = new THREE.Group();
  (['x', 'y', 'z'] as const).forEach((name, k) => {
    const along = (part: number, aside = 0): Vec3 => [0, 1, 2].map((i) => (i === k ? part * length : i === (k + 1) % 3 ? aside * length : 0)) as Vec3;
    group.add(segments([along(0), along(1), along(1), along(0.86, 0.06), along(1), along(0.86, -0.06)], inks.line(`--axis-${name}`, 2.4)));
  });
  placeAt(group, motionOf(axes.pose));
  return group;
}
