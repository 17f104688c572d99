// SPDX-License-Identifier: Apache-2.0
import type { ScanReport } from './scan_report';
import type { Place } from './selection';

/// What the 3-D view is about.
export type ScanMode = 'plan' | 'cloud' | 'completeness';
/// What the cloud's colours tell.
export type CloudShade = 'deviation' | 'scan' | 'sigma' | 'points' | 'incidence' | 'plain';
/// How two rounds are set against one another.
export type Comparison = 'off' | 'flicker' | 'side by side';

/// What the reader of a page about scans is looking at. `frame` is the round.
export interface ScanSelection extends Place {
  mode: ScanMode;
  shade: CloudShade;
  view: number | null;  // of the round's plan
  hole: number | null;  // of the round's completeness
  comparison: Comparison;
  against: number;      // the other round
}

export const kFieldOf: Record<Exclude<CloudShade, 'plain'>, string> = { deviation: 'deviation_mm', scan: 'scan', sigma: 'sigma_mm', points: 'points', incidence: 'incidence_deg' };

/// What a round's data can be shown as.
export function modesOf(report: ScanReport): ScanMode[] {
  return (['plan', 'cloud', 'completeness'] as const).filter((mode) => report.rounds.some((round) => round[mode] !== null));
}

export function shadesOf(report: ScanReport): CloudShade[] {
  const has = (shade: Exclude<CloudShade, 'plain'>) => report.rounds.some((round) => round.cloud?.fields.some((field) => field.name === kFieldOf[shade]));
  return [...(Object.keys(kFieldOf) as Exclude<CloudShade, 'plain'>[]).filter(has), 'plain'];
}

export function firstScanSelection(report: ScanReport): ScanSelection {
  return { frame: 0, range: null, mode: modesOf(report)[0] ?? 'plan', shade: shadesOf(report)[0], view: null, hole: null, comparison: 'off', against: Math.min(1, report.rounds.length - 1) };
}
