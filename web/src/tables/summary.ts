// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';
import type { SummaryRow } from '../data/parts';

export const kVerdictWords = { plain: '', good: 'good', attention: 'look at this', bad: 'bad' } as const;

/// What was found and how sure, then what to beware of: the first thing a reader sees. `nothing` is said
/// where there are no remarks.
export function summarySection(summary: SummaryRow[], remarks: string[], title: string, nothing: string): HTMLElement {
  const rows = summary.map((row) => h('tr', { class: row.verdict },
    h('th', { scope: 'row' }, row.label),
    h('td', { class: 'number' }, row.value),
    h('td', { class: 'unit' }, row.unit),
    h('td', {}, kVerdictWords[row.verdict] && h('span', { class: 'verdict' }, kVerdictWords[row.verdict]), row.note)));
  return h('section', { 'aria-labelledby': 'summary', class: 'summary' },
    h('div', { class: 'panel' }, h('h2', { id: 'summary' }, 'Summary'),
      rows.length > 0 ? h('table', { class: 'summary-table' },
        h('thead', { class: 'unseen' }, h('tr', {}, ...['Quantity', 'Value', 'Unit', 'Meaning'].map((text) => h('th', { scope: 'col' }, text)))),
        h('tbody', {}, ...rows)) : h('p', {}, 'No summary was given.')),
    h('div', { class: 'panel remarks' }, h('h2', {}, title),
      remarks.length > 0 ? h('ul', {}, ...remarks.map((remark) => h('li', {}, remark))) : h('p', {}, nothing)));
}
