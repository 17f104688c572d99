// SPDX-License-Identifier: Apache-2.0
import { present, quantile } from '../data/statistics';
import { roundStep } from '../data/format';
import type { Cloud } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import { kFieldOf, type CloudShade } from '../data/scan_selection';
import { ramp } from './ramp';

/// From values to colours, with what a colour bar needs.
export interface Shade {
  title: string;
  low: number;
  high: number;
  colour: (value: number) => string;
  marks: { label: string; value: number }[];
  open: boolean;  // values lie beyond the ends, which have the last colours
}

/// Where nothing is told.
export const kNoShade = '#8a8f94';

/// Told apart without regard to red and green (Okabe and Ito), lighter ones for dark grounds left out.
export const kScanColours = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#b8a900', '#7b4aa8'];

const kInside = ['#2f9f88', '#63bf8a', '#a6cf6f'];          // from −tolerance to +tolerance: green
const kBelow = ['#6db6ea', '#3480cc', '#2456b0', '#1d3489'];  // then blue, the darker the farther
const kAbove = ['#f2a33c', '#e0662a', '#bf2f22', '#85131f'];  // and orange to dark red

function along(stops: string[], part: number): string {
  const at = Math.min(1, Math.max(0, part)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  const channel = (stop: string, k: number) => parseInt(stop.slice(1 + 2 * k, 3 + 2 * k), 16);
  return `#${[0, 1, 2].map((k) => Math.round(channel(stops[i], k) + (at - i) * (channel(stops[i + 1], k) - channel(stops[i], k))).toString(16).padStart(2, '0')).join('')}`;
}

/// Green inside the tolerance, blue below, orange and red above: the steps at the tolerance are meant to be seen.
/// Light and dark differ too, for the colour-blind and in print.
export function deviationColour(value: number, tolerance: number, reach: number): string {
  if (Math.abs(value) <= tolerance) return along(kInside, 0.5 + (0.5 * value) / tolerance);
  const part = (Math.abs(value) - tolerance) / Math.max(reach - tolerance, 1e-12);
  return along(value < 0 ? kBelow : kAbove, part);
}

/// To how far deviations have colours of their own: thrice the tolerance, more where many lie beyond it.
export function deviationReach(values: number[], tolerance: number): number {
  const far = quantile(values.map(Math.abs), 0.995) ?? 0;
  return far <= 3 * tolerance ? 3 * tolerance : Math.max(3 * tolerance, Math.min(8 * tolerance, 2 * roundStep(far)));
}

/// One scale for a value in all rounds, so that they can be compared. Null where colours have no scale.
export function shadeOf(report: ScanReport, clouds: (Cloud | null)[], shade: CloudShade): Shade | null {
  if (shade === 'plain' || shade === 'scan') return null;
  const values = clouds.flatMap((cloud) => {
    const field = cloud?.fields.get(kFieldOf[shade]);
    if (!field) return [];
    const step = Math.max(1, Math.floor(field.length / 20000));
    return present(Array.from({ length: Math.ceil(field.length / step) }, (_, i) => field[i * step]));
  });
  if (values.length === 0) return null;
  if (shade === 'deviation') {
    const reach = deviationReach(values, report.tolerance_mm);
    return {
      title: 'deviation (mm)', low: -reach, high: reach, colour: (value) => deviationColour(value, report.tolerance_mm, reach), open: true,
      marks: [{ label: '+ tolerance', value: report.tolerance_mm }, { label: '− tolerance', value: -report.tolerance_mm }],
    };
  }
  const [low, high] = shade === 'incidence' ? [0, report.scanner.max_incidence_deg]
    : [shade === 'points' ? 1 : quantile(values, 0.005)!, quantile(values, 0.99)!];
  const top = high > low ? high : low + 1;
  return {
    title: { sigma: 'standard deviation along the normal (mm)', points: 'points in one', incidence: 'incidence (deg)' }[shade], low, high: top, open: shade !== 'incidence',
    colour: (value) => ramp((value - low) / (top - low)), marks: shade === 'incidence' ? [{ label: 'good up to here', value: report.scanner.good_incidence_deg }] : [],
  };
}

const kSteps = 384;  // of a scale: the tolerance falls between two of them when it is a third of the reach

/// Three bytes a point.
export function tintsOf(cloud: Cloud, shade: CloudShade, scale: Shade | null, plain: string): Uint8Array {
  const tints = new Uint8Array(3 * cloud.count);
  const field = shade === 'plain' ? undefined : cloud.fields.get(kFieldOf[shade]);
  const set = (i: number, colour: string) => [0, 1, 2].forEach((k) => (tints[3 * i + k] = parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16)));
  const steps = scale ? Array.from({ length: kSteps }, (_, k) => scale.colour(scale.low + ((k + 0.5) / kSteps) * (scale.high - scale.low))) : [];
  for (let i = 0; i < cloud.count; ++i) {
    const value = field?.[i];
    if (shade === 'plain') set(i, plain);
    else if (value === undefined || !Number.isFinite(value)) set(i, kNoShade);
    else if (!scale) set(i, kScanColours[value % kScanColours.length]);
    else set(i, steps[Math.min(kSteps - 1, Math.max(0, Math.floor(((value - scale.low) / (scale.high - scale.low)) * kSteps)))]);
  }
  return tints;
}
