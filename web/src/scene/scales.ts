// SPDX-License-Identifier: Apache-2.0
import { kEllipsoid95 } from '../data/bands';
import { roundStep } from '../data/format';
import { add, apply, inverse, motionOf, pointCovariance, subtract } from '../data/pose';
import type { MotionRow, Rig, Target, Vec3 } from '../data/parts';
import type { TrackingReport } from '../data/report';
import { quantile } from '../data/statistics';

/// How large things are and by how much the drawing exaggerates; all of it is stated under the view.
export interface RoomScales {
  places: Vec3[];                            // where targets were, at about a hundred moments
  middle: Vec3;                              // of those
  radius: number;                            // of rig and bodies together, mm
  right: Vec3;                               // the right camera's place in the tracker
  far: number;                               // depth to which the fields of view are drawn, mm
  grid: { step: number; y: number };
}

export interface Scales extends RoomScales {
  span: number;                              // of the largest body, mm
  discs: number;                             // enlargement of the targets
  ellipsoids: number;                        // enlargement of the 95 % ellipsoids
}

export function scalesOf(report: TrackingReport): Scales {
  const places: Vec3[] = [];
  let span = 0;
  const sizes: number[] = [];
  for (const body of report.bodies) {
    for (const a of body.targets) for (const b of body.targets) span = Math.max(span, Math.hypot(...subtract(a.position_mm, b.position_mm)));
    const step = Math.max(1, Math.floor(body.measured.length / 100));
    for (let i = 0; i < body.measured.length; i += step) {
      const row = body.measured[i];
      if (!row) continue;
      for (const target of body.targets) places.push(apply(motionOf(row as MotionRow), target.position_mm));
      const c = pointCovariance(row);
      sizes.push(kEllipsoid95 * Math.sqrt(Math.max(0, c[0], c[3], c[5])));
    }
  }
  if (places.length === 0) places.push([-500, -500, 2000], [500, 500, 2500]);
  span = span || ball(places).radius;
  const largest = quantile(sizes, 0.5) ?? 0;
  return {
    ...roomScales(report.rig, places, span), span,
    discs: discScale(report.bodies.flatMap((body) => body.targets), span),
    ellipsoids: largest > 0 ? Math.max(1, roundStep((0.2 * span) / largest)) : 1,
  };
}

/// For the tracker before the places that matter; the grid lies a quarter of `span` below them.
export function roomScales(rig: Rig, places: Vec3[], span: number): RoomScales {
  const right = inverse(motionOf(rig.right_from_left)).translation;
  const cell = ball([...places, [0, 0, 0], right]);
  return {
    places, right, middle: ball(places).centre, radius: cell.radius,
    far: Math.max(...places.map((p) => p[2])) * 1.08,
    grid: { step: roundStep(cell.radius / 3), y: Math.max(...places.map((p) => p[1])) + 0.25 * span },
  };
}

/// Targets of a few millimetres on a body of a metre would be specks: enlarged up to ten times, to a share of
/// the span.
export function discScale(targets: Target[], span: number, share = 0.07): number {
  const diameters = targets.map((target) => target.diameter_mm ?? 0).filter((d) => d > 0);
  const middle = quantile(diameters, 0.5);
  return middle ? Math.min(10, Math.max(1, Math.round((share * span) / middle))) : 1;
}

function ball(points: Vec3[]): { centre: Vec3; radius: number } {
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  for (const point of points) {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], point[k]);
      high[k] = Math.max(high[k], point[k]);
    }
  }
  const sum = add(low, high);
  const centre: Vec3 = [sum[0] / 2, sum[1] / 2, sum[2] / 2];
  return { centre, radius: Math.max(1, Math.hypot(...subtract(high, low)) / 2) };
}

/// The shortest lines that join all points (Prim): a body drawn as the constellation it is found by.
export function constellation(points: Vec3[]): [number, number][] {
  const joined = [0];
  const edges: [number, number][] = [];
  const left = new Set(points.map((_, i) => i).slice(1));
  while (left.size > 0) {
    let best: [number, number] = [0, 0];
    let shortest = Infinity;
    for (const a of joined) {
      for (const b of left) {
        const length = Math.hypot(...subtract(points[a], points[b]));
        if (length < shortest) [shortest, best] = [length, [a, b]];
      }
    }
    edges.push(best);
    joined.push(best[1]);
    left.delete(best[1]);
  }
  return edges;
}
