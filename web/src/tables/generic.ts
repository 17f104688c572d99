// SPDX-License-Identifier: Apache-2.0
import type { CellTable } from '../data/cell_report';
import { csv } from '../data/csv';
import { count, decimals, significant } from '../data/format';
import { download, h } from '../dom';
import { kVerdictWords } from './summary';

type Value = string | number | null;

/// How many decimals a column is written with: four digits that count, no more than any of its numbers has.
export function placesOf(column: Value[]): number {
  const lengths = column.filter((value): value is number => typeof value === 'number')
    .map((value) => String(Number(value.toPrecision(4)))).map((text) => (text.includes('e-') ? 9 : text.split('.')[1]?.length ?? 0));
  return Math.max(0, ...lengths);
}

/// Numbers of a column have their points under one another, unless that would take too many digits.
export function cellText(value: Value, places: number): string {
  if (value === null) return '–';
  if (typeof value === 'string') return value;
  if (places === 0) return value < 0 ? `\u2212${count(-value)}` : count(value);
  return places <= 5 ? decimals(value, places) : significant(value, 4).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
}

/// A table as it was written. A row's verdict is marked in the table's own column of that name, else in one of its own.
export function tableSection(table: CellTable): HTMLElement {
  const numeric = table.columns.map((_, k) => table.rows.some((row) => typeof row[k] === 'number'));
  const places = table.columns.map((_, k) => placesOf(table.rows.map((row) => row[k])));
  const marked = table.verdicts.some((verdict) => verdict !== 'plain');
  const own = table.columns.findIndex((column) => column.toLowerCase() === 'verdict');
  const mark = (i: number) => {
    const word = kVerdictWords[table.verdicts[i] ?? 'plain'];
    return word && h('span', { class: 'verdict' }, word);
  };
  const id = `table-of-${table.id}`;
  const cell = (value: Value, k: number, i: number) => h(k === 0 ? 'th' : 'td', { class: numeric[k] ? 'number' : '', ...(k === 0 ? { scope: 'row' } : {}) }, k === own && mark(i), cellText(value, places[k]));
  return h('section', { class: 'panel', 'aria-labelledby': id },
    h('div', { class: 'bar-row' }, h('h2', { id }, table.title),
      h('span', { class: 'exports' }, h('button', { type: 'button', title: 'Save the table', onclick: () => download(`${table.id}.csv`, new Blob([csv(table.columns, table.rows)], { type: 'text/csv' })) }, 'CSV'))),
    table.note !== '' && h('p', { class: 'note' }, table.note),
    h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': table.title }, h('table', { class: 'data generic' },
      h('thead', {}, h('tr', {}, ...table.columns.map((column, k) => h('th', { scope: 'col', class: numeric[k] ? 'number' : '' }, column)), marked && own < 0 && h('th', { scope: 'col' }, 'Verdict'))),
      h('tbody', {}, ...table.rows.map((row, i) => h('tr', { class: table.verdicts[i] ?? 'plain' },
        ...row.map((value, k) => cell(value, k, i)), marked && own < 0 && h('td', {}, mark(i))))))));
}
