// SPDX-License-Identifier: Apache-2.0
import { roundStep } from '../data/format';
import { present, type Column } from '../data/statistics';
import { logRangeOf } from './ranges';
import type { Figure, Trace } from './figures';

const kWidth = 720;
const kHeight = 300;
const kLeft = 70;
const kRight = 16;
const kTop = 44;
const kBottom = 46;

/// The figure as a drawing that stands alone: title, axes with units, key. `colour` resolves the names of
/// colours; the ground is white whatever the page's theme.
export function svgOf(figure: Figure, colour: (name: string) => string): string {
  const xs = figure.axis.values;
  const ys = [...figure.traces.map((trace) => trace.values), ...figure.bands.flatMap((band) => [band.low, band.high])].flatMap(present);
  const limits = figure.limits ?? [];
  const [bottom, top] = spanOfValues(figure, [...ys, ...limits.map((limit) => limit.value)]);
  const x = (value: number) => kLeft + ((value - xs[0]) / (xs[xs.length - 1] - xs[0] || 1)) * (kWidth - kLeft - kRight);
  const part = figure.log
    ? (value: number) => Math.log(Math.max(value, bottom) / bottom) / Math.log(top / bottom)
    : (value: number) => (value - bottom) / (top - bottom);
  const y = (value: number) => kHeight - kBottom - part(value) * (kHeight - kTop - kBottom);
  const place = { x, y, xs };

  const parts = [
    `<rect width="${kWidth}" height="${kHeight}" fill="#fff"/>`,
    text(kLeft, 18, `${figure.title} (${figure.unit})`, 'font-weight="600"'),
    ...ticks(xs[0], xs[xs.length - 1]).map((tick) => line(x(tick), kTop, x(tick), kHeight - kBottom) + text(x(tick), kHeight - kBottom + 16, tickText(tick), 'text-anchor="middle" fill="#555"')),
    ...(figure.log ? logTicks(bottom, top) : ticks(bottom, top)).map((tick) => line(kLeft, y(tick), kWidth - kRight, y(tick)) + text(kLeft - 6, y(tick) + 4, tickText(tick), 'text-anchor="end" fill="#555"')),
    text((kLeft + kWidth - kRight) / 2, kHeight - 10, figure.axis.label, 'text-anchor="middle" fill="#555"'),
    `<text transform="translate(14 ${(kTop + kHeight - kBottom) / 2}) rotate(-90)" text-anchor="middle" fill="#555">${escaped(figure.unit)}</text>`,
    ...figure.bands.map((band) => `<path d="${area(band.low, band.high, place)}" fill="${colour(band.colour)}" fill-opacity="0.18"/>`),
    ...figure.traces.map((trace) => drawn(trace, place, colour(trace.colour))),
    ...limits.map(({ label, value }) => `<path d="M${kLeft} ${y(value).toFixed(2)}H${kWidth - kRight}" stroke="${colour('--flag')}" stroke-dasharray="6 4"/>${text(kWidth - kRight - 4, y(value) - 4, label, `text-anchor="end" fill="${colour('--flag')}"`)}`),
    ...key(figure, colour),
  ];
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${kWidth}" height="${kHeight}" viewBox="0 0 ${kWidth} ${kHeight}" font-family="system-ui, sans-serif" font-size="11">${parts.join('')}</svg>`;
}

function spanOfValues(figure: Figure, ys: number[]): [number, number] {
  if (figure.log) return logRangeOf(...minmax(ys.filter((value) => value > 0)));
  const low = Math.min(figure.fromZero ? 0 : Infinity, ys.length ? Math.min(...minmax(ys)) : 0);
  const high = ys.length ? Math.max(...minmax(ys)) : 1;
  const room = (high - low || 1) * 0.05;
  return [figure.fromZero ? low : low - room, high + room];
}

interface Place {
  x: (value: number) => number;
  y: (value: number) => number;
  xs: number[];
}

function drawn(trace: Trace, place: Place, colour: string): string {
  if (trace.form === 'points') {
    const dots = trace.values.map((value, i) => (value === null ? '' : `M${at(place, i, value)}h0`)).join('');
    return `<path d="${dots}" stroke="${colour}" stroke-width="2.4" stroke-linecap="round" stroke-opacity="0.6"/>`;
  }
  const dash = trace.dashed ? ' stroke-dasharray="4 3"' : '';
  return `<path d="${path(trace.values, place, trace.form === 'steps')}" fill="none" stroke="${colour}" stroke-width="1.3"${dash}/>`;
}

function path(values: Column, place: Place, steps: boolean): string {
  let d = '';
  let open = false;
  values.forEach((value, i) => {
    if (value === null) {
      open = false;
      return;
    }
    if (open && steps) d += `H${place.x(place.xs[i]).toFixed(2)}`;
    d += `${open ? 'L' : 'M'}${at(place, i, value)}`;
    open = true;
  });
  return d;
}

function area(low: Column, high: Column, place: Place): string {
  let d = '';
  let start = 0;
  for (let i = 0; i <= high.length; ++i) {
    if (i < high.length && high[i] !== null && low[i] !== null) continue;
    if (i > start) {
      const up = Array.from({ length: i - start }, (_, k) => at(place, start + k, high[start + k]!));
      const back = Array.from({ length: i - start }, (_, k) => at(place, i - 1 - k, low[i - 1 - k]!));
      d += `M${[...up, ...back].join('L')}Z`;
    }
    start = i + 1;
  }
  return d;
}

function at(place: Place, i: number, value: number): string {
  return `${place.x(place.xs[i]).toFixed(2)} ${place.y(value).toFixed(2)}`;
}

function key(figure: Figure, colour: (name: string) => string): string[] {
  let left = kLeft;
  const items = [...figure.traces.map((t) => ({ label: t.label, colour: t.colour, opacity: 1 })), ...figure.bands.map((b) => ({ label: b.label, colour: b.colour, opacity: 0.3 }))];
  return items.map((item) => {
    const mark = `<rect x="${left}" y="27" width="12" height="6" fill="${colour(item.colour)}" fill-opacity="${item.opacity}"/>${text(left + 16, 34, item.label)}`;
    left += 34 + item.label.length * 6;
    return mark;
  });
}

/// About five round values from low to high.
export function ticks(low: number, high: number): number[] {
  if (!(high > low)) return [low];
  const step = roundStep((high - low) / 4);
  const found: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) found.push(i * step + 0);
  return found;
}

/// Round values on a logarithmic axis: every power of ten, between them 2 and 5 where there is room.
export function logTicks(low: number, high: number): number[] {
  const found: number[] = [];
  const leads = high / low > 3000 ? [1] : [1, 2, 5];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power) {
    for (const lead of leads) {
      const tick = Number(`${lead}e${power}`);
      if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) found.push(tick);
    }
  }
  return found;
}

function minmax(values: number[]): [number, number] {
  return values.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [Infinity, -Infinity] as [number, number]);
}

function line(x1: number, y1: number, x2: number, y2: number): string {
  return `<path d="M${x1.toFixed(2)} ${y1.toFixed(2)}L${x2.toFixed(2)} ${y2.toFixed(2)}" stroke="#e3e6e8"/>`;
}

function text(x: number, y: number, content: string, attributes = ''): string {
  return `<text x="${x.toFixed(2)}" y="${y.toFixed(2)}" ${attributes}>${escaped(content)}</text>`;
}

export function tickText(value: number): string {
  return String(Number(value.toPrecision(6))).replace('-', '\u2212');
}

function escaped(content: string): string {
  return content.replace(/[&<>]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[c]!);
}
