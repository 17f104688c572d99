// SPDX-License-Identifier: Apache-2.0
import { decimals, percent } from '../data/format';
import { holds, sacrifices, type Layout, type LayoutReport, type Sacrifice } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import type { Vec3 } from '../data/parts';
import type { Shared } from '../data/selection';
import { download, h } from '../dom';
import { valueText } from '../plots/layout_marks';

/// The chosen layout: why it may be the one to take, what it gives up, what it breaks, its targets.
export function chosenPanel(report: LayoutReport, shared: Shared<LayoutSelection>): HTMLElement {
  const content = h('div');
  const show = () => content.replaceChildren(...partsOf(report, shared));
  shared.watch((now, before) => {
    if (now.layout !== before.layout || now.against !== before.against) show();
  });
  show();
  return h('section', { class: 'panel chosen', 'aria-label': 'The chosen layout' }, content);
}

function partsOf(report: LayoutReport, shared: Shared<LayoutSelection>): HTMLElement[] {
  const { layout: i, against } = shared.now;
  const layout = report.layouts[i];
  const knee = i === report.knee;
  const other = against !== null && against !== i ? report.layouts[against] : null;
  const parts: (HTMLElement | false)[] = [
    h('h2', {}, layout.name, knee && h('span', { class: 'tag' }, 'knee'), h('small', {}, ` ${layout.targets.length} targets · ${layout.origin}`)),
    knee && report.why !== '' && h('p', { class: 'why' }, report.why),
    !holds(layout) && h('p', { class: 'flagged' }, `Breaks a constraint: ${layout.fails.join('; ')}.`),
    h('div', { class: 'scroll' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ...['Objective', layout.name, ...(other ? [other.name] : []), 'Best to be had', 'Given up', 'in'].map((head, k) => h('th', { scope: 'col', class: k > 0 && head !== 'in' ? 'number' : '' }, head)))),
      h('tbody', {}, ...sacrifices(report, i).map((sacrifice) => line(report, shared, sacrifice, other))))),
    layout.notes.length > 0 && h('ul', { class: 'reading' }, ...layout.notes.map((note) => h('li', {}, note))),
    h('details', {}, h('summary', {}, h('h2', {}, `Its targets on ${report.body}`)), targetTable(report, layout)),
  ];
  return parts.filter((part): part is HTMLElement => part !== false);
}

function line(report: LayoutReport, shared: Shared<LayoutSelection>, { measure: m, value, best, lost, share }: Sacrifice, other: Layout | null): HTMLElement {
  const measure = report.measures[m];
  const cell = (text: string) => h('td', { class: 'number' }, text);
  const given = lost === null ? '–' : lost <= 0 ? (lost < 0 ? 'nothing: better still' : 'nothing: it is the best')
    : `${valueText(measure, lost)}${share !== null && share < 10 ? ` (${percent(share)} %)` : ''}`;
  return h('tr', {}, h('th', { scope: 'row' }, measure.label), cell(valueText(measure, value)), other && cell(valueText(measure, other.values[m])),
    cell(best === null ? '–' : valueText(measure, report.layouts[best].values[m])), cell(given),
    h('td', {}, best !== null && h('button', { type: 'button', class: 'link', onclick: () => shared.set({ layout: best }) }, report.layouts[best].name)));
}

function targetTable(report: LayoutReport, layout: Layout): HTMLElement {
  const numbers = (v: Vec3 | undefined, places: number) => (v ?? [null, null, null]).map((value) => h('td', { class: 'number' }, decimals(value, places)));
  const share = (i: number, codes: string[]) => {
    const letters = layout.seen[i] ?? '';
    return letters.length > 0 ? percent([...letters].filter((code) => codes.includes(code)).length / letters.length) : '–';
  };
  return h('div', {},
    h('div', { class: 'scroll' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ...['Target', 'x', 'y', 'z (mm)', 'normal x', 'y', 'z', 'Seen by both (%)', 'by one (%)'].map((head, k) => h('th', { scope: 'col', class: k > 0 ? 'number' : '' }, head)))),
      h('tbody', {}, ...layout.targets.map((target, i) => h('tr', {}, h('th', { scope: 'row' }, target.id), ...numbers(target.position_mm, 1), ...numbers(target.normal, 3),
        h('td', { class: 'number' }, share(i, ['3'])), h('td', { class: 'number' }, share(i, ['1', '2']))))))),
    h('p', {}, h('button', { type: 'button', onclick: () => download('bodies.toml', new Blob([bodyAsToml(report.body, layout)], { type: 'text/plain' })) }, 'Save as bodies.toml')));
}

export function bodyAsToml(body: string, layout: Layout): string {
  const list = (v: Vec3) => `[${v.map((value) => String(value)).join(', ')}]`;
  const targets = layout.targets.map((target) => [
    '[[body.target]]', `id = ${JSON.stringify(target.id)}`, `position_mm = ${list(target.position_mm)}`,
    ...(target.normal ? [`normal = ${list(target.normal)}`] : []), ...(target.diameter_mm ? [`diameter_mm = ${target.diameter_mm}`] : []),
  ].join('\n'));
  return [`[[body]]\nname = ${JSON.stringify(body)}`, ...targets].join('\n\n') + '\n';
}
