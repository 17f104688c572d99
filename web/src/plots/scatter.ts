// SPDX-License-Identifier: Apache-2.0
import { frontOf, holds, measureText, type LayoutReport, type Measure } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import type { Shared } from '../data/selection';
import { h, svg } from '../dom';
import { drawingButtons } from './export';
import { formOf, inkOf, layoutWords, pathOf, spanOf, valueText } from './layout_marks';
import { ramp, rampAsCss } from './ramp';
import { ticks, tickText } from './svg';

const kHeight = 400;
const kLeft = 66;
const kRight = 22;
const kTop = 18;
const kBottom = 48;
const kRadius = 5;

interface Axis {
  measure: Measure;
  at: (value: number) => number;
  inside: (value: number) => boolean;
  ticks: number[];
}

/// The layouts by two measures, a third told by colour. A click, or the arrow keys when the chart has the
/// focus, choose a layout.
export function scatterView(report: LayoutReport, shared: Shared<LayoutSelection>): { element: HTMLElement; refresh: () => void } {
  const holder = h('div', { class: 'chart' });
  const note = h('p', { class: 'note', 'aria-live': 'polite' });
  const key = h('div', { class: 'keys' });
  const exports = drawingButtons('pareto', () => holder.querySelector('svg'));
  const element = h('figure', { class: 'figure', id: 'figure-pareto' },
    h('figcaption', {}, h('span', { class: 'figure-title' }, 'Layouts by two measures'), exports), key, holder, note);
  const refresh = () => {
    const width = Math.max(320, holder.clientWidth || 640);
    const focused = holder.contains(document.activeElement);
    const drawing = draw(report, shared, width, note);
    holder.replaceChildren(drawing);
    if (focused) drawing.focus();
    key.replaceChildren(...keyOf(report, shared.now));
    note.textContent = chosenWords(report, shared.now);
  };
  shared.watch((now, before) => {
    if (now.layout !== before.layout || now.x !== before.x || now.y !== before.y || now.shade !== before.shade) refresh();
  });
  return { element, refresh };
}

function draw(report: LayoutReport, shared: Shared<LayoutSelection>, width: number, note: HTMLElement): SVGSVGElement {
  const { now } = shared;
  const x = axisOf(report, now.x, kLeft, width - kRight);
  const y = axisOf(report, now.y, kHeight - kBottom, kTop);
  const shown = report.layouts.map((_, i) => i).filter((i) => report.layouts[i].values[now.x] !== null && report.layouts[i].values[now.y] !== null);
  const place = (i: number): [number, number] => [x.at(report.layouts[i].values[now.x]!), y.at(report.layouts[i].values[now.y]!)];
  const order = [...shown].sort((a, b) => place(a)[0] - place(b)[0] || place(a)[1] - place(b)[1]);
  const step = (by: number) => {
    const next = order[Math.min(order.length - 1, Math.max(0, order.indexOf(now.layout) + by))];
    if (next !== undefined) shared.set({ layout: next });
  };
  const tell = (words: string) => {
    note.textContent = words;
  };
  // The chosen one and those with a name come last, so that nothing covers them.
  const rank = (i: number) => (i === now.layout ? 3 : i === report.knee ? 2 : report.layouts[i].reference ? 1 : 0);
  const ordered = [...shown].sort((a, b) => rank(a) - rank(b));
  const names = namesOf(report, now, [...ordered].reverse(), place, width);
  const inside = (i: number) => x.inside(report.layouts[i].values[now.x]!) && y.inside(report.layouts[i].values[now.y]!);
  const marks = ordered.map((i) => markOf(report, now, i, place(i), inside(i), {
    onclick: () => shared.set({ layout: i }),
    onpointerenter: () => tell(pointWords(report, now, i)),
    onpointerleave: () => tell(chosenWords(report, now)),
  }));
  return svg('svg', {
    width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, tabindex: 0, role: 'group', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `${shown.length} layouts by ${x.measure.label} and ${y.measure.label}. Left and right choose the neighbour. Now ${pointWords(report, now, now.layout)}`,
    onkeydown: (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1 }[(event as KeyboardEvent).key];
      if (by === undefined) return;
      event.preventDefault();
      step(by);
    },
  }, ...frameOf(x, y, width), staircase(report, now, shown, place), ...marks, ...names);
}

function axisOf(report: LayoutReport, index: number, from: number, to: number): Axis {
  const measure = report.measures[index];
  const [low, high] = spanOf(report, index);
  const room = (high - low || Math.abs(high) || 1) * 0.07;
  const [bottom, top] = [low - room, high + room];
  const whole = report.layouts.every((layout) => layout.values[index] === null || Number.isInteger(layout.values[index]));
  const at = (value: number) => from + ((Math.min(top, Math.max(bottom, value)) - bottom) / (top - bottom)) * (to - from);
  return {
    measure, at, inside: (value) => value >= bottom && value <= top,
    ticks: ticks(bottom, top).filter((tick) => !whole || Number.isInteger(tick)),
  };
}

function frameOf(x: Axis, y: Axis, width: number): SVGElement[] {
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const line = (d: string) => svg('path', { d, stroke: 'var(--grid)', fill: 'none' });
  const better = (measure: Measure) => (measure.better === 'none' ? '' : ` · ${measure.better} is better`);
  const middle = (kTop + kHeight - kBottom) / 2;
  return [
    ...x.ticks.flatMap((tick) => [line(`M${x.at(tick)} ${kTop}V${kHeight - kBottom}`), text(tickText(tick), { x: x.at(tick), y: kHeight - kBottom + 16, 'text-anchor': 'middle' })]),
    ...y.ticks.flatMap((tick) => [line(`M${kLeft} ${y.at(tick)}H${width - kRight}`), text(tickText(tick), { x: kLeft - 8, y: y.at(tick) + 4, 'text-anchor': 'end' })]),
    svg('path', { d: `M${kLeft} ${kTop}V${kHeight - kBottom}H${width - kRight}`, stroke: 'var(--line)', fill: 'none' }),
    text(measureText(x.measure) + better(x.measure), { x: (kLeft + width - kRight) / 2, y: kHeight - 10, 'text-anchor': 'middle' }),
    text(measureText(y.measure) + better(y.measure), { transform: `translate(14 ${middle}) rotate(-90)`, 'text-anchor': 'middle' }),
  ];
}

