// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { Vec3 } from '../data/parts';
import { apply, motionOf } from '../data/pose';
import type { PlannedView, ScanPlan, Scanner } from '../data/scan_report';
import { bodyColour } from '../plots/figures';
import { segments, type Inks } from './ink';

const kShort = 0.3;  // of the stand-off, so that twenty views leave the part to be seen

/// The scanner's place and the corners of its field so far before it.
export function frustum(view: PlannedView, scanner: Scanner, part: number): { apex: Vec3; corners: Vec3[] } {
  const motion = motionOf(view.pose);
  const [w, h, z] = [part * scanner.field_width_mm / 2, part * scanner.field_height_mm / 2, part * scanner.stand_off_mm];
  return { apex: motion.translation, corners: ([[-1, -1], [1, -1], [1, 1], [-1, 1]] as const).map(([x, y]) => apply(motion, [x * w, y * h, z])) };
}

function edges({ apex, corners }: { apex: Vec3; corners: Vec3[] }): Vec3[] {
  return corners.flatMap((corner, i): Vec3[] => [apex, corner, corner, corners[(i + 1) % 4]]);
}

function fields(frustums: { corners: Vec3[] }[], material: THREE.Material): THREE.Mesh {
  const geometry = new THREE.BufferGeometry();
  const places = frustums.flatMap(({ corners: [a, b, c, d] }) => [a, b, c, a, c, d].flat());
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(places), 3));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

export interface PlanView {
  views: THREE.Group;
  tour: THREE.Group;
  choose: (view: number | null) => void;
}

/// All views of a plan, coloured by the platform's pose, and the way from one to the next: dashed where the platform
/// turns between them. The chosen one is drawn at its stand-off.
export function planView(plan: ScanPlan, scanner: Scanner, inks: Inks): PlanView {
  const [views, tour, chosen] = [new THREE.Group(), new THREE.Group(), new THREE.Group()];
  plan.poses.forEach((_, p) => {
    const own = plan.views.filter((view) => view.platform === p).map((view) => frustum(view, scanner, kShort));
    if (own.length === 0) return;
    views.add(segments(own.flatMap(edges), inks.line(bodyColour(p), 1.5, 0.95)), fields(own, inks.flat(bodyColour(p), 0.2)));
  });
  const ways = { still: [] as Vec3[], turned: [] as Vec3[] };
  plan.views.slice(1).forEach((view, i) => {
    const before = plan.views[i];
    ways[before.platform === view.platform ? 'still' : 'turned'].push(motionOf(before.pose).translation, motionOf(view.pose).translation);
  });
  if (ways.still.length > 0) tour.add(segments(ways.still, inks.line('--tour', 1.6, 0.85)));
  if (ways.turned.length > 0) tour.add(segments(ways.turned, inks.line('--tour', 1.6, 0.85, scanner.stand_off_mm / 12)));
  const [line, fill] = [inks.line('--lit', 2.6), inks.flat('--lit', 0.1)];
  views.add(chosen);
  const choose = (view: number | null) => {
    for (const old of [...chosen.children]) {
      old.removeFromParent();
      (old as THREE.Mesh).geometry.dispose();
    }
    const one = view === null ? undefined : plan.views[view];
    if (!one) return;
    const whole = frustum(one, scanner, 1);
    chosen.add(segments(edges(whole), line), fields([whole], fill));
  };
  return { views, tour, choose };
}
