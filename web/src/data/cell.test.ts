// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { cellFigures } from '../plots/cell_figures';
import { chartAsCsv, chartAxis } from '../plots/chart';
import { bordersAbout, heatAsCsv } from '../plots/heat';
import { logRangeOf } from '../plots/ranges';
import { logTicks, svgOf } from '../plots/svg';
import { cellScales } from '../scene/cell_scales';
import { sightRays } from '../scene/sight_rays';
import { cellText, placesOf } from '../tables/generic';
import { kEllipsoid95 } from './bands';
import { above, bound95, cellAsCsv } from './cell_errors';
import type { CellReport } from './cell_report';
import { firstCellSelection } from './cell_selection';
import { boxCorners, mapRange, meshOfSolid } from './mesh';
import { countsOf, floatsOf } from './packed';
import { parseReport } from './parse';
import type { MotionRow, Vec3 } from './parts';
import { hiderOf, reasonShares, seenCode, sightRuns, sightSentence, sightWords, targetWords } from './sight';
import { distance, namedSpots, partFrame, placeOf, spotAt } from './spots';

const kHalf = Math.SQRT1_2;

/// Two moments: the platform first as the tracker, then turned by 90° about z and moved. One triangle as its part.
function report(): CellReport {
  const lens = { fx: 1000, fy: 1000, skew: 0, cx: 320, cy: 240, distortion: [], width_px: 640, height_px: 480 };
  const target = (id: string, x: number) => ({ id, position_mm: [x, 0, 0] as Vec3, normal: [0, 0, -1] as Vec3, diameter_mm: 10 });
  const pose: MotionRow[] = [[0, 0, 2000, 1, 0, 0, 0], [10, 0, 2000, kHalf, 0, 0, kHalf]];
  return {
    schema: 'asterism-cell-report/1', title: 't', subtitle: '', summary: [], remarks: [], options: null,
    rig: { left: lens, right: lens, right_from_left: [-400, 0, 0, 1, 0, 0, 0] }, volume: null, time_s: [0, 0.5],
    bodies: [{ name: 'platform', targets: [target('P1', 0), target('P2', 300)], pose, sight: [['..', '..'], ['.a', 'OI']] }],
    // Float32 0 0 0, 1 0 0, 0 1 0 and uint32 0 1 2, as the program's own test has them.
    solids: [{ name: 'casing', role: 'workpiece', carrier: 0, vertices: 'AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA', triangles: 'AAAAAAEAAAACAAAA', error_mm: [0.1, null, 0.3] }],
    axes: [{ name: 'O_g workpiece', carrier: 0, pose: [0, 0, 5, kHalf, 0, 0, kHalf] }], body: 0, visible: [1, 1], coverage: [0.8, 0.5],
    points: [
      { name: 'near', position_mm: [0, 0, 0], predicted_mm: [0.05, null], covariance_mm2: [[1e-4, 0, 0, 4e-4, 0, 9e-4], null], measured_mm: [0.04, null], without_mm: [] },
      { name: 'far', position_mm: [0, 0, 500], predicted_mm: [0.3, 0.2], covariance_mm2: [null, null], measured_mm: [], without_mm: [0.5, 0.6] },
    ],
    predicted_rotation_deg: [0.01, 0.02], measured_rotation_deg: [], status: 'OL', without_mm: [0.3, 0.4], without_deg: [], tolerance_mm: 0.25, nominal_mm: 0.025,
    heats: [], tables: [], charts: [],
  };
}

