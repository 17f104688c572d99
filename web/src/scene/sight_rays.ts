// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from '../data/cell_report';
import type { Vec3 } from '../data/parts';
import { hiderOf } from '../data/sight';
import { placeOf } from '../data/spots';

/// Lines of sight as pieces of line in the tracker.
export interface SightRays {
  seen: Vec3[];    // from camera to target
  broken: Vec3[];  // up to what hides the target; a stub at the target where something else keeps it from being seen
}

const kStub = 0.14;  // of the way to the camera

/// Of one body's targets in a frame. `meet` tells where the way from a camera to a place first meets a solid.
export function sightRays(report: CellReport, body: number, frame: number, eyes: [Vec3, Vec3], meet: (solid: number, from: Vec3, to: Vec3) => Vec3 | null): SightRays {
  const rays: SightRays = { seen: [], broken: [] };
  report.bodies[body].targets.forEach((target, i) => {
    const place = placeOf(report, { name: '', carrier: body, at: target.position_mm }, frame);
    eyes.forEach((eye, side) => {
      const letter = report.bodies[body].sight[i][side][frame];
      const hider = hiderOf(letter);
      if (letter === '.') rays.seen.push(eye, place);
      else if (hider !== null) rays.broken.push(eye, meet(hider, eye, place) ?? place);
      else rays.broken.push(place, place.map((v, k) => v + kStub * (eye[k] - v)) as Vec3);
    });
  });
  return rays;
}
