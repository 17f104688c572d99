// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';
import { remarksOf } from '../data/remarks';
import type { TrackingReport } from '../data/report';

const kVerdictWords = { plain: '', good: 'good', attention: 'look at this', bad: 'bad' } as const;

/// What was measured and how sure, then what went wrong: the first thing a reader sees.
export function summarySection(report: TrackingReport): HTMLElement {
  const rows = report.summary.map((row) => h('tr', { class: row.verdict },
    h('th', { scope: 'row' }, row.label),
    h('td', { class: 'number' }, row.value),
    h('td', { class: 'unit' }, row.unit),
    h('td', {}, kVerdictWords[row.verdict] && h('span', { class: 'verdict' }, kVerdictWords[row.verdict]), row.note)));
  const words = remarksOf(report);
  const remarks = words.length > 0
    ? h('ul', {}, ...words.map((remark) => h('li', {}, remark)))
    : h('p', {}, report.frames.frame.length > 0 ? 'Nothing: every body was OK in every frame.' : 'There are no frames.');
  return h('section', { 'aria-labelledby': 'summary', class: 'summary' },
    h('div', { class: 'panel' }, h('h2', { id: 'summary' }, 'Summary'),
      rows.length > 0 ? h('table', { class: 'summary-table' },
        h('thead', { class: 'unseen' }, h('tr', {}, ...['Quantity', 'Value', 'Unit', 'Meaning'].map((text) => h('th', { scope: 'col' }, text)))),
        h('tbody', {}, ...rows)) : h('p', {}, 'No summary was given.')),
    h('div', { class: 'panel remarks' }, h('h2', {}, 'What went wrong'), remarks));
}
