// SPDX-License-Identifier: Apache-2.0
import { measureText, objectivesOf, type LayoutReport } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import type { Shared } from '../data/selection';
import { h, svg } from '../dom';
import { drawingButtons } from './export';
import { inkOf, layoutWords, spanOf, valueText, wrapped } from './layout_marks';

const kHeight = 250;
const kTop = 62;
const kBottom = 26;
const kSide = 58;

/// Every layout as a line over all objectives; each axis has its better end on top. A line that lies above
/// another everywhere dominates it; lines that cross trade one for the other.
export function parallelView(report: LayoutReport, shared: Shared<LayoutSelection>): { element: HTMLElement; refresh: () => void } {
  const holder = h('div', { class: 'chart' });
  const element = h('figure', { class: 'figure', id: 'figure-parallel' },
    h('figcaption', {}, h('span', { class: 'figure-title' }, 'All objectives side by side'), h('span', { class: 'unit' }, 'better is up'), drawingButtons('objectives', () => holder.querySelector('svg'))), holder);
  const refresh = () => {
    holder.replaceChildren(draw(report, shared, Math.max(320, holder.clientWidth || 640)));
  };
  shared.watch((now, before) => {
    if (now.layout !== before.layout || now.shade !== before.shade) refresh();
  });
  return { element, refresh };
}

function draw(report: LayoutReport, shared: Shared<LayoutSelection>, width: number): SVGSVGElement {
  const { now } = shared;
  const measures = objectivesOf(report);
  const x = (k: number) => kSide + (k * (width - 2 * kSide)) / Math.max(1, measures.length - 1);
  const y = (k: number, value: number) => {
    const [low, high] = spanOf(report, measures[k]);
    const part = high > low ? Math.min(1, Math.max(0, (value - low) / (high - low))) : 0.5;
    const up = report.measures[measures[k]].better === 'more' ? part : 1 - part;
    return kHeight - kBottom - up * (kHeight - kTop - kBottom);
  };
  const lines = report.layouts.map((_, i) => i).sort((a, b) => Number(a === now.layout) - Number(b === now.layout)).map((i) => {
    const { values, reference } = report.layouts[i];
    const d = measures.map((m, k) => (values[m] === null ? '' : `${k === 0 || values[measures[k - 1]] === null ? 'M' : 'L'}${x(k)} ${y(k, values[m]!)}`)).join('');
    const chosen = i === now.layout;
    return svg('g', { class: 'pick', onclick: () => shared.set({ layout: i }) },
      svg('title', {}, layoutWords(report, i)),
      svg('path', { d, fill: 'none', stroke: 'transparent', 'stroke-width': 9 }),
      chosen && svg('path', { d, fill: 'none', stroke: 'var(--panel)', 'stroke-width': 6 }),
      svg('path', { d, fill: 'none', stroke: chosen ? 'var(--ink)' : inkOf(report, now, i), 'stroke-width': chosen ? 2.6 : 1.1, 'stroke-opacity': chosen ? 1 : 0.7, ...(reference ? { 'stroke-dasharray': '5 3' } : {}) }));
  });
  const letters = Math.max(9, Math.floor(((width - 2 * kSide) / Math.max(1, measures.length - 1)) / 6.4));
  const axes = measures.flatMap((m, k) => {
    const measure = report.measures[m];
    const [low, high] = spanOf(report, m);
    const ends = measure.better === 'more' ? [high, low] : [low, high];
    const label = wrapped(measureText(measure), letters).slice(0, 3);
    const text = (content: string, at: number, colour: string) => svg('text', { x: x(k), y: at, 'text-anchor': 'middle', fill: colour, stroke: 'var(--panel)', 'stroke-width': 3, 'paint-order': 'stroke' }, content);
    return [
      svg('path', { d: `M${x(k)} ${kTop}V${kHeight - kBottom}`, stroke: 'var(--line)', 'stroke-width': 1.4 }),
      ...label.map((line, i) => text(line, 12 + 13 * (3 - label.length + i), 'var(--muted)')),
      text(valueText({ ...measure, unit: '' }, ends[0]), kTop - 6, 'var(--ink)'), text(valueText({ ...measure, unit: '' }, ends[1]), kHeight - kBottom + 15, 'var(--ink)'),
    ];
  });
  return svg('svg', { width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif', 'aria-label': `Every layout over ${measures.length} objectives; the table below holds the same numbers` }, ...lines, ...axes);
}
