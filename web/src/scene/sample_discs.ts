// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Samples } from '../data/scan';

/// What is told of each sample, as colours on the part.
export interface SamplePaint {
  object: THREE.Object3D;
  /// A colour each; null leaves it out.
  paint: (colourOf: (sample: number) => string | null) => void;
}

/// A small disc on the surface at each sample, as large as the area that it stands for; seen from outside only.
export function sampleDiscs(samples: Samples, lift_mm: number): SamplePaint {
  const object = new THREE.InstancedMesh(new THREE.CircleGeometry(1, 12), new THREE.MeshBasicMaterial(), samples.count);
  const [place, normal, up] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3(0, 0, 1)];
  const [turn, size, matrix, colour] = [new THREE.Quaternion(), new THREE.Vector3(), new THREE.Matrix4(), new THREE.Color()];
  object.frustumCulled = false;
  const paint = (colourOf: (sample: number) => string | null) => {
    const known = new Map<string, THREE.Color>();
    for (let i = 0; i < samples.count; ++i) {
      const name = colourOf(i);
      if (name !== null && !known.has(name)) known.set(name, new THREE.Color(name));
      normal.fromArray(samples.normals, 3 * i).normalize();
      place.fromArray(samples.places, 3 * i).addScaledVector(normal, lift_mm);
      turn.setFromUnitVectors(up, normal);
      size.setScalar(name === null ? 0 : 1.2 * Math.sqrt(samples.areas[i] / Math.PI));
      object.setMatrixAt(i, matrix.compose(place, turn, size));
      object.setColorAt(i, name === null ? colour : known.get(name)!);
    }
    object.instanceMatrix.needsUpdate = true;
    if (object.instanceColor) object.instanceColor.needsUpdate = true;
  };
  paint(() => null);
  return { object, paint };
}
