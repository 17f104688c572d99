// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { colour } from '../dom';
import type { Vec3 } from '../data/parts';

/// Materials that follow the page's theme: each is told the style sheet's name of its colour.
export class Inks {
  private made: { name: string; material: THREE.Material & { color: THREE.Color } }[] = [];
  private lines: LineMaterial[] = [];

  flat(name: string, opacity = 1): THREE.MeshBasicMaterial {
    return this.keep(name, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1 }));
  }

  solid(name: string, opacity: number, wireframe = false): THREE.MeshLambertMaterial {
    return this.keep(name, new THREE.MeshLambertMaterial({ transparent: opacity < 1, opacity, wireframe, depthWrite: opacity === 1 }));
  }

  /// A surface that things are drawn upon: pushed back a little, so that they do not flicker.
  surface(name: string, opacity: number): THREE.MeshLambertMaterial {
    return this.keep(name, new THREE.MeshLambertMaterial({
      side: THREE.DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2,
    }));
  }

  line(name: string, width: number, opacity = 1, dash = 0): LineMaterial {
    const material = new LineMaterial({ linewidth: width, transparent: opacity < 1, opacity, dashed: dash > 0, dashSize: dash, gapSize: dash * 0.7 });
    this.lines.push(material);
    return this.keep(name, material);
  }

  /// After a change of theme or size.
  refresh(width: number, height: number): void {
    for (const { name, material } of this.made) material.color.set(colour(name));
    for (const material of this.lines) material.resolution.set(width, height);
  }

  private keep<M extends THREE.Material & { color: THREE.Color }>(name: string, material: M): M {
    material.color.set(colour(name));
    this.made.push({ name, material });
    return material;
  }
}

/// Separate pieces of line: points two by two.
export function segments(points: Vec3[], material: LineMaterial): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(new Float32Array(points.flat()));
  const lines = new LineSegments2(geometry, material);
  if (material.dashed && points.length > 0) lines.computeLineDistances();
  lines.frustumCulled = false;
  return lines;
}
