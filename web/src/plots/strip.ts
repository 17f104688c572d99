// SPDX-License-Identifier: Apache-2.0
import { colour, h } from '../dom';
import type { TrackingReport } from '../data/report';
import { axisOf, nearestIndex, type Shared } from '../data/selection';
import { kStatuses, runs, type Status } from '../data/status';
import { kPlotLeft, kPlotRight } from './plot';

const kRow = 18;
const kGap = 6;

interface Row {
  label: string;
  letters: string;
  body: number;
}

/// What became of each body in each frame: a row for what the frame measured, one for the filter. Status is
/// told by colour and by height.
export function statusStrip(report: TrackingReport, shared: Shared): { element: HTMLElement; redraw: () => void } {
  const rows = report.bodies.flatMap((body, i): Row[] => [
    { label: body.name, letters: body.status, body: i },
    ...(body.filtered_status && body.filtered_status !== body.status ? [{ label: 'filtered', letters: body.filtered_status, body: i }] : []),
  ]);
  const axis = axisOf(report.frames).values;
  const canvas = h('canvas', { class: 'strip', role: 'img', 'aria-label': `Status of each body over time. ${rows.map((row) => `${row.label}: ${spoken(row.letters)}`).join('. ')}` });
  const now = h('div', { class: 'now' });
  const over = h('div', { class: 'strip-over', style: `left:${kPlotLeft}px;right:${kPlotRight}px` }, now);
  const range = (): [number, number] => shared.now.range ?? [axis[0], axis[axis.length - 1]];

  const redraw = () => {
    const width = canvas.parentElement?.clientWidth ?? 0;
    if (width > 0) draw(canvas, width, rows, axis, range());
    showNow();
  };
  const showNow = () => {
    const [low, high] = range();
    const part = (axis[shared.now.frame] - low) / (high - low || 1);
    now.style.left = `${part * 100}%`;
    now.style.display = part < 0 || part > 1 ? 'none' : '';
  };
  over.addEventListener('pointermove', (event) => {
    const [low, high] = range();
    shared.set({ frame: nearestIndex(axis, low + ((high - low) * event.offsetX) / over.clientWidth) });
  });
  shared.watch((after, before) => (after.range === before.range ? showNow() : redraw()));
  const labels = h('div', { class: 'strip-labels', 'aria-hidden': 'true' }, ...rows.map((row) => h('span', { title: row.label }, row.label)));
  const element = h('figure', { class: 'figure', id: 'figure-status' },
    h('figcaption', {}, h('span', { class: 'figure-title' }, 'Status by body'), statusKey()),
    h('div', { class: 'strip-holder' }, canvas, labels, over));
  return { element, redraw };
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

function draw(canvas: HTMLCanvasElement, width: number, rows: Row[], axis: number[], [low, high]: [number, number]): void {
  const height = rows.length * (kRow + kGap);
  const ratio = window.devicePixelRatio || 1;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext('2d')!;
  context.scale(ratio, ratio);
  const span = width - kPlotLeft - kPlotRight;
  const x = (value: number) => kPlotLeft + Math.min(1, Math.max(0, (value - low) / (high - low || 1))) * span;
  const edge = (i: number) => (i <= 0 ? axis[0] : i >= axis.length ? axis[axis.length - 1] : 0.5 * (axis[i - 1] + axis[i]));
  rows.forEach((row, r) => {
    const bottom = r * (kRow + kGap) + kRow;
    context.fillStyle = colour('--track');
    context.fillRect(kPlotLeft, bottom - kRow, span, kRow);
    for (const run of runs(row.letters)) {
      const words = kStatuses[run.status];
      const [from, to] = [x(edge(run.first)), x(edge(run.last + 1))];
      if (to <= kPlotLeft || from >= kPlotLeft + span) continue;
      context.fillStyle = colour(words.colour);
      // A single frame must stay visible among thousands.
      context.fillRect(from, bottom - kRow * words.height, Math.max(to - from, run.status === 'O' ? 0 : 1.5), kRow * words.height);
    }
  });
}
