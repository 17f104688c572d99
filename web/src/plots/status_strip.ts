// SPDX-License-Identifier: Apache-2.0
import { h } from '../dom';
import type { Place, Shared } from '../data/selection';
import { kStatuses, runs, type Status } from '../data/status';
import { stripView } from './strip';

/// What became of something in each frame, a letter a frame.
export interface StatusRow {
  label: string;
  letters: string;
}

export function statusStrip<S extends Place>(title: string, rows: StatusRow[], axis: number[], shared: Shared<S>): { element: HTMLElement; redraw: () => void } {
  return stripView({
    id: 'status', title, axis, shared, key: statusKey(),
    words: `${title} over time. ${rows.map((row) => `${row.label}: ${spoken(row.letters)}`).join('. ')}`,
    rows: rows.map(({ label, letters }) => ({
      label, runs: runs(letters).map(({ status, first, last }) => ({ first, last, colour: kStatuses[status].colour, height: kStatuses[status].height, quiet: status === 'O' })),
    })),
  });
}

export function statusBadge(status: Status): HTMLElement {
  const { word, colour: name } = kStatuses[status];
  return h('span', { class: 'badge', style: `--key: var(${name})` }, h('i'), word);
}

function statusKey(): HTMLElement {
  return h('span', { class: 'status-key' }, ...Object.values(kStatuses).map(({ word, meaning, colour: name, height }) =>
    h('span', { class: 'key block', title: meaning, style: `--key: var(${name}); --tall: ${height}` }, h('i'), word)));
}

function spoken(letters: string): string {
  return Object.entries(kStatuses).map(([letter, { word }]) => {
    const frames = letters.split(letter).length - 1;
    return frames ? `${word} in ${frames} frames` : '';
  }).filter(Boolean).join(', ');
}
