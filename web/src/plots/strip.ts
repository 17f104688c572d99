// SPDX-License-Identifier: Apache-2.0
import { colour, h } from '../dom';
import { nearestIndex, type Place, type Shared } from '../data/selection';
import { kPlotLeft, kPlotRight } from './plot';

const kRow = 18;
const kGap = 6;

/// A stretch of frames that is told by colour and by height: trouble is tallest.
export interface StripRun {
  first: number;   // index of a frame
  last: number;    // inclusive
  colour: string;  // a custom property of the style sheet
  height: number;  // share of the row
  quiet: boolean;  // may vanish where it is narrower than a pixel
}

export interface StripRow {
  label: string;
  runs: StripRun[];
}

export interface StripContent<S extends Place> {
  id: string;
  title: string;
  words: string;             // what it shows, for who does not see it
  rows: StripRow[];
  axis: number[];
  shared: Shared<S>;
  key: HTMLElement;
  point?: (row: number | null) => void;  // what the pointer is upon
}

/// Rows of stretches over the frames, linked with the plots.
export function stripView<S extends Place>({ id, title, words, rows, axis, shared, key, point }: StripContent<S>): { element: HTMLElement; redraw: () => void } {
  const canvas = h('canvas', { class: 'strip', role: 'img', 'aria-label': words });
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
    const box = over.getBoundingClientRect();
    point?.(Math.min(rows.length - 1, Math.max(0, Math.floor((event.clientY - box.top) / (kRow + kGap)))));
    shared.set({ frame: nearestIndex(axis, low + ((high - low) * (event.clientX - box.left)) / over.clientWidth) } as Partial<S>);
  });
  over.addEventListener('pointerleave', () => point?.(null));
  shared.watch((after, before) => (after.range === before.range ? showNow() : redraw()));
  const labels = h('div', { class: 'strip-labels', 'aria-hidden': 'true' }, ...rows.map((row) => h('span', { title: row.label }, row.label)));
  const element = h('figure', { class: 'figure', id: `figure-${id}` },
    h('figcaption', {}, h('span', { class: 'figure-title' }, title), key),
    h('div', { class: 'strip-holder' }, canvas, labels, over));
  return { element, redraw };
}

function draw(canvas: HTMLCanvasElement, width: number, rows: StripRow[], axis: number[], [low, high]: [number, number]): void {
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
    for (const run of row.runs) {
      const [from, to] = [x(edge(run.first)), x(edge(run.last + 1))];
      if (to <= kPlotLeft || from >= kPlotLeft + span) continue;
      context.fillStyle = colour(run.colour);
      // A single frame must stay visible among thousands.
      context.fillRect(from, bottom - kRow * run.height, Math.max(to - from, run.quiet ? 0 : 1.5), kRow * run.height);
    }
  });
}
