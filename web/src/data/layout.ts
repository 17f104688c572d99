// SPDX-License-Identifier: Apache-2.0
// The data block of a page about layouts, written by src/asterism/report/layout_report.cpp.
// Lengths mm, angles deg, times s; the frame of the body that carries the targets unless a name says otherwise.
import type { MotionRow, Rig, SummaryRow, Target, Vec3 } from './parts';

/// One number that every layout has.
export interface Measure {
  name: string;                       // as on the command line: "worst-error-any-lost"
  label: string;
  unit: string;
  better: 'less' | 'more' | 'none';
  objective: boolean;
}

export interface Layout {
  name: string;                       // "07", "present"
  origin: string;                     // where it comes from, in words
  reference: boolean;                 // given, not found
  targets: Target[];
  values: (number | null)[];          // in the order of the measures
  fails: string[];                    // constraints that do not hold, in words with by how much
  seen: string[];                     // a target: a character a pose (0 hidden, 1 left, 2 right, 3 both)
  error_mm: (number | null)[];        // by pose: worst over the work points
  error_lost_mm: (number | null)[];   // the same after the worst loss
  notes: string[];                    // where the worst is, what was lost then
}

export type Patch = { name: string } & (
  | { kind: 'side'; base_mm: Vec3; radius_mm: number; height_mm: number; from_deg: number; to_deg: number }
  | { kind: 'ring'; centre_mm: Vec3; inner_radius_mm: number; outer_radius_mm: number; from_deg: number; to_deg: number }
  | { kind: 'plate'; pose: MotionRow; width_mm: number; height_mm: number }
  | { kind: 'room'; base_mm: Vec3; radius_mm: number; height_mm: number }
);

export type Solid = { name: string; pose: MotionRow } & (
  | { shape: 'box'; size_mm: Vec3 }
  | { shape: 'capsule'; from_mm: Vec3; to_mm: Vec3; radius_mm: number }
  | { shape: 'frustum'; bottom_radius_mm: number; top_radius_mm: number; height_mm: number }
);

/// A frustum about the z axis of its frame.
export interface Volume {
  pose: MotionRow;                    // tracker_from_middle
  near_mm: number; far_mm: number;
  near_size_mm: [number, number]; far_size_mm: [number, number];
  m3: number;
}

export interface RunRecord {
  generation: number;
  evaluations: number;
  hypervolume: number | null;
  feasible_share: number;
  seconds: number;
}

export interface LayoutReport {
  schema: 'asterism-layout-report/1';
  title: string;
  subtitle: string;
  summary: SummaryRow[];
  remarks: string[];                  // warnings in words
  body: string;
  rig: Rig;
  volume: Volume | null;
  patches: Patch[];
  keep_outs: Solid[];
  obstacles: Solid[];                 // that move with the body
  points: { name: string; position_mm: Vec3 }[];
  motion: { time_s: number[]; pose: MotionRow[] };  // tracker_from_body
  measures: Measure[];
  layouts: Layout[];
  knee: number | null;                // a place in layouts
  why: string;                        // that one is the knee
  history: RunRecord[];
  options: unknown;
}

export function objectivesOf(report: LayoutReport): number[] {
  return report.measures.flatMap((measure, i) => (measure.objective ? [i] : []));
}

export function holds(layout: Layout): boolean {
  return layout.fails.length === 0;
}

/// Below 0 when a is better than b.
export function compare(measure: Measure, a: number, b: number): number {
  return measure.better === 'more' ? b - a : a - b;
}

/// The layout that is best in a measure: of those found that hold all constraints, else of any that do.
export function bestIn(report: LayoutReport, measure: number): number | null {
  const pick = (from: (layout: Layout) => boolean) => report.layouts.reduce<number | null>((best, layout, i) => {
    const value = layout.values[measure];
    if (value === null || !holds(layout) || !from(layout)) return best;
    return best === null || compare(report.measures[measure], value, report.layouts[best].values[measure]!) < 0 ? i : best;
  }, null);
  return pick((layout) => !layout.reference) ?? pick(() => true);
}

/// What choosing a layout costs in one measure, against the best that could be had.
export interface Sacrifice {
  measure: number;
  value: number | null;
  best: number | null;       // a layout
  lost: number | null;       // by how much worse, in the measure's unit; 0 = it is the best
  share: number | null;      // of the best's value
}

export function sacrifices(report: LayoutReport, chosen: number): Sacrifice[] {
  return objectivesOf(report).map((measure) => {
    const value = report.layouts[chosen].values[measure];
    const best = bestIn(report, measure);
    if (value === null || best === null) return { measure, value, best, lost: null, share: null };
    const top = report.layouts[best].values[measure]!;
    const lost = compare(report.measures[measure], value, top);
    return { measure, value, best, lost, share: top !== 0 ? lost / Math.abs(top) : null };
  });
}

/// Those of the places that no other beats in both measures, ordered along the first: the front as two axes
/// show it.
export function frontOf(report: LayoutReport, places: number[], x: number, y: number): number[] {
  const [mx, my] = [report.measures[x], report.measures[y]];
  const at = (i: number, m: number) => report.layouts[i].values[m]!;
  const ordered = places.filter((i) => report.layouts[i].values[x] !== null && report.layouts[i].values[y] !== null)
    .sort((a, b) => compare(mx, at(a, x), at(b, x)) || compare(my, at(a, y), at(b, y)));
  const front: number[] = [];
  for (const i of ordered) {
    const last = front[front.length - 1];
    if (last === undefined || compare(my, at(i, y), at(last, y)) < 0) front.push(i);
  }
  return front;
}

/// How many targets both cameras see, by pose.
export function countSeen(layout: Layout): number[] {
  const poses = layout.seen[0]?.length ?? 0;
  return Array.from({ length: poses }, (_, k) => layout.seen.filter((codes) => codes[k] === '3').length);
}

export function measureText(measure: Measure): string {
  return measure.unit ? `${measure.label} (${measure.unit})` : measure.label;
}
