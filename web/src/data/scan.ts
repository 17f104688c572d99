// SPDX-License-Identifier: Apache-2.0
import { count, decimals, significant } from './format';
import { bitsOf, countsOf, floatsOf, halfOf, shortsOf, signedBytesOf } from './packed';
import type { Vec3 } from './parts';
import type { Hole, PackedCloud, PlatformPose, SampleList, ScanPlan, ScanReport, ScanRound } from './scan_report';

export interface Samples {
  count: number;
  places: Float32Array;
  normals: Int8Array;
  areas: Float32Array;  // mm²
}

/// The drawn points of a cloud, with a number each for what is known of them; NaN = none.
export interface Cloud {
  count: number;
  positions: Float32Array;
  normals: Int8Array | null;
  fields: Map<string, Float32Array>;
  spacing_mm: number;  // of neighbours, about
}

export function samplesOf({ places, normals, areas_mm2 }: SampleList): Samples {
  const areas = floatsOf(areas_mm2);
  return { count: areas.length, places: floatsOf(places), normals: signedBytesOf(normals), areas };
}

export function cloudOf(packed: PackedCloud): Cloud {
  const steps = shortsOf(packed.places);
  const positions = Float32Array.from(steps, (step, i) => packed.low_mm[i % 3] + packed.step_mm * step);
  const fields = new Map(packed.fields.map(({ name, whole, values }): [string, Float32Array] => {
    const bits = shortsOf(values);
    return [name, Float32Array.from(bits, (value) => (whole ? (value === 65535 ? NaN : value) : halfOf(value)))];
  }));
  const longest = 65535 * packed.step_mm;
  return {
    count: packed.drawn, positions, normals: packed.normals ? signedBytesOf(packed.normals) : null, fields,
    spacing_mm: packed.voxel_mm > 0 ? packed.voxel_mm : longest / Math.sqrt(Math.max(1, packed.drawn)),
  };
}

/// What the pages' views share: everything unpacked, each only when it is first asked for.
export class Unpacked {
  private samples = new Map<number, Samples>();
  private clouds = new Map<number, Cloud | null>();
  private holes = new Map<Hole, Uint32Array>();
  private flags = new Map<string, Uint8Array>();

  constructor(private report: ScanReport) {}

  samplesAt(list: number): Samples | null {
    const packed = this.report.sample_lists[list];
    if (!packed) return null;
    if (!this.samples.has(list)) this.samples.set(list, samplesOf(packed));
    return this.samples.get(list)!;
  }

  cloudOf(round: number): Cloud | null {
    const packed = this.report.rounds[round]?.cloud;
    if (!this.clouds.has(round)) this.clouds.set(round, packed ? cloudOf(packed) : null);
    return this.clouds.get(round)!;
  }

  /// What is told of each sample by a bit.
  bits(packed: string): Uint8Array {
    if (!this.flags.has(packed)) this.flags.set(packed, bitsOf(packed));
    return this.flags.get(packed)!;
  }

  samplesOfHole(hole: Hole): Uint32Array {
    if (!this.holes.has(hole)) this.holes.set(hole, countsOf(hole.samples));
    return this.holes.get(hole)!;
  }
}

/// By sample: 1 = one of the plan's views measures it, or it was measured before.
export function coveredBy(plan: ScanPlan, data: Unpacked): Uint8Array {
  const covered = Uint8Array.from(data.bits(plan.covered_before));
  for (const view of plan.views) data.bits(view.measures).forEach((bit, i) => (covered[i] |= bit));
  return covered;
}

/// Share of the whole surface that is covered after 0, 1, 2 … views.
export function coverageSteps(plan: ScanPlan): number[] {
  const shares = [plan.covered_before_mm2];
  for (const view of plan.views) shares.push(shares[shares.length - 1] + view.adds_mm2);
  return shares.map((area) => (plan.surface_mm2 > 0 ? Math.min(1, area / plan.surface_mm2) : 0));
}

