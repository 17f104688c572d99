// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import type { CellSolid } from '../data/cell_report';
import type { Mesh } from '../data/mesh';
import { ramp } from '../plots/ramp';
import type { Inks } from './ink';

/// How the part and the solids about it are drawn.
export type SolidLook = 'shaded' | 'see-through' | 'error map' | 'hidden';
export const kSolidLooks: SolidLook[] = ['shaded', 'see-through', 'error map', 'hidden'];

const kColours: Record<CellSolid['role'], string> = { workpiece: '--part', fixture: '--fixture', obstacle: '--obstacle' };
const kCrease = (28 * Math.PI) / 180;  // faces that meet at more than this have an edge

export interface SolidView {
  object: THREE.Group;
  mesh: THREE.Mesh;
  show: (look: SolidLook) => void;
}

/// A surface shaded, glassy, or coloured by its errors; with its edges.
export function solidView(solid: CellSolid, { positions, corners }: Mesh, range: [number, number] | null, inks: Inks): SolidView {
  const indexed = new THREE.BufferGeometry();
  indexed.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  indexed.setIndex(new THREE.BufferAttribute(corners, 1));
  const geometry = toCreasedNormals(indexed, kCrease);
  const name = kColours[solid.role] ?? '--obstacle';
  const shaded = inks.surface(name, 1);
  const glass = inks.surface(name, 0.22);
  const mapped = range && solid.error_mm.length > 0 ? errorColours(geometry, solid, corners, range) : null;
  const mesh: THREE.Mesh = new THREE.Mesh(geometry, shaded);
  const edges = new LineSegments2(new LineSegmentsGeometry().fromEdgesGeometry(new THREE.EdgesGeometry(geometry, (kCrease * 180) / Math.PI)), inks.line('--edge', 1, 0.55));
  edges.frustumCulled = false;
  const object = new THREE.Group().add(mesh, edges);
  const show = (look: SolidLook) => {
    object.visible = look !== 'hidden';
    mesh.material = look === 'error map' && mapped ? mapped : look === 'see-through' ? glass : shaded;
  };
  return { object, mesh, show };
}

/// A colour at each corner, grey where nothing is told. Unlit, so that a colour means the same everywhere.
function errorColours(geometry: THREE.BufferGeometry, solid: CellSolid, corners: Uint32Array, [low, high]: [number, number]): THREE.Material {
  const colours = new Float32Array(3 * corners.length);
  const at = new THREE.Color();
  corners.forEach((vertex, i) => {
    const value = solid.error_mm[vertex];
    if (value === null || value === undefined) at.set('#8a8f94');
    else at.set(ramp(high > low ? (value - low) / (high - low) : 0.5));
    at.toArray(colours, 3 * i);
  });
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 });
}
