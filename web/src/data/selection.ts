// SPDX-License-Identifier: Apache-2.0
export type Component = 'size' | 'x' | 'y' | 'z';
export type Source = 'measured' | 'filtered';

/// What the reader is looking at; every view shows the same.
export interface Selection {
  frame: number;                    // index into the frames
  body: number;
  component: Component;             // of the errors: size, or along one axis of the tracker
  source: Source;                   // which pose the 3-D view and the errors take
  range: [number, number] | null;   // of time shown (s); null = all
}

export type Change = (selection: Selection, before: Selection) => void;

export class Shared {
  private listeners: Change[] = [];

  constructor(private state: Selection) {}

  get now(): Selection {
    return this.state;
  }

  set(part: Partial<Selection>): void {
    const before = this.state;
    const after = { ...before, ...part };
    if ((Object.keys(part) as (keyof Selection)[]).every((key) => before[key] === after[key])) return;
    this.state = after;
    for (const listener of this.listeners) listener(after, before);
  }

  watch(listener: Change): void {
    this.listeners.push(listener);
  }
}

/// The index of the value nearest to `wanted` in an ordered list.
export function nearestIndex(ordered: number[], wanted: number): number {
  let low = 0;
  let high = ordered.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (ordered[middle] <= wanted) low = middle;
    else high = middle;
  }
  return Math.abs(ordered[high] - wanted) < Math.abs(wanted - ordered[low]) ? high : low;
}

/// Times when they rise from frame to frame, frame numbers or places otherwise: a plot's axis must rise.
export function axisOf(frames: { frame: number[]; time_s: number[] }): { label: string; values: number[] } {
  const rises = (values: number[]) => values.every((value, i) => Number.isFinite(value) && (i === 0 || value > values[i - 1]));
  if (rises(frames.time_s)) return { label: 'time (s)', values: frames.time_s };
  if (rises(frames.frame)) return { label: 'frame', values: frames.frame };
  return { label: 'frame, in order of the list', values: frames.frame.map((_, i) => i) };
}
