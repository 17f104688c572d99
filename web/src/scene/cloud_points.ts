// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Cloud } from '../data/scan';
import type { Vec3 } from '../data/parts';
import type { Stage, Vec2 } from './stage';

const kNear = 8;  // px: so near the cursor a point is meant

// A point is drawn as large as the space it stands for. What faces away is left out, so that the far side of a part
// does not shine through; all are drawn a little nearer to the eye, along the line of sight, so that the nominal surface
// does not cut them.
const kVertex = `
attribute vec3 tint;
attribute vec3 facing;
uniform float size_mm, px_per_tangent, shaded;
varying vec3 colour;
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  float turned = dot(normalize(normalMatrix * facing), normalize(-at.xyz));
  bool known = dot(facing, facing) > 0.01;
  float depth = -at.z;
  at.xyz *= 0.996;
  gl_Position = known && turned < 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * at;
  gl_PointSize = clamp(size_mm * px_per_tangent / depth, 1.7, 40.0);
  colour = tint * mix(1.0, known ? 0.62 + 0.38 * turned : 1.0, shaded);
}`;
const kFragment = `
varying vec3 colour;
void main() {
  if (length(gl_PointCoord - 0.5) > 0.5) discard;
  gl_FragColor = vec4(colour, 1.0);
}`;

export interface CloudPoints {
  object: THREE.Points;
  paint: (tints: Uint8Array, shaded: boolean) => void;
  resize: (stage: Stage) => void;
  /// The drawn point nearest to the eye of those near the cursor, unless something hides it farther on than `until` mm.
  pick: (stage: Stage, cursor: Vec2, until: number) => number | null;
}

export function cloudPoints(cloud: Cloud): CloudPoints {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(cloud.positions, 3));
  geometry.setAttribute('facing', new THREE.BufferAttribute(cloud.normals ?? new Int8Array(3 * cloud.count), 3, true));
  geometry.setAttribute('tint', new THREE.BufferAttribute(new Uint8Array(3 * cloud.count), 3, true));
  const material = new THREE.ShaderMaterial({
    vertexShader: kVertex, fragmentShader: kFragment,
    uniforms: { size_mm: { value: 1.25 * cloud.spacing_mm }, px_per_tangent: { value: 1 }, shaded: { value: 0 } },
  });
  const object = new THREE.Points(geometry, material);
  object.frustumCulled = false;
  return {
    object,
    paint: (tints, shaded) => {
      geometry.setAttribute('tint', new THREE.BufferAttribute(tints, 3, true));
      material.uniforms.shaded.value = shaded ? 1 : 0;
    },
    resize: (stage) => (material.uniforms.px_per_tangent.value = stage.pxPerTangent()),
    pick: (stage, cursor, until) => nearestPoint(cloud, stage, cursor, until),
  };
}

function nearestPoint(cloud: Cloud, stage: Stage, [x, y]: Vec2, until: number): number | null {
  const { origin, direction } = stage.rayAt(x, y).ray;
  const [eye, way] = [origin.toArray() as Vec3, direction.toArray() as Vec3];
  const reach = kNear / stage.pxPerTangent() * (window.devicePixelRatio || 1);  // as a tangent, near the axis of the view
  let [best, least] = [-1, Infinity];
  for (let i = 0; i < cloud.count; ++i) {
    const off: Vec3 = [cloud.positions[3 * i] - eye[0], cloud.positions[3 * i + 1] - eye[1], cloud.positions[3 * i + 2] - eye[2]];
    const along = off[0] * way[0] + off[1] * way[1] + off[2] * way[2];
    if (along <= 0 || along > until) continue;
    const across2 = off[0] ** 2 + off[1] ** 2 + off[2] ** 2 - along ** 2;
    if (across2 > (reach * along) ** 2) continue;
    const { normals } = cloud;
    if (normals && normals[3 * i] * off[0] + normals[3 * i + 1] * off[1] + normals[3 * i + 2] * off[2] > 0) continue;
    // Of points as near to the eye the one under the cursor: a pixel aside counts as much as it is wide.
    const worth = along + 6 * Math.sqrt(Math.max(0, across2));
    if (worth < least) [best, least] = [i, worth];
  }
  return best < 0 ? null : best;
}
