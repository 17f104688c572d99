// SPDX-License-Identifier: Apache-2.0
import uPlot from 'uplot';
import { colour, h } from '../dom';
import { nearestIndex, type Place, type Shared } from '../data/selection';
import { valueAt, type Figure, type Limit } from './figures';
import { exportButtons } from './export';
import { logRangeOf, rangeOf } from './ranges';
import { logTicks } from './svg';

const kAxisWidth = 62;  // the same for all, so that plots and strip stand under one another
export const kPlotLeft = kAxisWidth;
export const kPlotRight = 12;

export interface PlotView {
  element: HTMLElement;
  destroy: () => void;
  resize: () => void;
  redraw: () => void;
  setRange: (range: [number, number] | null) => void;
}

/// One figure: title with units, values at the current frame, the plot, what it says, exports.
export function plotView<S extends Place>(figure: Figure, shared: Shared<S>): PlotView {
  const values = figure.traces.map((trace) => {
    const value = h('b');
    return { trace, value, item: h('span', { class: `key ${trace.form}${trace.dashed ? ' dashed' : ''}`, style: `--key: var(${trace.colour})` }, h('i'), trace.label, ' ', value) };
  });
  const bands = figure.bands.map((band) => {
    const value = h('b');
    return { band, value, item: h('span', { class: 'key band', style: `--key: var(${band.colour})` }, h('i'), band.label, ' ', value) };
  });
  const holder = h('div', { class: 'plot', role: 'img', 'aria-label': `Plot of ${figure.title} in ${figure.unit} over ${figure.axis.label}. ${figure.note}` });
  const element = h('figure', { class: 'figure', id: `figure-${figure.id}` },
    h('figcaption', {}, h('span', { class: 'figure-title' }, figure.title), h('span', { class: 'unit' }, figure.unit), exportButtons(figure)),
    h('div', { class: 'keys' }, ...values.map((v) => v.item), ...bands.map((b) => b.item)),
    holder,
    h('p', { class: 'note' }, figure.note));

  const plot = new uPlot(optionsOf(figure, shared), dataOf(figure), holder);
  const marker = h('div', { class: 'now' });
  plot.over.append(marker);

  const showNow = () => {
    const { frame } = shared.now;
    const left = plot.valToPos(figure.axis.values[frame], 'x');
    marker.style.transform = `translateX(${left}px)`;
    marker.style.display = left < 0 || left > plot.bbox.width / (window.devicePixelRatio || 1) ? 'none' : '';
    for (const { trace, value } of values) value.textContent = valueAt(trace, frame, figure.digits);
    for (const { band, value } of bands) value.textContent = valueAt({ label: '', colour: '', form: 'line', values: band.high }, frame, 3);
  };
  const resize = () => {
    const width = holder.clientWidth;
    if (width > 0 && width !== plot.width) plot.setSize({ width, height: plot.height });
    showNow();
  };
  let alive = true;
  shared.watch((now, before) => {
    if (alive && now.frame !== before.frame) showNow();
  });
  requestAnimationFrame(resize);

  return {
    element, resize,
    destroy: () => { alive = false; plot.destroy(); },
    redraw: () => plot.redraw(true, true),
    setRange: (range) => {
      const all = figure.axis.values;
      plot.setScale('x', { min: range?.[0] ?? all[0], max: range?.[1] ?? all[all.length - 1] });
      showNow();
    },
  };
}

function dataOf(figure: Figure): uPlot.AlignedData {
  return [figure.axis.values, ...figure.traces.map((trace) => trace.values), ...figure.bands.flatMap((band) => [band.high, band.low])];
}

const kLogTicks: Partial<uPlot.Axis> = { splits: (_plot, _axis, low, high) => logTicks(low, high), filter: (_plot, splits) => splits };

