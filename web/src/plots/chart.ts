// SPDX-License-Identifier: Apache-2.0
import type { CellChart } from '../data/cell_report';
import { csv } from '../data/csv';
import { significant } from '../data/format';
import { download, h, svg } from '../dom';
import { drawingButtons } from './export';
import { bodyColour } from './figures';
import { logRangeOf, rangeOf } from './ranges';
import { logTicks, ticks, tickText } from './svg';

const kHeight = 300;
const kLeft = 66;
const kRight = 18;
const kTop = 14;
const kBottom = 46;

type Curve = CellChart['curves'][number];

export interface ChartAxis {
  at: (value: number) => number;  // px
  shows: (value: number | null) => value is number;
  ticks: number[];
}

/// From `from` to `to` px; a logarithmic axis has no place for what is not above zero.
export function chartAxis(values: number[], log: boolean, from: number, to: number, room = true): ChartAxis {
  const known = values.filter((value) => Number.isFinite(value) && (!log || value > 0));
  const [least, most] = [Math.min(...known), Math.max(...known)];
  const tight = least < most && !room;
  const [low, high] = known.length === 0 ? (log ? [1, 10] : [0, 1]) : tight ? [least, most] : log ? logRangeOf(least, most) : rangeOf(least, most, least >= 0);
  const part = log ? (value: number) => Math.log(value / low) / Math.log(high / low) : (value: number) => (value - low) / (high - low);
  return {
    at: (value) => from + part(value) * (to - from), ticks: log ? logTicks(low, high) : ticks(low, high),
    shows: (value): value is number => value !== null && Number.isFinite(value) && (!log || value > 0),
  };
}

/// Curves over one axis with their bands and level lines.
export function chartView(chart: CellChart): { element: HTMLElement; refresh: () => void } {
  const holder = h('div', { class: 'chart' });
  const buttons = drawingButtons(chart.id, () => holder.querySelector('svg'));
  buttons.prepend(h('button', { type: 'button', title: 'Save the values', onclick: () => download(`${chart.id}.csv`, new Blob([chartAsCsv(chart)], { type: 'text/csv' })) }, 'CSV'));
  const element = h('figure', { class: 'figure chart-figure', id: `figure-${chart.id}` },
    h('figcaption', {}, h('span', { class: 'figure-title' }, chart.title), buttons),
    h('div', { class: 'keys' }, ...chart.curves.map((curve, i) => h('span', { class: `key${curve.dashed ? ' dashed' : ''}`, style: `--key: var(${bodyColour(i)})` }, h('i'), curve.name)),
      chart.curves.some((curve) => curve.low.length > 0) && h('span', { class: 'key band', style: '--key: var(--muted)' }, h('i'), '95 %')),
    holder, chart.note !== '' && h('p', { class: 'note' }, chart.note));
  const refresh = () => holder.replaceChildren(draw(chart, Math.max(320, holder.clientWidth || 560)));
  refresh();
  return { element, refresh };
}

export function chartAsCsv(chart: CellChart): string {
  return csv(['curve', chart.x_label, chart.y_label, 'low', 'high'],
    chart.curves.flatMap((curve) => curve.x.map((x, i) => [curve.name, x, curve.y[i], curve.low[i], curve.high[i]])));
}

