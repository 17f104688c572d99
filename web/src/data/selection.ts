// SPDX-License-Identifier: Apache-2.0
export type Component = 'size' | 'x' | 'y' | 'z';
export type Source = 'measured' | 'filtered';

/// Where the reader is along a plot's axis.
export interface Place {
  frame: number;                    // index into the frames
  range: [number, number] | null;   // of the axis shown; null = all
}

/// What the reader is looking at; every view shows the same.
export interface Selection extends Place {
  body: number;
  component: Component;             // of the errors: size, or along one axis of the tracker
  source: Source;                   // which pose the 3-D view and the errors take
}

export type Change<S> = (now: S, before: S) => void;

export class Shared<S extends Place = Selection> {
  private listeners: Change<S>[] = [];

  constructor(private state: S) {}

  get now(): S {
    return this.state;
  }

  set(part: Partial<S>): void {
    const before = this.state;
    const after = { ...before, ...part };
    if ((Object.keys(part) as (keyof S)[]).every((key) => before[key] === after[key])) return;
    this.state = after;
    for (const listener of this.listeners) listener(after, before);
  }

  watch(listener: Change<S>): void {
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

export interface Frames {
  frame: number[];
  time_s: number[];
}

/// Times when they rise from frame to frame, frame numbers or places otherwise: a plot's axis must rise.
export function axisOf(frames: Frames): { label: string; values: number[] } {
  const rises = (values: number[]) => values.every((value, i) => Number.isFinite(value) && (i === 0 || value > values[i - 1]));
  if (rises(frames.time_s)) return { label: 'time (s)', values: frames.time_s };
  if (rises(frames.frame)) return { label: 'frame', values: frames.frame };
  return { label: 'frame, in order of the list', values: frames.frame.map((_, i) => i) };
}