function optionsOf<S extends Place>(figure: Figure, shared: Shared<S>): uPlot.Options {
  const all = figure.axis.values;
  const first = figure.traces.length + 1;
  const axis: uPlot.Axis = {
    stroke: () => colour('--muted'), font: '11px system-ui, sans-serif', labelFont: '11px system-ui, sans-serif',
    grid: { stroke: () => colour('--grid'), width: 1 }, ticks: { stroke: () => colour('--grid'), width: 1, size: 4 },
  };
  return {
    width: 600, height: figure.height ?? 168, padding: [8, kPlotRight, 0, 0],
    legend: { show: false },
    cursor: {
      y: false, drag: { x: true, y: false, setScale: false }, points: { show: false },
      sync: { key: figure.group ?? 'frames' },
    },
    select: { show: true, left: 0, top: 0, width: 0, height: 0 },
    scales: { x: { time: false }, y: scaleOf(figure) },
    axes: [
      { ...axis, label: figure.axis.label, labelSize: 16, labelGap: 0, size: 26, gap: 3, values: (_, ticks) => ticks.map(tickText) },
      { ...axis, label: figure.unit, labelSize: 16, labelGap: 0, size: kAxisWidth - 16, gap: 4, ...(figure.digits === 0 ? { incrs: [1, 2, 5, 10, 20, 50] } : {}), ...(figure.log ? kLogTicks : {}), values: (_, ticks) => ticks.map(tickText) },
    ],
    series: [
      {},
      ...figure.traces.map((trace): uPlot.Series => ({
        label: trace.label, stroke: () => colour(trace.colour), width: trace.form === 'points' ? 0 : 1.4,
        dash: trace.dashed ? [4, 3] : undefined, spanGaps: false,
        paths: trace.form === 'points' ? () => null : trace.form === 'steps' ? uPlot.paths.stepped!({ align: 1 }) : undefined,
        points: trace.form === 'points' ? { show: true, size: 3, width: 0, fill: () => colour(trace.colour) + '99' } : { show: false },
      })),
      ...figure.bands.flatMap((band): uPlot.Series[] => [
        { label: band.label, stroke: () => colour(band.colour) + '66', width: 1, points: { show: false } },
        { label: `${band.label} low`, stroke: () => colour(band.colour) + '66', width: 1, points: { show: false } },
      ]),
    ],
    bands: figure.bands.map((band, i) => ({ series: [first + 2 * i, first + 2 * i + 1], fill: () => colour(band.colour) + '26' })),
    hooks: {
      setCursor: [(plot) => {
        // Synced plots get the same event; only the one under the pointer speaks.
        const { left } = plot.cursor;
        if (left === undefined || left === null || left < 0 || !plot.over.matches(':hover')) return;
        shared.set({ frame: nearestIndex(all, plot.posToVal(left, 'x')) } as Partial<S>);
      }],
      setSelect: [(plot) => {
        if (plot.select.width < 6) return;
        shared.set({ range: [plot.posToVal(plot.select.left, 'x'), plot.posToVal(plot.select.left + plot.select.width, 'x')] } as Partial<S>);
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      }],
      draw: [(plot) => drawLimits(plot, figure.limits ?? [])],
      ready: [(plot) => plot.over.addEventListener('dblclick', () => shared.set({ range: null } as Partial<S>))],
    },
  };
}

function scaleOf(figure: Figure): uPlot.Scale {
  const limits = (figure.limits ?? []).map((limit) => limit.value);
  const wide = (low: number | null, high: number | null): [number, number] => [Math.min(low ?? Infinity, ...limits), Math.max(high ?? -Infinity, ...limits)];
  if (figure.log) return { distr: 3, range: (_, low, high) => logRangeOf(...wide(low, high)) };
  return { range: (_, low, high) => rangeOf(...wide(low, high), figure.fromZero) };
}

/// Dashed lines across the plot, each with its name above it at the right.
function drawLimits(plot: uPlot, limits: Limit[]): void {
  const { ctx, bbox } = plot;
  const ratio = window.devicePixelRatio || 1;
  ctx.save();
  ctx.font = `${10.5 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'right';
  ctx.lineWidth = ratio;
  ctx.setLineDash([6 * ratio, 4 * ratio]);
  for (const { label, value } of limits) {
    const y = plot.valToPos(value, 'y', true);
    if (y < bbox.top || y > bbox.top + bbox.height) continue;
    ctx.strokeStyle = colour('--flag');
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.strokeStyle = colour('--panel');
    ctx.lineWidth = 3 * ratio;
    ctx.setLineDash([]);
    ctx.strokeText(label, bbox.left + bbox.width - 4 * ratio, y - 4 * ratio);
    ctx.fillStyle = colour('--flag');
    ctx.fillText(label, bbox.left + bbox.width - 4 * ratio, y - 4 * ratio);
    ctx.lineWidth = ratio;
    ctx.setLineDash([6 * ratio, 4 * ratio]);
  }
  ctx.restore();
}

function tickText(value: number): string {
  return String(Number(value.toPrecision(8))).replace('-', '\u2212');
}
