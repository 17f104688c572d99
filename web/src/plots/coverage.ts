// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { count, percent } from '../data/format';
import { coverageLevels, coverageSteps } from '../data/scan';
import type { ScanPlan } from '../data/scan_report';
import { download, h, svg } from '../dom';
import { chartAxis } from './chart';
import { drawingButtons } from './export';
import { bodyColour } from './figures';
import { apart } from './spread';
import { tickText, ticks } from './svg';

const kHeight = 250;
const [kLeft, kRight, kTop, kBottom] = [48, 138, 22, 40];
const kNameWidth = 72;  // px, about, of a mark's name
const kMany = 40;       // views: their dots are smaller

export function coverageAsCsv(plan: ScanPlan): string {
  return csv(['views', 'share_of_surface', 'adds_mm2', 'platform_pose'], coverageSteps(plan).map((share, i) => [i, share, plan.views[i - 1]?.adds_mm2, plan.views[i - 1] && plan.views[i - 1].platform + 1]));
}

/// How much of the surface the views measure together, after each; what could be measured at all as levels; how few
/// views could do as a mark.
export function coveragePlot(plan: ScanPlan, width: number, chosen: number | null, choose: (view: number) => void): SVGSVGElement {
  const shares = coverageSteps(plan);
  const marks = [
    ...(plan.bound > 0 ? [{ text: plan.optimal ? `bound ${plan.bound}, reached` : `bound ${plan.bound}`, at: plan.bound, dash: '2 3' }] : []),
    ...(plan.greedy_views > 0 ? [{ text: `greedy ${plan.greedy_views}`, at: plan.greedy_views, dash: '5 3' }] : []),
  ];
  const most = Math.max(1, shares.length - 1, ...marks.map((mark) => mark.at));
  const x = chartAxis([0, most], false, kLeft, width - kRight, false);
  // A rescan begins where much is measured already: its axis begins below that.
  const foot = shares[0] > 0.5 ? Math.floor(10 * shares[0] - 0.5) / 10 : 0;
  const y = (share: number) => kHeight - kBottom - ((share - foot) / (1 - foot)) * (kHeight - kTop - kBottom);
  const text = (content: string, attributes: Record<string, string | number>) => svg('text', { fill: 'var(--muted)', ...attributes }, content);
  const levels = coverageLevels(plan).map((level) => ({ ...level, y: y(level.share) }));
  const last = shares[shares.length - 1];
  const named = [...levels.map((level) => ({ text: `${level.name} ${percent(level.share)} %`, y: level.y, ink: 'var(--flag)' })), { text: `this plan ${percent(last)} %`, y: y(last), ink: 'var(--ink)' }];
  const places = apart(named.map((name) => name.y), 14);
  const d = shares.map((share, i) => `${i === 0 ? 'M' : 'H'}${x.at(i).toFixed(1)}${i === 0 ? ' ' : 'V'}${y(share).toFixed(1)}`).join('');
  return svg('svg', {
    width, height: kHeight, viewBox: `0 0 ${width} ${kHeight}`, role: 'img', 'font-size': 11, 'font-family': 'system-ui, sans-serif',
    'aria-label': `Coverage against number of views: ${named.map((name) => name.text).join(', ')}. ${plan.in_words}`,
  },
  ...ticks(100 * foot, 100).map((tick) => tick / 100).flatMap((share) => [svg('path', { d: `M${kLeft} ${y(share)}H${width - kRight}`, stroke: 'var(--grid)' }), text(`${tickText(100 * share)} %`, { x: kLeft - 6, y: y(share) + 4, 'text-anchor': 'end' })]),
  ...ticks(0, most).filter(Number.isInteger).flatMap((tick) => [svg('path', { d: `M${x.at(tick)} ${kHeight - kBottom}v4`, stroke: 'var(--muted)' }), text(tickText(tick), { x: x.at(tick), y: kHeight - kBottom + 16, 'text-anchor': 'middle' })]),
  text('number of views', { x: (kLeft + width - kRight) / 2, y: kHeight - 6, 'text-anchor': 'middle' }),
  ...levels.map((level) => svg('path', { d: `M${kLeft} ${level.y}H${width - kRight}`, stroke: 'var(--flag)', 'stroke-dasharray': '6 4', fill: 'none' })),
  ...marks.map((mark, i) => svg('g', {},
    svg('path', { d: `M${x.at(mark.at)} ${kTop - 4}V${kHeight - kBottom}`, stroke: 'var(--muted)', 'stroke-dasharray': mark.dash }),
    text(mark.text, nameOf(marks.map((one) => x.at(one.at)), i, width)))),
  svg('path', { d, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.4 }),
  ...plan.views.map((view, i) => svg('circle', {
    cx: x.at(i + 1), cy: y(shares[i + 1]), r: i === chosen ? 5.5 : plan.views.length > kMany ? 2.5 : 3.4, class: 'pick', fill: i === chosen ? 'var(--lit)' : `var(${bodyColour(view.platform)})`, stroke: i === chosen ? 'var(--ink)' : 'none', onclick: () => choose(i),
  }, svg('title', {}, `view ${i + 1}: ${percent(shares[i + 1])} % of the surface`))),
  ...named.map((name, i) => svg('g', {},
    svg('path', { d: `M${width - kRight} ${name.y}L${width - kRight + 8} ${places[i]}`, stroke: name.ink, fill: 'none' }),
    text(name.text, { x: width - kRight + 11, y: places[i] + 4, fill: name.ink, ...(i === named.length - 1 ? { 'font-weight': 600 } : {}) }))));
}

/// Where the name of a mark stands: beside it, outside of what two marks enclose; a line lower where they would meet.
function nameOf(at: number[], i: number, width: number): Record<string, string | number> {
  const before = i === 0 && at.length > 1 ? at[0] - kLeft > kNameWidth : at[i] > width - kRight - 50;
  const meets = i === 1 && (before ? at[1] - at[0] < kNameWidth : at[0] - kLeft <= kNameWidth && at[1] - at[0] < kNameWidth);
  return { x: at[i] + (before ? -3 : 3), y: meets ? kTop + 14 : kTop - 8, 'text-anchor': before ? 'end' : 'start' };
}

export function coverageNote(plan: ScanPlan): string {
  const before = plan.covered_before_mm2 > 0 ? ` ${percent(plan.covered_before_mm2 / plan.surface_mm2)} % were measured before.` : '';
  return `${plan.in_words}; chosen from ${count(plan.candidates)} candidates.${before}`;
}

/// A figure that is drawn anew at each change, as wide as its place.
export function drawnFigure(id: string, title: string, draw: (width: number) => SVGSVGElement | null, note: () => string, save: () => string): { element: HTMLElement; refresh: () => void } {
  const holder = h('div', { class: 'chart' });
  const words = h('p', { class: 'note' });
  const buttons = drawingButtons(id, () => holder.querySelector('svg'));
  buttons.prepend(h('button', { type: 'button', title: 'Save the values', onclick: () => download(`${id}.csv`, new Blob([save()], { type: 'text/csv' })) }, 'CSV'));
  const element = h('figure', { class: 'figure', id: `figure-${id}` }, h('figcaption', {}, h('span', { class: 'figure-title' }, title), buttons), holder, words);
  const refresh = () => {
    const drawing = draw(Math.max(320, holder.clientWidth || 560));
    element.hidden = drawing === null;
    holder.replaceChildren(...(drawing ? [drawing] : []));
    words.textContent = drawing ? note() : '';
  };
  refresh();
  return { element, refresh };
}
