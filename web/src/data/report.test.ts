// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { figuresOf } from '../plots/figures';
import { figureAsCsv } from '../plots/export';
import { svgOf, ticks } from '../plots/svg';
import { rangeOf } from '../plots/ranges';
import { constellation, scalesOf } from '../scene/scales';
import { pathPieces } from '../scene/paths';
import { flattened } from '../tables/flatten';
import { csv, everythingAsCsv } from './csv';
import { rotationErrors, summarise, translationErrors } from './errors';
import { count, decimals, percent, roundStep, significant } from './format';
import { parseReport } from './parse';
import type { MotionRow } from './parts';
import type { PoseRow, TrackingReport } from './report';
import { remarksOf } from './remarks';
import { axisOf, nearestIndex, Shared, type Selection } from './selection';
import { runs, share } from './status';
import { summariseTarget } from './targets';

const still: MotionRow = [0, 0, 2000, 1, 0, 0, 0];
const covariance = [1e-4, 0, 0, 1e-4, 0, 4e-4, 1e-8, 0, 0, 1e-8, 0, 1e-8];

function pose(x: number, turnAboutY = 0): PoseRow {
  return [x, 0, 2000, Math.cos(turnAboutY / 2), 0, Math.sin(turnAboutY / 2), 0, ...covariance];
}

function report(): TrackingReport {
  const lens = { fx: 1000, fy: 1000, skew: 0, cx: 320, cy: 240, distortion: [], width_px: 640, height_px: 480 };
  return {
    schema: 'asterism-tracking-report/1', title: 't', subtitle: '', summary: [], remarks: [], options: null,
    rig: { left: lens, right: lens, right_from_left: [-400, 0, 0, 1, 0, 0, 0] },
    frames: { frame: [5, 6, 7, 8], time_s: [0, 0.1, 0.2, 0.3], centres_left: [2, 2, 0, 0], centres_right: [2, 1, 0, 0] },
    bodies: [{
      name: 'platform, "big"',
      targets: [{ id: 'P1', position_mm: [100, 0, 0] }, { id: 'P2', position_mm: [0, 100, 0], diameter_mm: 12 }],
      point: { name: 'flange', position_mm: [0, 0, 500] },
      status: 'OPLL', measured: [pose(0.01), pose(0, 1e-5), null, null],
      filtered_status: 'OPRL', filtered: [pose(0.01), pose(0), pose(3), null],
      targets_used: [2, 1, 0, 0], rms_px: [0.02, 0.01, null, null],
      sightings: [
        { seen: '3100', left_px: [[0.03, 0.04], [0, 0], null, null], right_px: [[0, 0], null, null, null] },
        { seen: '3000', left_px: [[0, 0], null, null, null], right_px: [[0, 0], null, null, null] },
      ],
      truth: [still, still, still, still],
    }],
  };
}

const selection: Selection = { frame: 0, body: 0, component: 'size', source: 'measured', range: null };

describe('errors', () => {
  it('are told at the named point: a turn becomes a shift at the end of the lever arm', () => {
    const body = report().bodies[0];
    const { error } = translationErrors(body, 'measured', 'x');
    expect(error[0]).toBeCloseTo(0.01, 12);
    expect(error[1]).toBeCloseTo(500e-5, 9);
    expect(error.slice(2)).toEqual([null, null]);
    expect(rotationErrors(body, 'measured', 'y').error[1]).toBeCloseTo((1e-5 * 180) / Math.PI, 12);
  });
  it('have a band of 1.96 σ along an axis', () => {
    const { band } = translationErrors(report().bodies[0], 'measured', 'z');
    expect(band[0]).toBeCloseTo(1.959964 * 0.02, 9);
  });
  it('count how many lie inside their band', () => {
    expect(summarise({ error: [1, -3, null, 0.5], band: [2, 2, 2, 2] })).toMatchObject({ frames: 3, inside: 2 / 3, max: 3 });
    expect(summarise({ error: [null], band: [1] })).toMatchObject({ frames: 0, rms: null, inside: null });
  });
  it('never draw a predicted pose as measured', () => {
    const figure = figuresOf(report(), { ...selection, source: 'filtered' }).find((f) => f.id === 'translation-error')!;
    const [measured, predicted] = figure.traces;
    expect(measured.values[2]).toBeNull();
    expect(predicted).toMatchObject({ label: 'predicted − truth', dashed: true });
    expect(predicted.values[2]).toBeCloseTo(3, 9);
    const pieces = pathPieces(report().bodies[0], 'filtered');
    expect(pieces.measured.length).toBe(2);
    expect(pieces.predicted.length).toBe(2);
  });
});

describe('status', () => {
  it('falls into runs', () => {
    expect(runs('OOLLO')).toEqual([{ status: 'O', first: 0, last: 1 }, { status: 'L', first: 2, last: 3 }, { status: 'O', first: 4, last: 4 }]);
    expect(runs('')).toEqual([]);
    expect(share('OOLA', 'O')).toBe(0.5);
  });
  it('says how often each target was seen in the measured frames', () => {
    const body = report().bodies[0];
    const first = summariseTarget(body, body.sightings[0]);
    expect(first).toMatchObject({ frames: 2, both: 0.5, left: 0.5, right: 0, hidden: 0 });
    expect(first.leftResidual.rms).toBeCloseTo(Math.sqrt(0.0025 / 4), 12);
    expect(summariseTarget(body, body.sightings[1]).rightResidual.mean).toEqual([0, 0]);
  });
});