/// The border of what can be had in these two measures, among the layouts that hold all constraints.
function staircase(report: LayoutReport, now: LayoutSelection, shown: number[], place: (i: number) => [number, number]): SVGElement {
  const front = frontOf(report, shown.filter((i) => holds(report.layouts[i])), now.x, now.y).map(place);
  const d = front.map(([px, py], k) => (k === 0 ? `M${px} ${py}` : `H${px}V${py}`)).join('');
  return svg('path', { d, fill: 'none', stroke: 'var(--muted)', 'stroke-width': 1.2, 'stroke-dasharray': '3 3' });
}

function markOf(report: LayoutReport, now: LayoutSelection, i: number, [px, py]: [number, number], inside: boolean, handlers: Record<string, () => void>): SVGElement {
  const form = formOf(report, i);
  const ink = inkOf(report, now, i);
  const hollow = form !== 'disc';
  const mark = svg('path', {
    d: pathOf(form, px, py, kRadius), fill: hollow ? (form === 'diamond' ? 'var(--panel)' : 'none') : ink,
    stroke: hollow ? ink : 'var(--ink)', 'stroke-width': hollow ? 2 : 0.6, 'stroke-opacity': hollow ? 1 : 0.55,
  });
  // What lies outside stands at the edge, faint.
  return svg('g', { class: 'pick', opacity: inside ? 1 : 0.4, ...handlers },
    svg('circle', { cx: px, cy: py, r: 11, fill: 'transparent' }),
    i === now.layout && svg('circle', { cx: px, cy: py, r: kRadius + 5, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 2 }),
    mark);
}

/// Names of the knee, the chosen and the given layouts, as far as they do not cover an earlier one.
function namesOf(report: LayoutReport, now: LayoutSelection, order: number[], place: (i: number) => [number, number], width: number): SVGElement[] {
  const written: { left: number; right: number; y: number }[] = [];
  return order.flatMap((i) => {
    const { name, reference } = report.layouts[i];
    if (i !== report.knee && i !== now.layout && !reference) return [];
    const text = i === report.knee ? `knee: ${name}` : name;
    const [px, py] = place(i);
    const length = 6.2 * text.length;
    const left = px + 12 + length > width ? px - 12 - length : px + 12;
    const box = { left, right: left + length, y: py - 8 };
    if (written.some((other) => Math.abs(other.y - box.y) < 13 && box.left < other.right && other.left < box.right)) return [];
    written.push(box);
    return [svg('text', { x: left, y: box.y, fill: 'var(--ink)', 'font-weight': i === report.knee ? 600 : 400, stroke: 'var(--panel)', 'stroke-width': 3, 'paint-order': 'stroke', 'pointer-events': 'none' }, text)];
  });
}

function keyOf(report: LayoutReport, now: LayoutSelection): HTMLElement[] {
  const mark = (form: 'disc' | 'diamond' | 'cross', ink: string, text: string) => h('span', { class: 'key' },
    svg('svg', { width: 14, height: 14, 'aria-hidden': 'true' }, svg('path', { d: pathOf(form, 7, 7, 4.4), fill: form === 'disc' ? ink : 'none', stroke: ink, 'stroke-width': 1.8 })), text);
  const items = [mark('disc', now.shade === null ? 'var(--accent)' : ramp(0.5), 'found')];
  if (report.layouts.some((layout) => layout.reference)) items.push(mark('diamond', 'var(--body-2)', 'given'));
  if (report.layouts.some((layout) => !holds(layout))) items.push(mark('cross', 'var(--body-2)', 'breaks a constraint'));
  items.push(h('span', { class: 'key dashed', style: '--key: var(--muted)' }, h('i'), 'best that can be had in these two'));
  if (now.shade !== null) {
    const measure = report.measures[now.shade];
    const [low, high] = spanOf(report, now.shade);
    items.push(h('span', { class: 'key ramp' }, `${measure.label} `, valueText({ ...measure, unit: '' }, low), h('i', { style: `background: ${rampAsCss()}` }), valueText(measure, high)));
  }
  return items;
}

function pointWords(report: LayoutReport, now: LayoutSelection, i: number): string {
  const of = (m: number) => `${report.measures[m].label} ${valueText(report.measures[m], report.layouts[i].values[m])}`;
  const measures = [...new Set([now.x, now.y, ...(now.shade === null ? [] : [now.shade])])];
  return `${layoutWords(report, i)}: ${measures.map(of).join(' · ')}`;
}

function chosenWords(report: LayoutReport, now: LayoutSelection): string {
  const beyond = report.layouts.filter((layout) => [now.x, now.y].some((m) => {
    const value = layout.values[m];
    const [low, high] = spanOf(report, m);
    return layout.reference && (value === null || value < low - 0.1 * (high - low) || value > high + 0.1 * (high - low));
  }));
  const outside = beyond.length > 0 ? ` Outside the range shown: ${beyond.map((layout) => layout.name).join(', ')}.` : '';
  return `Chosen: ${pointWords(report, now, now.layout)}.${outside}`;
}
