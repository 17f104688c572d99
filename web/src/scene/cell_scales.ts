// SPDX-License-Identifier: Apache-2.0
import { kEllipsoid95 } from '../data/bands';
import type { CellReport } from '../data/cell_report';
import { roundStep } from '../data/format';
import { boxCorners, type Mesh } from '../data/mesh';
import type { Vec3 } from '../data/parts';
import { apply } from '../data/pose';
import { carrierMotion } from '../data/spots';
import { quantile } from '../data/statistics';
import { discScale, roomScales, type RoomScales } from './scales';

export interface CellScales extends RoomScales {
  span: number;        // of the verified body with what it carries, mm
  discs: number;       // enlargement of the targets
  ellipsoids: number;  // enlargement of the 95 % ellipsoids
}

/// The corners of what a body carries and its targets, in its own frame; of the tracker for −1.
export function carried(report: CellReport, meshes: Mesh[], carrier: number): Vec3[] {
  const boxes = report.solids.flatMap((solid, i) => (solid.carrier === carrier && meshes[i].positions.length > 0 ? boxCorners(meshes[i]) : []));
  return [...boxes, ...(report.bodies[carrier]?.targets.map((target) => target.position_mm) ?? [])];
}

export function cellScales(report: CellReport, meshes: Mesh[]): CellScales {
  const frames = report.time_s.map((_, i) => i).filter((i) => i % Math.max(1, Math.floor(report.time_s.length / 20)) === 0);
  const places = [-1, ...report.bodies.map((_, i) => i)].flatMap((carrier) => {
    const own = carried(report, meshes, carrier);
    return (carrier < 0 ? [0] : frames).flatMap((frame) => own.map((point) => apply(carrierMotion(report, carrier, frame), point)));
  });
  const body = carried(report, meshes, report.body);
  const span = Math.max(1, ...[0, 1, 2].map((k) => Math.max(...body.map((p) => p[k])) - Math.min(...body.map((p) => p[k]))));
  const sizes = report.points.flatMap((point) => point.covariance_mm2.flatMap((c) => (c ? [kEllipsoid95 * Math.sqrt(Math.max(0, c[0], c[3], c[5]))] : [])));
  const usual = quantile(sizes, 0.5) ?? 0;
  return {
    ...roomScales(report.rig, places.length > 0 ? places : [[0, 0, 2000]], 0.2 * span), span,
    discs: discScale(report.bodies[report.body]?.targets ?? [], span, 0.035),
    ellipsoids: usual > 0 ? Math.max(1, roundStep((0.09 * span) / usual)) : 1,
  };
}
