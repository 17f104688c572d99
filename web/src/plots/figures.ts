// SPDX-License-Identifier: Apache-2.0
import { displacements, rotationErrors, statusOf, summarise, translationErrors, type Errors } from '../data/errors';
import { count, percent, significant } from '../data/format';
import type { BodyTrack, TrackingReport } from '../data/report';
import { axisOf, type Component, type Selection } from '../data/selection';
import { isMeasured } from '../data/status';
import type { Column } from '../data/statistics';

export interface Trace {
  label: string;
  values: Column;
  colour: string;  // a custom property of the style sheet
  form: 'line' | 'steps' | 'points';
  dashed?: boolean;
}

/// Between two traces that are not drawn themselves.
export interface Band {
  label: string;
  low: Column;
  high: Column;
  colour: string;
}

/// A level with its name: what is allowed, what is needed.
export interface Limit {
  label: string;
  value: number;
}

/// What one plot shows; drawn on screen, as SVG and as CSV from the same data.
export interface Figure {
  id: string;
  title: string;
  unit: string;
  axis: { label: string; values: number[] };
  traces: Trace[];
  bands: Band[];
  note: string;
  fromZero: boolean;
  digits: number;
  group?: string;  // figures of one group share their cursor
  limits?: Limit[];
  height?: number; // px of the plot; 168 if nothing is said
  log?: boolean;   // the values' axis; what is not above zero is left out
}

const kComponentWords: Record<Component, string> = { size: 'size', x: 'along x', y: 'along y', z: 'along z' };

export function bodyColour(body: number): string {
  return `--body-${(body % 6) + 1}`;
}

export function figuresOf(report: TrackingReport, selection: Selection): Figure[] {
  const axis = axisOf(report.frames);
  const body = report.bodies[selection.body];
  const figures = [residualFigure(report, axis), countFigure(report, axis)];
  if (!body) return figures;
  const name = `${body.name}, ${body.point.name}`;
  figures.push(
    errorFigure('translation-error', `Translation error of ${name}`, 'mm', axis, selection, body, translationErrors(body, selection.source, selection.component)),
    errorFigure('rotation-error', `Rotation error of ${body.name}`, 'deg', axis, selection, body, rotationErrors(body, selection.source, selection.component)),
    ...pathFigures(body, axis),
  );
  return figures;
}

function residualFigure(report: TrackingReport, axis: Figure['axis']): Figure {
  return {
    id: 'residual', title: 'Residual RMS', unit: 'px', axis, bands: [], fromZero: true, digits: 3,
    note: 'measured less computed image positions of the targets that took part in the pose',
    traces: report.bodies.map((body, i) => ({ label: body.name, values: body.rms_px, colour: bodyColour(i), form: 'line' })),
  };
}

function countFigure(report: TrackingReport, axis: Figure['axis']): Figure {
  return {
    id: 'targets', title: 'Targets used', unit: 'count', axis, bands: [], fromZero: true, digits: 0,
    note: report.bodies.map((body) => `${body.name} has ${body.targets.length}`).join(', '),
    traces: report.bodies.map((body, i) => ({ label: body.name, values: body.targets_used, colour: bodyColour(i), form: 'steps' })),
  };
}

function errorFigure(id: string, title: string, unit: string, axis: Figure['axis'], selection: Selection, body: BodyTrack, errors: Errors): Figure {
  const size = selection.component === 'size';
  const colour = bodyColour(selection.body);
  const words = kComponentWords[selection.component];
  const { inside, frames } = summarise(errors);
  const status = statusOf(body, selection.source);
  const measured = errors.error.map((value, i) => (isMeasured(status[i]) ? value : null));
  const carried = errors.error.map((value, i) => (status[i] === 'R' ? value : null));
  const traces: Trace[] = [];
  if (body.truth) traces.push({ label: 'measured − truth', values: measured, colour, form: 'line' });
  if (carried.some((value) => value !== null)) traces.push({ label: 'predicted − truth', values: carried, colour: '--predicted-ink', form: 'line', dashed: true });
  return {
    id, title: `${title}, ${words}`, unit, axis, traces, fromZero: size, digits: 3,
    bands: [{
      label: 'stated 95 %', colour,
      low: size ? errors.band.map((value) => value && 0) : errors.band.map((value) => value && -value),
      high: errors.band,
    }],
    note: body.truth && inside !== null
      ? `${percent(inside)} % of ${count(frames)} errors lie inside their stated 95 % band`
      : 'no truth is known for this recording: only the stated band is drawn',
  };
}

function pathFigures(body: BodyTrack, axis: Figure['axis']): Figure[] {
  const raw = displacements(body, 'measured');
  const smooth = body.filtered ? displacements(body, 'filtered') : null;
  const axes = ['x', 'y', 'z'].map((label, i) => ({ label, i, colour: `--axis-${label}` }));
  const figure = (id: 'translation' | 'rotation', title: string, unit: string, prefix: string): Figure => ({
    id: `path-${id}`, title, unit, axis, bands: [], fromZero: false, digits: 4,
    note: smooth ? 'points: measured by each frame alone; lines: filtered' : 'measured by each frame alone',
    traces: axes.flatMap(({ label, i, colour }): Trace[] => [
      { label: `${prefix}${label}`, values: raw[id].map((v) => v && v[i]), colour, form: smooth ? 'points' : 'line' },
      ...(smooth ? [{ label: `${prefix}${label} filtered`, values: smooth[id].map((v) => v && v[i]), colour, form: 'line' as const }] : []),
    ]),
  });
  return [
    figure('translation', `Way of ${body.name}, ${body.point.name}, from its first pose`, 'mm', ''),
    figure('rotation', `Turn of ${body.name} from its first pose (rotation vector)`, 'deg', 'r'),
  ];
}

export function valueAt(trace: Trace, frame: number, digits: number): string {
  const value = trace.values[frame] ?? null;
  return digits === 0 ? (value === null ? '–' : String(value)) : significant(value, digits);
}

