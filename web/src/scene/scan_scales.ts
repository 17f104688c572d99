// SPDX-License-Identifier: Apache-2.0
import { boxCorners, type Mesh } from '../data/mesh';
import type { Vec3 } from '../data/parts';
import type { Unpacked } from '../data/scan';
import type { ScanReport } from '../data/scan_report';

export interface ScanScales {
  part: Vec3[];    // places that surface, samples and clouds are held by
  views: Vec3[];   // where the scanner stands
  span: number;    // longest side of the part's box, mm
  radius: number;  // of everything together, about the origin too
}

const kEnough = 2000;  // places of a surface that tell how large it looks from anywhere

function boxOf(points: Vec3[]): { low: Vec3; high: Vec3 } {
  const side = (pick: (a: number, b: number) => number): Vec3 => [0, 1, 2].map((k) => points.reduce((found, point) => pick(found, point[k]), points[0]?.[k] ?? 0)) as Vec3;
  return { low: side(Math.min), high: side(Math.max) };
}

function some(numbers: Float32Array): Vec3[] {
  const step = Math.max(1, Math.floor(numbers.length / 3 / kEnough));
  return Array.from({ length: Math.floor(numbers.length / 3 / step) }, (_, i): Vec3 => [numbers[3 * i * step], numbers[3 * i * step + 1], numbers[3 * i * step + 2]]);
}

export function scanScales(report: ScanReport, data: Unpacked, mesh: Mesh | null): ScanScales {
  const places = [
    ...(mesh ? some(mesh.positions) : []),
    ...report.sample_lists.flatMap((_, i) => some(data.samplesAt(i)!.places)),
    ...(mesh ? [] : report.rounds.flatMap((_, i) => some(data.cloudOf(i)?.positions ?? new Float32Array(0)))),
  ];
  const views = report.rounds.flatMap((round) => round.plan?.views.map(({ pose }): Vec3 => [pose[0], pose[1], pose[2]]) ?? []);
  const part: Vec3[] = places.length > 0 ? places : [[-500, -500, -500], [500, 500, 500]];
  const [own, all] = [boxOf(part), boxOf([...part, ...views])];
  return {
    part, views,
    span: Math.max(1, ...[0, 1, 2].map((k) => own.high[k] - own.low[k])),
    radius: Math.max(1, ...boxCorners(all).map((corner) => Math.hypot(...corner)), 0.5 * Math.hypot(...[0, 1, 2].map((k) => all.high[k] - all.low[k]))),
  };
}
