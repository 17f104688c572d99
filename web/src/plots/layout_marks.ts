// SPDX-License-Identifier: Apache-2.0
import { holds, type LayoutReport, type Measure } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import { count, significant } from '../data/format';
import { ramp } from './ramp';

/// How a layout looks in every chart: found ones filled, given ones hollow, those that break a constraint a
/// cross. Told by form as well as by colour.
export type Form = 'disc' | 'diamond' | 'cross';

export function formOf(report: LayoutReport, layout: number): Form {
  const { reference } = report.layouts[layout];
  return !holds(report.layouts[layout]) ? 'cross' : reference ? 'diamond' : 'disc';
}

export function pathOf(form: Form, x: number, y: number, r: number): string {
  if (form === 'disc') return `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
  if (form === 'diamond') return `M${x} ${y - 1.3 * r}L${x + 1.3 * r} ${y}L${x} ${y + 1.3 * r}L${x - 1.3 * r} ${y}Z`;
  return `M${x - r} ${y - r}L${x + r} ${y + r}M${x - r} ${y + r}L${x + r} ${y - r}`;
}

/// The values of the layouts that set a chart's range: those found; the given ones too unless they would
/// take more than half of it.
export function spanOf(report: LayoutReport, measure: number): [number, number] {
  const of = (reference: boolean) => report.layouts.filter((layout) => layout.reference === reference)
    .map((layout) => layout.values[measure]).filter((value): value is number => value !== null);
  const found = of(false);
  const given = of(true);
  if (found.length === 0) return extent(given);
  const [low, high] = extent(found);
  const [wideLow, wideHigh] = extent([...found, ...given]);
  const most = 2 * Math.max(high - low, 1e-9 * Math.abs(high), Number.MIN_VALUE);
  return wideHigh - wideLow <= most ? [wideLow, wideHigh] : [low, high];
}

function extent(values: number[]): [number, number] {
  if (values.length === 0) return [0, 1];
  return [Math.min(...values), Math.max(...values)];
}

/// A layout's colour by the measure that is told by it; a custom property or a colour.
export function inkOf(report: LayoutReport, now: LayoutSelection, layout: number): string {
  if (report.layouts[layout].reference) return 'var(--body-2)';
  if (now.shade === null) return 'var(--accent)';
  const value = report.layouts[layout].values[now.shade];
  if (value === null) return 'var(--hidden)';
  const [low, high] = spanOf(report, now.shade);
  return ramp(high > low ? (value - low) / (high - low) : 0.5);
}

export function valueText(measure: Measure, value: number | null): string {
  if (value === null) return '–';
  const size = Math.abs(value);
  // Below a nanometre nothing is meant.
  const text = size < 1e-6 ? '0' : Number.isInteger(value) || size >= 1e4 ? count(value) : significant(value, 3);
  return measure.unit ? `${text} ${measure.unit}` : text;
}

export function layoutWords(report: LayoutReport, layout: number): string {
  const { name, reference, targets } = report.layouts[layout];
  return `${name}${reference ? ` (${targets.length} targets)` : ''}${layout === report.knee ? ', the knee' : ''}`;
}

/// A label in lines of at most so many letters.
export function wrapped(text: string, letters: number): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ')) {
    const last = lines[lines.length - 1];
    if (last !== undefined && last.length + word.length + 1 <= letters) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines;
}