describe('remarks', () => {
  it('are those given, then those made from the statuses', () => {
    const [partial, lost] = remarksOf(report());
    expect(partial).toContain('was PARTIAL in 1 of 4 frames (25.0 %), in one stretch, the longest of 0.10 s: fewer than four');
    expect(lost).toContain('was LOST in 2 of 4 frames (50.0 %)');
    expect(remarksOf({ ...report(), remarks: ['said'] })[0]).toBe('said');
  });
});

describe('picking', () => {
  it('takes the nearest frame, also outside', () => {
    const times = [0, 1, 3];
    expect([-5, 0.4, 0.6, 2.1, 99].map((t) => nearestIndex(times, t))).toEqual([0, 0, 1, 2, 2]);
    expect(nearestIndex([7], 3)).toBe(0);
  });
  it('plots over frames when time goes back', () => {
    expect(axisOf({ frame: [1, 2], time_s: [0, 1] }).label).toBe('time (s)');
    expect(axisOf({ frame: [1, 2], time_s: [1, 0] })).toEqual({ label: 'frame', values: [1, 2] });
    expect(axisOf({ frame: [2, 2], time_s: [1, 0] }).values).toEqual([0, 1]);
  });
  it('tells watchers of changes only', () => {
    const shared = new Shared(selection);
    const seen: number[] = [];
    shared.watch((now) => seen.push(now.frame));
    shared.set({ frame: 0 });
    shared.set({ frame: 2 });
    expect(seen).toEqual([2]);
  });
});

describe('numbers in words', () => {
  it('keep their significant digits', () => {
    expect(significant(0.0047123)).toBe('0.00471');
    expect(significant(-12.345)).toBe('−12.3');
    expect(significant(0.9996)).toBe('1.00');
    expect(significant(123456)).toBe('123456');
    expect(significant(null)).toBe('–');
    expect(decimals(-0.0001, 2)).toBe('0.00');
  });
  it('never round to nothing or to all', () => {
    expect([0, 0.00001, 0.5, 0.99999, 1].map(percent)).toEqual(['0', '0.1', '50.0', '99.9', '100']);
  });
  it('count with thin spaces and step by 1, 2, 5', () => {
    expect(count(1234567)).toBe('1\u202f234\u202f567');
    expect([0.7, 2000, 4.99, 10].map(roundStep)).toEqual([0.5, 2000, 2, 10]);
  });
});

describe('exports', () => {
  it('quote what CSV needs quoted and leave out what is not there', () => {
    expect(csv(['a', 'b'], [['x,"y"', null], [1 / 3, 2]])).toBe('a,b\n"x,""y""",\n0.3333333333,2\n');
  });
  it('give a row a frame, body and source', () => {
    const lines = everythingAsCsv(report()).trim().split('\n');
    expect(lines.length).toBe(1 + 2 * 4);
    expect(lines[3]).toContain('LOST,,,');
    const columns = lines[0].split(',').length;
    expect(lines[1].replace('"platform, ""big"""', 'platform').split(',').length).toBe(columns);
  });
  it('hold what a figure shows, with units', () => {
    const figure = figuresOf(report(), selection)[2];
    expect(figureAsCsv(figure).split('\n')[0]).toBe('time (s),measured − truth (mm),stated 95 % low (mm),stated 95 % high (mm)');
    const svg = svgOf({ ...figure, title: 'a < b' }, () => '#123');
    expect(svg).toContain('a &lt; b');
    expect(svg).not.toContain('NaN');
  });
});

describe('scales', () => {
  it('mark axes at round values', () => {
    expect(ticks(0, 1)).toEqual([0, 0.2, 0.4, 0.6000000000000001, 0.8, 1]);
    expect(rangeOf(1, 2, true)[0]).toBe(0);
    expect(rangeOf(null, null, false)).toEqual([0, 1]);
  });
  it('join all targets by the shortest lines', () => {
    expect(constellation([[0, 0, 0], [10, 0, 0], [1, 0, 0]])).toEqual([[0, 2], [2, 1]]);
  });
  it('state round exaggerations and bear a report without poses', () => {
    const scales = scalesOf(report());
    expect(Math.log10(scales.ellipsoids) % 1).toBeGreaterThanOrEqual(0);
    const empty = report();
    empty.bodies[0].measured = [null, null, null, null];
    expect(scalesOf(empty).ellipsoids).toBe(1);
  });
});

describe('report data', () => {
  it('names what is wrong with a page without data', () => {
    expect(() => parseReport('null')).toThrow('holds no data');
    expect(() => parseReport('{"schema":"other/9"}')).toThrow('"other/9"');
  });
  it('lists options with their path', () => {
    expect(flattened({ a: { b: 1, c: [1, 2] }, d: 'x' })).toEqual([['a.b', '1'], ['a.c', '[1,2]'], ['d', 'x']]);
  });
});
