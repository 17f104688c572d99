// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { kEllipsoid95 } from '../data/bands';
import type { Vec3 } from '../data/parts';
import { cholesky, type Covariance } from '../data/pose';

/// Holds a point with probability 95 %, enlarged; its matrix is told by a covariance along the tracker's axes.
export function errorEllipsoid(material: THREE.Material, [across, along] = [40, 24]): THREE.Mesh {
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, across, along), material);
  mesh.matrixAutoUpdate = false;
  return mesh;
}

export function placeEllipsoid(mesh: THREE.Mesh, covariance: Covariance, [x, y, z]: Vec3, enlarged: number): void {
  const [a, b, c, d, e, f] = cholesky(covariance).map((v) => v * kEllipsoid95 * enlarged);
  mesh.matrix.set(a, 0, 0, x, b, c, 0, y, d, e, f, z, 0, 0, 0, 1);
  mesh.matrixWorldNeedsUpdate = true;
}