describe('surfaces', () => {
  it('come out of base64 as they went in', () => {
    const mesh = meshOfSolid(report().solids[0]);
    expect([...mesh.positions]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect([...mesh.corners]).toEqual([0, 1, 2]);
    expect(mesh.high).toEqual([1, 1, 0]);
    expect(boxCorners(mesh)).toHaveLength(8);
  });
  it('are read with the lowest byte first', () => {
    expect([...floatsOf('AACAPw==')]).toEqual([1]);
    expect([...countsOf('AQIDBA==')]).toEqual([0x04030201]);
    expect([...floatsOf('')]).toEqual([]);
  });
  it('have one range of errors for all maps, none where there is no map', () => {
    expect(mapRange(report().solids)).toEqual([0.1, 0.3]);
    expect(mapRange([{ ...report().solids[0], error_mm: [] }])).toBeNull();
  });
});

describe('sight', () => {
  const solids = [{ name: 'casing' }];
  it('says in words why a camera does not see a target', () => {
    expect(sightWords('.', solids)).toBe('seen');
    expect(sightWords('a', solids)).toBe('hidden by casing');
    expect(sightWords('b', solids)).toBe('hidden by solid 2');
    expect(sightWords('z', solids)).toBe('hidden by another solid');
    for (const letter of 'BVOISC') expect(sightWords(letter, solids)).not.toContain('not seen');
    expect(sightWords('?', solids)).toBe('not seen (?)');
    expect([hiderOf('a'), hiderOf('y'), hiderOf('z'), hiderOf('O')]).toEqual([0, 24, null, null]);
  });
  it('joins both cameras, and targets of a kind', () => {
    const { bodies } = report();
    expect(targetWords(bodies[0], 0, 0, solids)).toBe('seen by both cameras');
    expect(targetWords(bodies[0], 1, 0, solids)).toBe('too oblique for the right camera');
    expect(targetWords(bodies[0], 1, 1, solids)).toBe('hidden by casing for the left camera, outside the image for the right camera');
    expect(sightSentence(bodies[0], [0, 1], 0, solids)).toBe('P1 seen by both cameras; P2 too oblique for the right camera');
    const twice = { ...bodies[0], sight: [bodies[0].sight[1], bodies[0].sight[1]] as [string, string][] };
    expect(sightSentence(twice, [0, 1], 0, solids)).toBe('P1, P2 too oblique for the right camera');
  });
  it('is told by stretches and shares', () => {
    expect(seenCode(['.a', '.O'], 0)).toBe('3');
    expect(seenCode(['.a', 'O.'], 1)).toBe('2');
    expect(sightRuns(['..a', '..O'])).toEqual([{ code: '3', first: 0, last: 1 }, { code: '0', first: 2, last: 2 }]);
    const [first] = reasonShares(report().bodies[0], solids);
    expect(first.share).toBeCloseTo(1 / 8);
  });
  it('is drawn up to what hides a target, else as a stub at the target', () => {
    const eyes: [Vec3, Vec3] = [[0, 0, 0], [400, 0, 0]];
    const rays = sightRays(report(), 0, 1, eyes, () => [1, 2, 3]);
    expect(rays.seen).toEqual([[0, 0, 0], [10, 0, 2000], [400, 0, 0], [10, 0, 2000]]);
    expect(rays.broken.slice(0, 2)).toEqual([[0, 0, 0], [1, 2, 3]]);
    expect(rays.broken[2].map(Math.round)).toEqual([10, 300, 2000]);  // P2 has turned onto y
    expect(rays.broken[3][2]).toBeCloseTo(2000 * 0.86);
  });
});

describe('measuring', () => {
  it('tells lengths along the tracker and along the part as both turn', () => {
    const cell = report();
    const [a, b] = namedSpots(cell).filter((spot) => spot.name.startsWith('platform'));
    expect(distance(cell, a, b, 0).inTracker).toEqual([300, 0, 0]);
    const later = distance(cell, a, b, 1);
    expect(later.length).toBeCloseTo(300);
    [0, 300, 0].forEach((value, k) => expect(later.inTracker[k]).toBeCloseTo(value));
    // O_g is turned by 90° against the platform: x of the platform is −y of the part.
    [0, -300, 0].forEach((value, k) => expect(later.inPart[k]).toBeCloseTo(value));
  });
  it('keeps a picked place on what carries it', () => {
    const cell = report();
    const spot = spotAt(cell, 'casing', 0, [10, 20, 2000], 1);
    placeOf(cell, spot, 1).forEach((value, k) => expect(value).toBeCloseTo([10, 20, 2000][k]));
    placeOf(cell, spot, 0).forEach((value, k) => expect(value).toBeCloseTo([20, 0, 2000][k]));
    expect(placeOf(cell, { name: '', carrier: -1, at: [1, 2, 3] }, 1)).toEqual([1, 2, 3]);
  });
  it('takes the workpiece\'s frame, else that of what carries it', () => {
    expect(partFrame(report()).name).toBe('O_g workpiece');
    expect(partFrame({ ...report(), axes: [] })).toMatchObject({ name: 'platform', carrier: 0 });
  });
});

describe('the series of a cell', () => {
  it('have a 95 % bound where a covariance is known', () => {
    const [bound, none] = bound95(report().points[0]);
    expect(bound).toBeGreaterThan(0.03 * 1.96);
    expect(bound).toBeLessThan(0.03 * kEllipsoid95);
    expect(none).toBeNull();
    expect(above([0.1, null, 0.3], 0.25)).toEqual({ frames: 1, of: 2 });
  });
  it('become figures with the lines that count', () => {
    const cell = report();
    const now = firstCellSelection(cell);
    expect(now.point).toBe(1);
    const figures = cellFigures(cell, { ...now, point: 0 });
    expect(figures.map((figure) => figure.id)).toEqual(['visible', 'coverage', 'point-error', 'rotation-error']);
    expect(figures[0].limits).toEqual([{ label: 'four needed', value: 4 }]);
    expect(figures[0].note).toContain('2 of 2 frames');
    expect(figures[2].limits!.map((limit) => limit.value)).toEqual([0.25, 0.025]);
    expect(figures[2].note).toContain('1 of 1 measured errors');
    expect(figures[2].traces.map((trace) => trace.label)).toEqual(['predicted √tr Σ', 'measured', 'without targets, at their centroid']);
    expect(cellFigures(cell, now)[2].traces[1]).toMatchObject({ label: 'without targets', values: [0.5, 0.6] });
    expect(svgOf(figures[2], () => '#000')).toContain('tolerance');
  });
  it('keep above zero on a logarithmic axis', () => {
    const cell = report();
    cell.points[0].measured_mm = [0, null];
    const figure = cellFigures(cell, { ...firstCellSelection(cell), point: 0, scale: 'log' })[2];
    expect(figure.traces[1].values).toEqual([null, null]);
    expect(figure.bands[0].low[0]).toBeGreaterThan(0);
    expect(svgOf(figure, () => '#000')).not.toContain('NaN');
  });
  it('are saved with the reasons in words', () => {
    const lines = cellAsCsv(report()).split('\n');
    expect(lines[0]).toContain('near bound95_mm');
    expect(lines[0]).toContain('sight P2');
    expect(lines[2]).toContain('"hidden by casing for the left camera, outside the image for the right camera"');
    expect(new Set(lines.slice(0, 1).map((line) => line.split(',').length)).size).toBe(1);
  });
});

describe('axes and tables', () => {
  it('have round numbers on a logarithmic axis', () => {
    expect(logTicks(0.02, 0.6)).toEqual([0.02, 0.05, 0.1, 0.2, 0.5]);
    const [low, high] = logRangeOf(0.031, 0.41);
    expect(low).toBe(0.02);
    expect(high).toBeGreaterThanOrEqual(0.41);
    const axis = chartAxis([1, 100], true, 0, 200, false);
    expect(axis.at(10)).toBeCloseTo(100);
    expect(axis.shows(0)).toBe(false);
    expect(axis.shows(null)).toBe(false);
  });
  it('have cells about their middles', () => {
    expect(bordersAbout([0, 1, 3])).toEqual([-0.5, 0.5, 2, 4]);
    expect(bordersAbout([5])).toEqual([4.5, 5.5]);
  });
  it('are saved with gaps left empty', () => {
    expect(heatAsCsv({ title: '', x_label: 'roll', y_label: 'pitch', value_label: 'n', x: [0, 1], y: [2], value: [[3, null]] })).toBe('roll,pitch,n\n0,2,3\n1,2,\n');
    const curve = { name: 'raw', x: [1, 2], y: [3, null], low: [], high: [], dashed: false };
    expect(chartAsCsv({ id: 'c', title: '', note: '', x_label: 'x', y_label: 'y', log_x: false, log_y: false, curves: [curve], limits: [] })).toBe('curve,x,y,low,high\nraw,1,3,,\nraw,2,,,\n');
  });
  it('write a column with its points under one another', () => {
    expect(placesOf([0.0366, 0.09, 'a', null])).toBe(4);
    expect(placesOf([100, 3])).toBe(0);
    expect(cellText(0.09, 4)).toBe('0.0900');
    expect(cellText(12345, 0)).toBe('12\u202f345');
    expect(cellText(null, 2)).toBe('–');
    expect(cellText(1e-6, placesOf([1e-6, 0.7]))).toBe('0.000001');
    expect(cellText(0.7, 9)).toBe('0.7');
    expect(cellText(3, 9)).toBe('3');
  });
});

describe('a page about a cell', () => {
  it('is known by its schema', () => {
    expect(parseReport(JSON.stringify(report())).schema).toBe('asterism-cell-report/1');
  });
  it('is scaled to everything that moves', () => {
    const cell = report();
    const scales = cellScales(cell, cell.solids.map(meshOfSolid));
    expect(scales.span).toBe(300);
    expect(scales.ellipsoids).toBe(200);  // of the largest that leave 0.09 × 300 mm for 2.8 × 0.03 mm
    expect(scales.far).toBeGreaterThan(2000);
  });
});
