// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { count, percent, significant } from '../data/format';
import type { Deviation } from '../data/scan_report';
import { svg } from '../dom';
import { chartAxis } from './chart';
import { deviationColour } from './shades';
import { tickText } from './svg';

const kHeight = 250;
const [kLeft, kRight, kTop, kBottom] = [52, 16, 22, 40];

/// The middle of each bin, mm; the histogram lies about zero.
export function binMiddles({ histogram, bin_mm }: Deviation): number[] {
  return histogram.map((_, i) => (i - (histogram.length - 1) / 2) * bin_mm);
}

/// What a normal distribution about zero would give in a bin, as a share of all points.
export function normalShare(middle: number, bin: number, sigma: number): number {
  return (bin / (sigma * Math.sqrt(2 * Math.PI))) * Math.exp(-0.5 * (middle / sigma) ** 2);
}

export function deviationAsCsv(deviation: Deviation): string {
  return csv(['from_mm', 'to_mm', 'points'], binMiddles(deviation).map((middle, i) => [middle - deviation.bin_mm / 2, middle + deviation.bin_mm / 2, deviation.histogram[i]]));
}

export function deviationNote({ whole }: Deviation, tolerance: number): string {
  const within = whole.in_tolerance === null ? '' : `${percent(whole.in_tolerance)} % within ±${significant(tolerance, 2)} mm; `;
  const predicted = whole.predicted_rms_mm ? `, predicted ${significant(whole.predicted_rms_mm, 3)} mm` : '';
  const beyond = whole.beyond > 0 ? `; ${count(whole.beyond)} lie too far off to belong to this surface` : '';
  return `${within}mean ${significant(whole.mean_mm, 2)} mm, RMS ${significant(whole.rms_mm, 3)} mm${predicted}, of ${count(whole.points)} points${beyond}.`;
}

/// Where the deviations lie, in the colours of the map, against the tolerance and against what the points' own
/// uncertainty alone would give.
export function deviationPlot(deviation: Deviation, tolerance: number, width: number): SVGSVGElement | null {
  const middles = binMiddles(deviation);
  const total = Math.max(1, deviation.whole.points);
  if (middles.length === 0 || !(deviation.bin_mm > 0)) return null;
  const half = deviation.bin_mm / 2;
  const [low, high] = [middles[0] - half, middles[middles.length - 1] + half];
  const sigma = deviation.whole.predicted_rms_mm ?? 0;
  const curve = sigma > 0 ? Array.from({ length: 201 }, (_, k) => low + (k / 200) * (high - low)).map((at) => ({ at, share: normalShare(at, deviation.bin_mm, sigma) })) : [];
  const shares = deviation.histogram.map((points) => points / total);
  const x = chartAxis([low, high], false, kLeft, width - kRight, false);
  const y = chartAxis([0, ...shares, ...curve.map(({ share }) => share)].map((share) => 100 * share), false, kHeight - kBottom, kTop);
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const reach = Math.max(3 * tolerance, tolerance * 1.01);
  const top = curve.length > 0 ? curve.reduce((best, place) => (place.at >= 0 && place.share > 0.5 * normalShare(0, deviation.bin_mm, sigma) ? place : best), curve[100]) : null;
  return svg('svg', {
    width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `Histogram of the deviation from the nominal surface. ${deviationNote(deviation, tolerance)}`,
  },
  ...y.ticks.flatMap((tick) => [svg('path', { d: `M${kLeft} ${y.at(tick)}H${width - kRight}`, stroke: 'var(--grid)' }), text(`${tickText(tick)} %`, { x: kLeft - 6, y: y.at(tick) + 4, 'text-anchor': 'end' })]),
  ...middles.map((middle, i) => svg('rect', {
    x: x.at(middle - half), y: y.at(100 * shares[i]), width: Math.max(0.5, x.at(middle + half) - x.at(middle - half) - 0.7), height: Math.max(0, y.at(0) - y.at(100 * shares[i])), fill: deviationColour(middle, tolerance, reach),
  }, svg('title', {}, `${significant(middle - half, 3)} to ${significant(middle + half, 3)} mm: ${count(deviation.histogram[i])} points`))),
  ...[-tolerance, tolerance].filter((at) => at > low && at < high).flatMap((at) => [
    svg('path', { d: `M${x.at(at)} ${kTop - 6}V${kHeight - kBottom}`, stroke: 'var(--flag)', 'stroke-dasharray': '6 4' }),
    text(`${at < 0 ? '−' : '+'} tolerance`, { x: x.at(at) + (at < 0 ? -4 : 4), y: kTop - 8, 'text-anchor': at < 0 ? 'end' : 'start', fill: 'var(--flag)' })]),
  svg('path', { d: curve.map(({ at, share }, k) => `${k === 0 ? 'M' : 'L'}${x.at(at).toFixed(1)} ${y.at(100 * share).toFixed(1)}`).join(''), fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.6, 'stroke-dasharray': '5 3' }),
  top ? text('predicted', { x: x.at(top.at) + 6, y: y.at(100 * top.share) - 2, fill: 'var(--ink)', stroke: 'var(--panel)', 'stroke-width': 3, 'paint-order': 'stroke' }) : null,
  svg('path', { d: `M${kLeft} ${kHeight - kBottom}H${width - kRight}`, stroke: 'var(--line)' }),
  ...x.ticks.map((tick) => text(tickText(tick), { x: x.at(tick), y: kHeight - kBottom + 16, 'text-anchor': 'middle' })),
  text('deviation (mm), outside positive', { x: (kLeft + width - kRight) / 2, y: kHeight - 6, 'text-anchor': 'middle' }));
}
