// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { decimals, significant } from '../data/format';
import { poseWords, tourPieces } from '../data/scan';
import type { ScanPlan, ScanReport } from '../data/scan_report';
import { svg } from '../dom';
import { chartAxis } from './chart';
import { bodyColour } from './figures';
import { tickText } from './svg';

const [kRight, kRow, kGap, kTop, kBottom] = [14, 22, 8, 6, 36];
const kLetter = 6.2;  // px, about, of the rows' names

type Times = Pick<ScanReport, 'view_s' | 'turn_s'>;

export function tourAsCsv(plan: ScanPlan, times: Times): string {
  return csv(['kind', 'view', 'platform_pose', 'from_s', 'to_s'], tourPieces(plan, times.view_s, times.turn_s).map((piece) => [piece.kind, piece.view + 1, piece.platform + 1, piece.from, piece.to]));
}

export function tourNote(plan: ScanPlan): string {
  const saved = plan.nearest_neighbour_s > 0 ? `; by nearest neighbour ${significant(plan.nearest_neighbour_s, 4)} s (${significant(100 * (plan.nearest_neighbour_s / plan.tour_s - 1), 2)} % more)` : '';
  return plan.tour_s > 0 ? `The whole tour takes ${significant(plan.tour_s, 4)} s${saved}. A block is a view, the line between two blocks the scanner's way, hatched is a turn of the platform.` : '';
}

/// The tour over time, a row a pose of the platform.
export function tourChart(plan: ScanPlan, times: Times, width: number, chosen: number | null, choose: (view: number) => void): SVGSVGElement {
  const pieces = tourPieces(plan, times.view_s, times.turn_s);
  const left = Math.min(width / 3, 24 + kLetter * Math.max(...plan.poses.map((pose) => poseWords(pose).length), 4));
  const bottom = kTop + plan.poses.length * (kRow + kGap);
  const end = Math.max(plan.tour_s, ...pieces.map((piece) => piece.to), 1);
  const x = chartAxis([0, end], false, left, width - kRight, false);
  const y = (platform: number) => kTop + platform * (kRow + kGap);
  const middle = (platform: number) => y(platform) + kRow / 2;
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const block = (i: number, from: number, to: number, platform: number) => {
    const wide = x.at(to) - x.at(from);
    const is = i === chosen;
    return svg('g', { class: 'pick', onclick: () => choose(i) },
      svg('rect', { x: x.at(from), y: y(platform), width: Math.max(1.5, wide - 0.6), height: kRow, fill: is ? 'var(--lit)' : `var(${bodyColour(platform)})`, stroke: is ? 'var(--ink)' : 'none' }),
      wide > 15 ? svg('text', { x: x.at((from + to) / 2), y: middle(platform) + 4, 'text-anchor': 'middle', fill: is ? '#1a2127' : 'var(--panel)' }, String(i + 1)) : null,
      svg('title', {}, `view ${i + 1}: ${decimals(from, 1)} to ${decimals(to, 1)} s, platform ${poseWords(plan.poses[platform])}`));
  };
  return svg('svg', {
    width, height: bottom + kBottom, viewBox: `0 0 ${width} ${bottom + kBottom}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `The tour over time: ${plan.views.length} views, ${pieces.filter((piece) => piece.kind === 'turn').length} turns of the platform. ${tourNote(plan)}`,
  },
  svg('defs', {}, svg('pattern', { id: 'turning', width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' }, svg('rect', { width: 6, height: 6, fill: 'var(--track)' }), svg('rect', { width: 2, height: 6, fill: 'var(--muted)' }))),
  ...x.ticks.flatMap((tick) => [svg('path', { d: `M${x.at(tick)} ${kTop}V${bottom}`, stroke: 'var(--grid)' }), text(tickText(tick), { x: x.at(tick), y: bottom + 14, 'text-anchor': 'middle' })]),
  text('time (s)', { x: (left + width - kRight) / 2, y: bottom + 30, 'text-anchor': 'middle' }),
  ...plan.poses.map((pose, p) => text(poseWords(pose), { x: left - 8, y: middle(p) + 4, 'text-anchor': 'end' })),
  ...pieces.map((piece) => {
    const wide = Math.max(0.5, x.at(piece.to) - x.at(piece.from));
    if (piece.kind === 'way') return svg('path', { d: `M${x.at(piece.from)} ${middle(piece.platform)}H${x.at(piece.to)}`, stroke: 'var(--muted)', 'stroke-width': 1.4 });
    if (piece.kind === 'view') return block(piece.view, piece.from, piece.to, piece.platform);
    const before = plan.views[piece.view - 1]?.platform ?? piece.platform;
    const [top, low] = [Math.min(y(before), y(piece.platform)), Math.max(y(before), y(piece.platform)) + kRow];
    return svg('rect', { x: x.at(piece.from), y: top, width: wide, height: low - top, fill: 'url(#turning)' }, svg('title', {}, `the platform turns to ${poseWords(plan.poses[piece.platform])}`));
  }));
}