/// The three denominators of coverage, as shares of the whole surface.
export function coverageLevels(plan: ScanPlan): { name: string; share: number }[] {
  const share = (area: number) => (plan.surface_mm2 > 0 ? area / plan.surface_mm2 : 0);
  return [
    { name: 'whole surface', share: 1 },
    { name: 'any view at all', share: share(plan.reachable_mm2) },
    { name: 'in this cell', share: share(plan.coverable_mm2) },
  ].filter((level) => level.share > 0);
}

/// What fills the tour: views, turns of the platform, and the ways between.
export interface TourPiece {
  kind: 'view' | 'turn' | 'way';
  view: number;      // that it is, or leads to
  platform: number;
  from: number;      // s
  to: number;
}

export function tourPieces(plan: ScanPlan, view_s: number, turn_s: number): TourPiece[] {
  let free = 0;
  return plan.views.flatMap((view, i): TourPiece[] => {
    const turns = i > 0 && plan.views[i - 1].platform !== view.platform;
    const turned = turns ? Math.min(free + turn_s, view.starts_s) : free;
    const pieces: TourPiece[] = [
      { kind: 'turn', view: i, platform: view.platform, from: free, to: turned },
      { kind: 'way', view: i, platform: view.platform, from: turned, to: view.starts_s },
      { kind: 'view', view: i, platform: view.platform, from: view.starts_s, to: view.starts_s + view_s },
    ];
    free = view.starts_s + view_s;
    return pieces.filter(({ from, to }) => to > from);
  });
}

export function poseWords({ yaw_deg, pitch_deg, roll_deg }: PlatformPose): string {
  const told = ([['yaw', yaw_deg], ['pitch', pitch_deg], ['roll', roll_deg]] as const).filter(([, deg]) => Math.abs(deg) > 1e-6);
  return told.length === 0 ? 'at rest' : told.map(([name, deg]) => `${name} ${decimals(deg, Number.isInteger(deg) ? 0 : 1)}°`).join(', ');
}

/// In the unit that keeps it short.
export function areaText(mm2: number): string {
  return mm2 >= 1e6 ? `${significant(mm2 / 1e6, 3)} m²` : mm2 >= 100 ? `${significant(mm2 / 100, 3)} cm²` : `${significant(mm2, 2)} mm²`;
}

export function completeShare(round: ScanRound): number | null {
  const told = round.completeness;
  return told && told.surface_mm2 > 0 ? told.measured_mm2 / told.surface_mm2 : null;
}

/// What is drawn of how many.
export function drawnWords(round: ScanRound): string {
  if (!round.cloud) return 'no cloud yet';
  const { points, drawn, voxel_mm } = round.cloud;
  return drawn === points ? `all ${count(points)} points are drawn` : `${count(drawn)} of ${count(points)} points are drawn, one in each ${significant(voxel_mm, 2)} mm`;
}

/// What is known of one drawn point, in words.
export function pointWords(cloud: Cloud, i: number): string {
  const value = (name: string) => cloud.fields.get(name)?.[i];
  const there = (name: string, words: (v: number) => string) => {
    const v = value(name);
    return v === undefined || !Number.isFinite(v) ? [] : [words(v)];
  };
  const deviation = value('deviation_mm');
  return [
    `x ${decimals(cloud.positions[3 * i], 1)}  y ${decimals(cloud.positions[3 * i + 1], 1)}  z ${decimals(cloud.positions[3 * i + 2], 1)} mm`,
    ...(deviation === undefined ? [] : [Number.isFinite(deviation) ? `deviation ${deviation > 0 ? '+' : ''}${decimals(deviation, 3)} mm` : 'belongs to no surface']),
    ...there('sigma_mm', (v) => `σ ${significant(v, 2)} mm`), ...there('scan', (v) => `scan ${v}`), ...there('scans', (v) => (v > 1 ? `of ${v} scans` : '')),
    ...there('points', (v) => `${count(v)} point${v === 1 ? '' : 's'}`), ...there('incidence_deg', (v) => `incidence ${decimals(v, 0)}°`), ...there('range_mm', (v) => `range ${decimals(v, 0)} mm`),
  ].filter(Boolean).join(' · ');
}

export function pointAt(cloud: Cloud, i: number): Vec3 {
  return [cloud.positions[3 * i], cloud.positions[3 * i + 1], cloud.positions[3 * i + 2]];
}