function draw(chart: CellChart, width: number): SVGSVGElement {
  const x = chartAxis(chart.curves.flatMap((curve) => curve.x), chart.log_x, kLeft, width - kRight, false);
  const values = [...chart.curves.flatMap((curve) => [...curve.y, ...curve.low, ...curve.high]), ...chart.limits.map((limit) => limit.value)];
  const y = chartAxis(values.filter((value): value is number => value !== null), chart.log_y, kHeight - kBottom, kTop);
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const line = (d: string) => svg('path', { d, stroke: 'var(--grid)', fill: 'none' });
  return svg('svg', {
    width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `${chart.title}: ${chart.y_label} over ${chart.x_label}. ${chart.curves.map((curve) => curve.name).join(', ')}. ${chart.note}`,
  },
  ...x.ticks.flatMap((tick) => [line(`M${x.at(tick)} ${kTop}V${kHeight - kBottom}`), text(tickText(tick), { x: x.at(tick), y: kHeight - kBottom + 16, 'text-anchor': 'middle' })]),
  ...y.ticks.flatMap((tick) => [line(`M${kLeft} ${y.at(tick)}H${width - kRight}`), text(tickText(tick), { x: kLeft - 7, y: y.at(tick) + 4, 'text-anchor': 'end' })]),
  svg('path', { d: `M${kLeft} ${kTop}V${kHeight - kBottom}H${width - kRight}`, stroke: 'var(--line)', fill: 'none' }),
  text(chart.x_label, { x: (kLeft + width - kRight) / 2, y: kHeight - 10, 'text-anchor': 'middle' }),
  text(chart.y_label, { transform: `translate(14 ${(kTop + kHeight - kBottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' }),
  ...chart.curves.map((curve, i) => band(curve, x, y, bodyColour(i))),
  ...chart.limits.filter(({ value }) => y.shows(value)).flatMap(({ name, value }) => [
    svg('path', { d: `M${kLeft} ${y.at(value)}H${width - kRight}`, stroke: 'var(--flag)', 'stroke-dasharray': '6 4' }),
    text(name, { x: width - kRight - 4, y: y.at(value) - 4, 'text-anchor': 'end', fill: 'var(--flag)', stroke: 'var(--panel)', 'stroke-width': 3, 'paint-order': 'stroke' })]),
  ...chart.curves.flatMap((curve, i) => drawn(chart, curve, x, y, bodyColour(i))));
}

/// Pieces of a curve between which nothing is told.
function pieces(curve: Curve, shown: (i: number) => boolean): number[][] {
  const found: number[][] = [];
  let open: number[] | null = null;
  curve.x.forEach((_, i) => {
    if (!shown(i)) open = null;
    else if (open) open.push(i);
    else found.push((open = [i]));
  });
  return found;
}

function band(curve: Curve, x: ChartAxis, y: ChartAxis, colour: string): SVGElement {
  const d = pieces(curve, (i) => x.shows(curve.x[i]) && y.shows(curve.low[i] ?? null) && y.shows(curve.high[i] ?? null)).map((piece) => {
    const place = (i: number, side: 'low' | 'high') => `${x.at(curve.x[i]).toFixed(2)} ${y.at(curve[side][i]!).toFixed(2)}`;
    return `M${[...piece.map((i) => place(i, 'high')), ...[...piece].reverse().map((i) => place(i, 'low'))].join('L')}Z`;
  }).join('');
  return svg('path', { d, fill: `var(${colour})`, 'fill-opacity': 0.16, stroke: 'none' });
}

function drawn(chart: CellChart, curve: Curve, x: ChartAxis, y: ChartAxis, colour: string): SVGElement[] {
  const place = (i: number) => [x.at(curve.x[i]), y.at(curve.y[i]!)];
  const parts = pieces(curve, (i) => x.shows(curve.x[i]) && y.shows(curve.y[i]));
  const d = parts.map((piece) => `M${piece.map((i) => place(i).map((v) => v.toFixed(2)).join(' ')).join('L')}`).join('');
  const dots = curve.x.length <= 60 ? parts.flat() : [];
  return [
    svg('path', { d, fill: 'none', stroke: `var(${colour})`, 'stroke-width': 1.6, ...(curve.dashed ? { 'stroke-dasharray': '5 3' } : {}) }),
    ...dots.map((i) => svg('circle', { cx: place(i)[0], cy: place(i)[1], r: 3, fill: `var(${colour})` },
      svg('title', {}, `${curve.name}: ${chart.x_label} ${tickText(curve.x[i])}, ${chart.y_label} ${significant(curve.y[i], 4)}`))),
  ];
}
