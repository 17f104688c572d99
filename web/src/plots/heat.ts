// SPDX-License-Identifier: Apache-2.0
import type { CellHeat } from '../data/cell_report';
import { csv } from '../data/csv';
import { significant } from '../data/format';
import { present } from '../data/statistics';
import { download, h, svg } from '../dom';
import { drawingButtons } from './export';
import { ramp, kRampStops } from './ramp';
import { ticks, tickText } from './svg';

const kWidth = 460;
const kHeight = 400;
const kLeft = 58;
const kTop = 12;
const kBottom = 50;
const kRight = 92;  // the colour bar with its numbers
const kBar = 14;

/// Values over two axes as coloured cells; what a cell holds is told when pointed at, and in the CSV.
export function heatView(heat: CellHeat, index: number): HTMLElement {
  const words = h('p', { class: 'note', 'aria-live': 'polite' });
  const drawing = draw(heat, index, (text) => (words.textContent = text ?? overview(heat)));
  words.textContent = overview(heat);
  const name = `heat-${index + 1}`;
  const buttons = drawingButtons(name, () => drawing);
  buttons.prepend(h('button', { type: 'button', title: 'Save the values', onclick: () => download(`${name}.csv`, new Blob([heatAsCsv(heat)], { type: 'text/csv' })) }, 'CSV'));
  return h('figure', { class: 'figure heat', id: `figure-${name}` },
    h('figcaption', {}, h('span', { class: 'figure-title' }, heat.title), buttons), h('div', { class: 'chart' }, drawing), words);
}

export function heatAsCsv(heat: CellHeat): string {
  return csv([heat.x_label, heat.y_label, heat.value_label], heat.y.flatMap((y, j) => heat.x.map((x, i) => [x, y, heat.value[j][i]])));
}

/// Borders of the cells about their middles.
export function bordersAbout(middles: number[]): number[] {
  if (middles.length < 2) return [(middles[0] ?? 0) - 0.5, (middles[0] ?? 0) + 0.5];
  const inner = middles.slice(1).map((value, i) => 0.5 * (value + middles[i]));
  const last = middles.length - 1;
  return [2 * middles[0] - inner[0], ...inner, 2 * middles[last] - inner[last - 1]];
}

function rangeOf(heat: CellHeat): [number, number] | null {
  const values = present(heat.value.flat());
  return values.length > 0 ? [Math.min(...values), Math.max(...values)] : null;
}

function told(value: number): string {
  return Number.isInteger(value) ? tickText(value) : significant(value, 3);
}

function overview(heat: CellHeat): string {
  const range = rangeOf(heat);
  if (!range) return 'nothing is determined anywhere';
  const none = heat.value.flat().filter((value) => value === null).length;
  return `${heat.value_label}: ${told(range[0])} to ${told(range[1])}${none > 0 ? `; hatched: not determined, in ${none} of ${heat.x.length * heat.y.length} cells` : ''}`;
}

function draw(heat: CellHeat, index: number, tell: (text: string | null) => void): SVGSVGElement {
  const [low, high] = rangeOf(heat) ?? [0, 1];
  const [xs, ys] = [bordersAbout(heat.x), bordersAbout(heat.y)];
  const x = (value: number) => kLeft + ((value - xs[0]) / (xs[xs.length - 1] - xs[0])) * (kWidth - kLeft - kRight);
  const y = (value: number) => kHeight - kBottom - ((value - ys[0]) / (ys[ys.length - 1] - ys[0])) * (kHeight - kTop - kBottom);
  const hatch = `hatch-${index}`;
  const cells = heat.y.flatMap((pitch, j) => heat.x.map((roll, i) => {
    const value = heat.value[j][i];
    const words = `${heat.x_label} ${tickText(roll)}, ${heat.y_label} ${tickText(pitch)}: ${value === null ? 'not determined' : `${told(value)}, ${heat.value_label}`}`;
    return svg('rect', {
      x: x(xs[i]), y: y(ys[j + 1]), width: x(xs[i + 1]) - x(xs[i]) + 0.4, height: y(ys[j]) - y(ys[j + 1]) + 0.4, 'shape-rendering': 'crispEdges',
      fill: value === null ? `url(#${hatch})` : ramp(high > low ? (value - low) / (high - low) : 0.5), onpointerenter: () => tell(words),
    });
  }));
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const inside = (values: number[], borders: number[]) => values.filter((value) => value >= borders[0] && value <= borders[borders.length - 1]);
  return svg('svg', {
    width: kWidth, height: kHeight, viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `${heat.title} over ${heat.x_label} and ${heat.y_label}: ${overview(heat)}`, onpointerleave: () => tell(null),
  },
  svg('defs', {},
    svg('pattern', { id: hatch, width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' }, svg('rect', { width: 6, height: 6, fill: 'var(--track)' }), svg('rect', { width: 2, height: 6, fill: 'var(--hidden)' })),
    svg('linearGradient', { id: `ramp-${index}`, x1: 0, y1: 1, x2: 0, y2: 0 }, ...kRampStops.map((stop, i) => svg('stop', { offset: i / (kRampStops.length - 1), 'stop-color': stop })))),
  ...cells,
  ...inside(ticks(heat.x[0], heat.x[heat.x.length - 1]), xs).map((tick) => text(tickText(tick), { x: x(tick), y: kHeight - kBottom + 16, 'text-anchor': 'middle' })),
  ...inside(ticks(heat.y[0], heat.y[heat.y.length - 1]), ys).map((tick) => text(tickText(tick), { x: kLeft - 7, y: y(tick) + 4, 'text-anchor': 'end' })),
  text(heat.x_label, { x: (kLeft + kWidth - kRight) / 2, y: kHeight - 14, 'text-anchor': 'middle' }),
  text(heat.y_label, { transform: `translate(14 ${(kTop + kHeight - kBottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' }),
  ...colourBar(heat, index, low, high));
}

function colourBar(heat: CellHeat, index: number, low: number, high: number): SVGElement[] {
  const left = kWidth - kRight + 18;
  const at = (value: number) => kHeight - kBottom - (high > low ? (value - low) / (high - low) : 0.5) * (kHeight - kTop - kBottom);
  const whole = present(heat.value.flat()).every(Number.isInteger);
  const marks = ticks(low, high).filter((tick) => !whole || Number.isInteger(tick));
  return [
    svg('rect', { x: left, y: kTop, width: kBar, height: kHeight - kTop - kBottom, fill: `url(#ramp-${index})`, stroke: 'var(--line)' }),
    ...marks.flatMap((tick) => [
      svg('path', { d: `M${left + kBar} ${at(tick)}h4`, stroke: 'var(--muted)' }),
      svg('text', { x: left + kBar + 8, y: at(tick) + 4, fill: 'var(--muted)' }, tickText(tick))]),
    svg('text', { transform: `translate(${kWidth - 8} ${(kTop + kHeight - kBottom) / 2}) rotate(-90)`, 'text-anchor': 'middle', fill: 'var(--muted)' }, heat.value_label),
  ];
}
