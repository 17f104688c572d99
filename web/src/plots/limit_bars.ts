// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { percent } from '../data/format';
import { areaText } from '../data/scan';
import type { ScanPlan } from '../data/scan_report';
import { svg } from '../dom';

const [kRight, kRow] = [120, 22];
const kLetter = 6.4;  // px, about, of the names

export function limitsAsCsv(plan: ScanPlan): string {
  return csv(['limit', 'area_mm2', 'share_of_surface'], plan.limits.map(({ limit, area_mm2 }) => [limit, area_mm2, area_mm2 / plan.surface_mm2]));
}

/// How much more could be measured without each limit, the costliest first.
export function limitBars(plan: ScanPlan, width: number): SVGSVGElement {
  const limits = [...plan.limits].sort((a, b) => b.area_mm2 - a.area_mm2);
  const most = Math.max(...limits.map((limit) => limit.area_mm2), 1e-9);
  const left = 16 + kLetter * Math.max(8, ...limits.map(({ limit }) => limit.length));
  const height = limits.length * kRow + 4;
  const told = (area: number) => (area > 0 ? `${percent(area / plan.surface_mm2)} %, ${areaText(area)}` : 'nothing');
  return svg('svg', {
    width, height, viewBox: `0 0 ${width} ${height}`, role: 'img', 'font-size': 11.5, 'font-family': 'system-ui, sans-serif',
    'aria-label': `What each limit costs: ${limits.map(({ limit, area_mm2 }) => `${limit} ${told(area_mm2)}`).join('; ')}`,
  },
  ...limits.map(({ limit, area_mm2 }, i) => {
    const wide = (Math.max(0, area_mm2) / most) * (width - left - kRight);
    const y = i * kRow + 4;
    return svg('g', {},
      svg('text', { x: left - 8, y: y + 13, 'text-anchor': 'end', fill: 'var(--ink)' }, limit),
      svg('rect', { x: left, y: y + 2, width: Math.max(area_mm2 > 0 ? 1.5 : 0.5, wide), height: kRow - 8, fill: 'var(--body-2)' }),
      svg('text', { x: left + wide + 6, y: y + 13, fill: 'var(--muted)' }, told(area_mm2)));
  }));
}
