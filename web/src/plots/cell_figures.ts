// SPDX-License-Identifier: Apache-2.0
import { above, bound95 } from '../data/cell_errors';
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { count, significant } from '../data/format';
import { axisOf } from '../data/selection';
import { largest, present, type Column } from '../data/statistics';
import type { Figure, Limit, Trace } from './figures';
import { logRangeOf } from './ranges';

/// The motion's axis.
export function cellAxis(report: CellReport): Figure['axis'] {
  return axisOf({ frame: report.time_s.map((_, i) => i), time_s: report.time_s });
}

export function cellFigures(report: CellReport, now: CellSelection): Figure[] {
  const axis = cellAxis(report);
  const point = report.points[now.point];
  return [
    visibleFigure(report, axis),
    ...(report.coverage.length > 0 ? [coverageFigure(report, axis)] : []),
    ...(point ? [pointFigure(report, axis, now)] : []),
    ...(report.predicted_rotation_deg.length > 0 || report.measured_rotation_deg.length > 0 ? [rotationFigure(report, axis, now)] : []),
  ];
}

function visibleFigure(report: CellReport, axis: Figure['axis']): Figure {
  const body = report.bodies[report.body];
  const few = above(report.visible.map((value) => -value), -4);
  return {
    id: 'visible', title: `Targets of ${body.name} that both cameras see`, unit: 'count', axis, bands: [], fromZero: true, digits: 0,
    traces: [{ label: 'seen by both', values: report.visible, colour: '--body-1', form: 'steps' }], limits: [{ label: 'four needed', value: 4 }],
    note: few.frames > 0 ? `fewer than four in ${count(few.frames)} of ${count(few.of)} frames: the pose cannot be trusted there` : 'never fewer than four',
  };
}

function coverageFigure(report: CellReport, axis: Figure['axis']): Figure {
  return {
    id: 'coverage', title: 'Field-of-view coverage coefficient', unit: '', axis, bands: [], fromZero: true, digits: 3,
    traces: [{ label: 'coefficient', values: report.coverage, colour: '--body-3', form: 'line' }], limits: [{ label: '0.6 asked', value: 0.6 }],
    note: 'how squarely the body faces the tracker; 0 where it has left the field of view',
  };
}

function pointFigure(report: CellReport, axis: Figure['axis'], now: CellSelection): Figure {
  const point = report.points[now.point];
  const bound = bound95(point);
  const traces: Trace[] = [{ label: 'predicted √tr Σ', values: point.predicted_mm, colour: '--body-1', form: 'line' }];
  if (point.measured_mm.length > 0) traces.push({ label: 'measured', values: point.measured_mm, colour: '--body-2', form: 'points' });
  const without = point.without_mm.length > 0 ? { label: 'without targets', values: point.without_mm } : { label: 'without targets, at their centroid', values: report.without_mm };
  if (without.values.length > 0) traces.push({ ...without, colour: '--muted', form: 'line', dashed: true });
  const inside = point.measured_mm.filter((value, i) => value !== null && bound[i] !== null && value <= bound[i]!).length;
  const both = point.measured_mm.filter((value, i) => value !== null && bound[i] !== null).length;
  const worst = largest(present(point.predicted_mm));
  const words = [
    worst !== null ? `largest predicted ${significant(worst, 3)} mm` : 'nothing is determined',
    ...(both > 0 ? [`${count(inside)} of ${count(both)} measured errors lie inside their 95 % bound`] : []),
  ];
  return errorFigure({
    id: 'point-error', title: `Error at ${point.name}`, unit: 'mm', axis, traces, fromZero: true, digits: 3, note: words.join('; '),
    bands: bound.some((value) => value !== null) ? [{ label: 'predicted 95 %', low: bound.map((value) => value && 0), high: bound, colour: '--body-1' }] : [],
  }, [{ label: 'tolerance', value: report.tolerance_mm }, { label: 'nominal', value: report.nominal_mm }], now);
}

function rotationFigure(report: CellReport, axis: Figure['axis'], now: CellSelection): Figure {
  const all: (Trace | null)[] = [
    report.predicted_rotation_deg.length > 0 ? { label: 'predicted', values: report.predicted_rotation_deg, colour: '--body-1', form: 'line' } : null,
    report.measured_rotation_deg.length > 0 ? { label: 'measured', values: report.measured_rotation_deg, colour: '--body-2', form: 'points' } : null,
    report.without_deg.length > 0 ? { label: 'without targets', values: report.without_deg, colour: '--muted', form: 'line', dashed: true } : null,
  ];
  return errorFigure({
    id: 'rotation-error', title: `Rotation error of ${report.bodies[report.body].name}`, unit: 'deg', axis, bands: [], fromZero: true, digits: 3,
    traces: all.filter((trace): trace is Trace => trace !== null), note: 'angle of the error; predicted: √tr Σ',
  }, [], now);
}

/// On a logarithmic axis nothing lies at zero: bands begin at the axis's foot, and what is not above zero is left out.
function errorFigure(figure: Figure, limits: Limit[], now: CellSelection): Figure {
  const height = 220;
  if (now.scale === 'linear') return { ...figure, limits, height };
  const positive = (values: Column): Column => values.map((value) => (value !== null && value > 0 ? value : null));
  const usual = [...figure.traces.filter((trace) => trace.form === 'line').flatMap((trace) => present(trace.values)), ...limits.map((limit) => limit.value)].filter((value) => value > 0);
  const foot = usual.length > 0 ? logRangeOf(Math.min(...usual) / 4, Math.max(...usual))[0] : 1e-6;
  return {
    ...figure, limits, height, log: true,
    traces: figure.traces.map((trace) => ({ ...trace, values: positive(trace.values).map((value) => (value === null ? null : Math.max(value, foot))) })),
    bands: figure.bands.map((band) => ({ ...band, low: band.low.map((value) => value === null ? null : foot), high: positive(band.high) })),
  };
}
