// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { bestIn, compare, holds, measureText, type LayoutReport } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import type { Shared } from '../data/selection';
import { download, h } from '../dom';
import { valueText } from '../plots/layout_marks';

interface Order {
  measure: number | null;  // null = as written
  worseFirst: boolean;
}

/// All layouts with all measures; a heading orders by it, a name chooses the layout.
export function layoutTable(report: LayoutReport, shared: Shared<LayoutSelection>): HTMLElement {
  const best = report.measures.map((measure, m) => (measure.better === 'none' ? null : bestIn(report, m)));
  const rows = report.layouts.map((_, i) => rowOf(report, shared, i, best));
  const body = h('tbody');
  const heads = report.measures.map((measure, m) => h('th', { scope: 'col', class: 'number' },
    h('button', { type: 'button', class: measure.objective ? 'sort objective' : 'sort', title: measure.objective ? 'An objective. Order by it' : 'Order by it', onclick: () => sort(m) }, measureText(measure))));
  let order: Order = { measure: null, worseFirst: false };
  const sort = (measure: number) => {
    order = { measure, worseFirst: order.measure === measure && !order.worseFirst };
    const value = (i: number) => report.layouts[i].values[measure];
    const places = report.layouts.map((_, i) => i).sort((a, b) => {
      const [va, vb] = [value(a), value(b)];
      if (va === null || vb === null) return Number(va === null) - Number(vb === null);
      return (order.worseFirst ? -1 : 1) * compare(report.measures[measure], va, vb);
    });
    body.replaceChildren(...places.map((i) => rows[i]));
    heads.forEach((head, m) => head.setAttribute('aria-sort', m !== measure ? 'none' : order.worseFirst ? 'descending' : 'ascending'));
  };
  const show = () => rows.forEach((row, i) => {
    row.classList.toggle('active', i === shared.now.layout);
    row.querySelector('button')!.setAttribute('aria-pressed', String(i === shared.now.layout));
  });
  body.append(...rows);
  shared.watch(show);
  show();
  return h('section', { 'aria-labelledby': 'layouts', class: 'panel' },
    h('div', { class: 'bar-row' }, h('h2', { id: 'layouts' }, 'Layouts'),
      h('span', { class: 'exports' }, h('button', { type: 'button', title: 'Save every layout with all measures', onclick: () => download('layouts.csv', new Blob([tableAsCsv(report)], { type: 'text/csv' })) }, 'CSV'))),
    h('p', { class: 'note' }, 'Underlined headings are the objectives. ', h('b', {}, 'Bold'), ': the best of the layouts found that hold all constraints (of the given ones where none was searched for). A heading orders by its measure, once more turns the order round.'),
    h('div', { class: 'scroll tall wide-table', tabindex: 0, role: 'region', 'aria-label': 'Layouts' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, 'Layout'), h('th', { scope: 'col' }, 'From'), ...heads, h('th', { scope: 'col' }, 'Constraints'))),
      body)));
}

function rowOf(report: LayoutReport, shared: Shared<LayoutSelection>, i: number, best: (number | null)[]): HTMLElement {
  const layout = report.layouts[i];
  const cells = report.measures.map((measure, m) => h('td', { class: best[m] === i ? 'number best' : 'number' }, valueText({ ...measure, unit: '' }, layout.values[m])));
  return h('tr', { class: i === report.knee ? 'knee' : '' },
    h('th', { scope: 'row' },
      h('button', { type: 'button', class: 'link', title: 'Show this layout', onclick: () => shared.set({ layout: i }) }, layout.name),
      i === report.knee && h('span', { class: 'tag' }, 'knee')),
    h('td', { class: 'none' }, layout.origin), ...cells,
    h('td', { class: holds(layout) ? '' : 'flagged' }, holds(layout) ? 'all hold' : layout.fails.join('; ')));
}

export function tableAsCsv(report: LayoutReport): string {
  return csv(['layout', 'origin', 'knee', ...report.measures.map((measure) => (measure.unit ? `${measure.name}_${measure.unit}` : measure.name)), 'fails'],
    report.layouts.map((layout, i) => [layout.name, layout.origin, i === report.knee ? 1 : 0, ...layout.values, layout.fails.join('; ')]));
}
