// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from './cell_report';
import type { MotionRow, Vec3 } from './parts';
import { apply, inverse, motionOf, subtract, type Motion } from './pose';
import { conjugate, rotate } from './quaternion';

/// A place that moves with what carries it.
export interface Spot {
  name: string;
  carrier: number;  // a place in bodies; −1 = the tracker
  at: Vec3;         // mm, in the carrier's frame
}

export interface Distance {
  length: number;     // mm
  inTracker: Vec3;    // from the first spot to the second, along the tracker's axes
  inPart: Vec3;       // the same, along the part's
}

const kStill: MotionRow = [0, 0, 0, 1, 0, 0, 0];

export function carrierMotion(report: CellReport, carrier: number, frame: number): Motion {
  return motionOf(carrier < 0 ? kStill : report.bodies[carrier].pose[frame] ?? kStill);
}

/// Where a spot is in the tracker's frame.
export function placeOf(report: CellReport, spot: Spot, frame: number): Vec3 {
  return apply(carrierMotion(report, spot.carrier, frame), spot.at);
}

/// The frame in which lengths on the part are told: O_g where there is one, else that of what carries the part.
export function partFrame(report: CellReport): { name: string; carrier: number; pose: MotionRow } {
  const workpiece = report.axes.find((axes) => axes.name.startsWith('O_g'));
  if (workpiece) return workpiece;
  const carrier = report.solids.find((solid) => solid.role === 'workpiece')?.carrier ?? report.body;
  return { name: report.bodies[carrier]?.name ?? 'tracker', carrier, pose: kStill };
}

export function distance(report: CellReport, from: Spot, to: Spot, frame: number): Distance {
  const inTracker = subtract(placeOf(report, to, frame), placeOf(report, from, frame));
  const { carrier, pose } = partFrame(report);
  const inCarrier = rotate(conjugate(carrierMotion(report, carrier, frame).rotation), inTracker);
  return { length: Math.hypot(...inTracker), inTracker, inPart: rotate(conjugate(motionOf(pose).rotation), inCarrier) };
}

/// Every place that has a name: targets, points of the part, frames, both cameras.
export function namedSpots(report: CellReport): Spot[] {
  return [
    ...report.points.map((point): Spot => ({ name: point.name, carrier: report.body, at: point.position_mm })),
    ...report.bodies.flatMap((body, carrier) => body.targets.map((target): Spot => ({ name: `${body.name} ${target.id}`, carrier, at: target.position_mm }))),
    ...report.axes.map((axes): Spot => ({ name: axes.name, carrier: axes.carrier, at: motionOf(axes.pose).translation })),
    { name: 'left camera', carrier: -1, at: [0, 0, 0] },
    { name: 'right camera', carrier: -1, at: inverse(motionOf(report.rig.right_from_left)).translation },
  ];
}

/// A place in the tracker's frame as a spot that moves with a carrier from now on.
export function spotAt(report: CellReport, name: string, carrier: number, inTracker: Vec3, frame: number): Spot {
  return { name, carrier, at: apply(inverse(carrierMotion(report, carrier, frame)), inTracker) };
}
