// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Samples } from '../data/scan';
import { paintedSurface } from '../data/surface_paint';
import type { Mesh } from '../data/mesh';
import { sampleDiscs, type SamplePaint } from './sample_discs';

/// On the surface itself where there is one, else as discs at the samples.
export function samplePaint(samples: Samples, mesh: Mesh | null, lift_mm: number): SamplePaint {
  if (!mesh || mesh.corners.length === 0) return sampleDiscs(samples, lift_mm);
  const { positions, sample } = paintedSurface(mesh, samples);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  const tints = new THREE.BufferAttribute(new Float32Array(12 * sample.length), 4);
  geometry.setAttribute('color', tints);
  const object = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true, alphaTest: 0.5, flatShading: true, side: THREE.DoubleSide }));
  object.frustumCulled = false;
  const paint = (colourOf: (sample: number) => string | null) => {
    const known = new Map<string, THREE.Color>();
    for (let t = 0; t < sample.length; ++t) {
      const name = sample[t] < 0 ? null : colourOf(sample[t]);
      if (name !== null && !known.has(name)) known.set(name, new THREE.Color(name));
      const colour = name === null ? null : known.get(name)!;
      for (let c = 0; c < 3; ++c) tints.setXYZW(3 * t + c, colour?.r ?? 0, colour?.g ?? 0, colour?.b ?? 0, colour ? 1 : 0);
    }
    tints.needsUpdate = true;
  };
  return { object, paint };
}
