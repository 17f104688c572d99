// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { binMiddles, deviationNote, normalShare } from '../plots/deviation_plot';
import { coverageAsCsv } from '../plots/coverage';
import { deviationColour, deviationReach, kNoShade, shadeOf, tintsOf } from '../plots/shades';
import { apart } from '../plots/spread';
import { tourAsCsv } from '../plots/tour_chart';
import { frustum } from '../scene/view_frustums';
import { deviationTable } from '../tables/scans';
import { meshOfSolid, type Mesh } from './mesh';
import { bitsOf, halfOf, shortsOf, signedBytesOf } from './packed';
import { parseReport } from './parse';
import { areaText, cloudOf, completeShare, coverageLevels, coverageSteps, coveredBy, drawnWords, pointWords, poseWords, tourPieces, Unpacked } from './scan';
import type { DeviationSummary, PlannedView, ScanPlan, ScanReport } from './scan_report';
import { firstScanSelection, modesOf, shadesOf } from './scan_selection';
import { paintedSurface } from './surface_paint';

function packed(array: ArrayBufferView): string {
  return btoa(String.fromCharCode(...new Uint8Array(array.buffer)));
}

const kSummary: DeviationSummary = {
  region: '', points: 2, beyond: 1, mean_mm: -0.25, rms_mm: 0.79, sigma_mm: 0.75, p05_mm: -1, median_mm: 0, p95_mm: 0.5, lowest_mm: -1, highest_mm: 0.5, in_tolerance: 0, below: 0.5, above: 0.5, predicted_rms_mm: 0.1,
};

function plan(): ScanPlan {
  const view = (more: Partial<PlannedView>): PlannedView => ({
    pose: [0, 0, 300, 0, 1, 0, 0], platform: 0, measures: 'BQ==', adds_mm2: 40, mean_incidence_deg: 10, beyond_good_incidence: 0, worst_sigma_mm: null, scanner_targets: 5, platform_targets: 4, starts_s: 1, ...more,
  });
  return {
    samples: 0, poses: [{ yaw_deg: 0, pitch_deg: 0, roll_deg: 0 }, { yaw_deg: 0, pitch_deg: 10, roll_deg: -2.5 }], views: [view({}), view({ platform: 1, measures: 'Ag==', adds_mm2: 20, starts_s: 18 })],
    bound: 2, optimal: true, greedy_views: 3, candidates: 900, in_words: '2 views, optimal', surface_mm2: 100, reachable_mm2: 95, coverable_mm2: 90, covered_before_mm2: 30, covered_mm2: 90,
    limits: [{ limit: 'incidence', area_mm2: 5 }], covered_before: 'BA==', tour_s: 23, nearest_neighbour_s: 30, remarks: [],
  };
}

/// The same small report as the program's own test has.
function report(): ScanReport {
  return {
    schema: 'asterism-scan-report/1', title: 't', subtitle: '', links: [], summary: [], remarks: [], options: null, tolerance_mm: 0.1, view_s: 5, turn_s: 10, tables: [], charts: [],
    scanner: { stand_off_mm: 300, near_mm: 200, far_mm: 400, field_width_mm: 350, field_height_mm: 310, baseline_mm: 160, max_incidence_deg: 60, good_incidence_deg: 45 },
    surface: { name: 'cone', role: 'workpiece', carrier: -1, vertices: 'AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA', triangles: 'AAAAAAEAAAACAAAA', error_mm: [] },
    sample_lists: [{ places: packed(new Float32Array([0, 0, 0, 1, 0, 0, 2, 0, 0])), normals: packed(new Int8Array([0, 0, 127, 0, 0, 127, 0, 0, 127])), areas_mm2: packed(new Float32Array([1, 1, 1])) }],
    rounds: [
      {
        name: 'platform at rest', plan: plan(),
        cloud: {
          points: 5000, drawn: 3, voxel_mm: 2, low_mm: [0, 0, 0], step_mm: 0.001, places: 'AAAAAAAA6AMAAAAAAAD//wAA', normals: 'AAB/AACBAAAA',
          fields: [{ name: 'deviation_mm', whole: false, values: 'ADgAfgC8' }, { name: 'sigma_mm', whole: false, values: 'ADwAfgBA' }, { name: 'scan', whole: true, values: 'AAABAP//' }],
        },
        completeness: { samples: 0, measured: 'BQ==', surface_mm2: 3, measured_mm2: 2, holes: [{ area_mm2: 1, centre: [1, 0, 0], normal: [0, 0, 1], across_mm: 0, samples: 'AQAAAA==' }] },
        deviation: { whole: kSummary, regions: [{ ...kSummary, region: 'rim' }], bin_mm: 0.1, histogram: [1, 2, 0] },
      },
      { name: 'empty', plan: null, cloud: null, completeness: null, deviation: null },
    ],
  };
}

describe('packed numbers', () => {
  it('come out as half floats, none as NaN', () => {
    expect([0x3c00, 0xc000, 0x2e66, 0x0001, 0x0000].map(halfOf)).toEqual([1, -2, 0.0999755859375, 2 ** -24, 0]);
    expect(halfOf(0x7e00)).toBeNaN();
    expect(halfOf(0xfc00)).toBe(-Infinity);
  });
  it('come out as bits, bytes and shorts, the lowest first', () => {
    expect([...bitsOf('BQ==')]).toEqual([1, 0, 1, 0, 0, 0, 0, 0]);
    expect([...signedBytesOf('AAB/AACB')]).toEqual([0, 0, 127, 0, 0, -127]);
    expect([...shortsOf('AQIDBA==')]).toEqual([0x0201, 0x0403]);
  });
});

describe('a scan report', () => {
  it('is known by its schema and has the keys that the program writes', () => {
    const one = report();
    expect(parseReport(JSON.stringify(one)).schema).toBe('asterism-scan-report/1');
    // The same lists as in src/asterism/report/scan_report_test.cpp.
    expect(Object.keys(one).sort()).toEqual(['charts', 'links', 'options', 'remarks', 'rounds', 'sample_lists', 'scanner', 'schema', 'subtitle', 'summary', 'surface', 'tables', 'title', 'tolerance_mm', 'turn_s', 'view_s']);
    expect(Object.keys(one.rounds[0].plan!).sort()).toEqual(['bound', 'candidates', 'coverable_mm2', 'covered_before', 'covered_before_mm2', 'covered_mm2', 'greedy_views', 'in_words', 'limits', 'nearest_neighbour_s', 'optimal', 'poses', 'reachable_mm2', 'remarks', 'samples', 'surface_mm2', 'tour_s', 'views']);
    expect(Object.keys(one.rounds[0].plan!.views[0]).sort()).toEqual(['adds_mm2', 'beyond_good_incidence', 'mean_incidence_deg', 'measures', 'platform', 'platform_targets', 'pose', 'scanner_targets', 'starts_s', 'worst_sigma_mm']);
    expect(Object.keys(one.rounds[0].cloud!).sort()).toEqual(['drawn', 'fields', 'low_mm', 'normals', 'places', 'points', 'step_mm', 'voxel_mm']);
    expect(Object.keys(one.rounds[0].completeness!).sort()).toEqual(['holes', 'measured', 'measured_mm2', 'samples', 'surface_mm2']);
    expect(Object.keys(kSummary).sort()).toEqual(['above', 'below', 'beyond', 'highest_mm', 'in_tolerance', 'lowest_mm', 'mean_mm', 'median_mm', 'p05_mm', 'p95_mm', 'points', 'predicted_rms_mm', 'region', 'rms_mm', 'sigma_mm']);
  });
  it('offers only what it has', () => {
    expect(modesOf(report())).toEqual(['plan', 'cloud', 'completeness']);
    expect(shadesOf(report())).toEqual(['deviation', 'scan', 'sigma', 'plain']);
    const bare = { ...report(), rounds: [report().rounds[1]] };
    expect(modesOf(bare)).toEqual([]);
    expect(firstScanSelection(bare)).toMatchObject({ mode: 'plan', shade: 'plain', against: 0 });
  });
  it('unpacks each list once, and nothing where there is none', () => {
    const data = new Unpacked(report());
    expect(data.samplesAt(0)).toBe(data.samplesAt(0));
    expect(data.samplesAt(-1)).toBeNull();
    expect(data.cloudOf(0)!.count).toBe(3);
    expect(data.cloudOf(1)).toBeNull();
    expect([...data.samplesOfHole(report().rounds[0].completeness!.holes[0])]).toEqual([1]);
  });
});

describe('a cloud', () => {
  const cloud = cloudOf(report().rounds[0].cloud!);
  it('has its points where they were, with what is known of each', () => {
    expect([...cloud.positions].map((value) => Number(value.toFixed(3)))).toEqual([0, 0, 0, 1, 0, 0, 0, 65.535, 0]);
    expect([...cloud.fields.get('deviation_mm')!]).toEqual([0.5, NaN, -1]);
    expect([...cloud.fields.get('scan')!]).toEqual([0, 1, NaN]);
    expect(cloud.spacing_mm).toBe(2);
  });
  it('tells a point in words and leaves out what is not known', () => {
    expect(pointWords(cloud, 0)).toBe('x 0.0  y 0.0  z 0.0 mm · deviation +0.500 mm · σ 1.0 mm · scan 0');
    expect(pointWords(cloud, 1)).toBe('x 1.0  y 0.0  z 0.0 mm · belongs to no surface · scan 1');
  });
  it('says how many of how many are drawn', () => {
    expect(drawnWords(report().rounds[0])).toBe('3 of 5\u202f000 points are drawn, one in each 2.0 mm');
    expect(drawnWords(report().rounds[1])).toBe('no cloud yet');
  });
  it('has grey points where nothing is told and one colour a scan', () => {
    const hex = (tints: Uint8Array, i: number) => `#${[0, 1, 2].map((k) => tints[3 * i + k].toString(16).padStart(2, '0')).join('')}`;
    const scale = shadeOf(report(), [cloud], 'deviation');
    const tints = tintsOf(cloud, 'deviation', scale, '#000000');
    expect(hex(tints, 1)).toBe(kNoShade);
    expect(hex(tints, 0)).not.toBe(hex(tints, 2));
    const scans = tintsOf(cloud, 'scan', shadeOf(report(), [cloud], 'scan'), '#000000');
    expect([hex(scans, 0), hex(scans, 1), hex(scans, 2)]).toEqual(['#0072b2', '#e69f00', kNoShade]);
    expect(hex(tintsOf(cloud, 'plain', null, '#123456'), 2)).toBe('#123456');
  });
});

describe('deviations', () => {
  it('step in colour at the tolerance and go on getting darker beyond', () => {
    const light = (colour: string) => [1, 3, 5].reduce((sum, k) => sum + parseInt(colour.slice(k, k + 2), 16), 0);
    expect(deviationColour(0.0999, 0.1, 0.3)).not.toBe(deviationColour(0.1001, 0.1, 0.3));
    for (const sign of [-1, 1]) expect(light(deviationColour(sign * 0.3, 0.1, 0.3))).toBeLessThan(light(deviationColour(sign * 0.15, 0.1, 0.3)));
    expect(deviationColour(9, 0.1, 0.3)).toBe(deviationColour(0.3, 0.1, 0.3));
  });
  it('reach three tolerances, farther where many are farther', () => {
    expect(deviationReach([0.01, -0.02], 0.1)).toBeCloseTo(0.3);
    expect(deviationReach(Array(100).fill(-0.5), 0.1)).toBeCloseTo(0.8);
    expect(deviationReach([], 0.1)).toBeCloseTo(0.3);
  });
  it('lie in bins about zero, which a normal curve fills wholly', () => {
    const deviation = { whole: kSummary, regions: [], bin_mm: 0.1, histogram: Array(61).fill(0) };
    expect(binMiddles(deviation)[0]).toBeCloseTo(-3);
    expect(binMiddles(deviation)[30]).toBe(0);
    expect(binMiddles(deviation).reduce((sum, middle) => sum + normalShare(middle, 0.1, 0.5), 0)).toBeCloseTo(1, 6);
  });
  it('are told in words and by region', () => {
    expect(deviationNote(report().rounds[0].deviation!, 0.1)).toBe('0 % within ±0.10 mm; mean −0.25 mm, RMS 0.790 mm, predicted 0.100 mm, of 2 points; 1 lie too far off to belong to this surface.');
    const table = deviationTable(report(), 0)!;
    expect(table.rows.map((row) => row[0])).toEqual(['whole', 'rim']);
    expect(table.rows[0]).toHaveLength(table.columns.length);
    expect(deviationTable(report(), 1)).toBeNull();
  });
});

describe('a plan', () => {
  it('covers more with each view, up to the levels', () => {
    expect(coverageSteps(plan())).toEqual([0.3, 0.7, 0.9]);
    expect(coverageLevels(plan()).map((level) => level.share)).toEqual([1, 0.95, 0.9]);
    expect(coverageSteps({ ...plan(), surface_mm2: 0 })).toEqual([0, 0, 0]);
    expect([...coveredBy(plan(), new Unpacked(report()))]).toEqual([1, 1, 1, 0, 0, 0, 0, 0]);
    expect(coverageAsCsv(plan())).toBe('views,share_of_surface,adds_mm2,platform_pose\n0,0.3,,\n1,0.7,40,1\n2,0.9,20,2\n');
  });
  it('is a tour of views, a turn between those of other poses, and the ways', () => {
    const pieces = tourPieces(plan(), 5, 10).map(({ kind, view, from, to }) => [kind, view, from, to]);
    expect(pieces).toEqual([['way', 0, 0, 1], ['view', 0, 1, 6], ['turn', 1, 6, 16], ['way', 1, 16, 18], ['view', 1, 18, 23]]);
    expect(tourAsCsv(plan(), report()).split('\n')[3]).toBe('turn,2,2,6,16');
    // A turn that is given less time than it should take fills what there is.
    expect(tourPieces(plan(), 5, 100).filter(({ kind }) => kind === 'turn')).toMatchObject([{ from: 6, to: 18 }]);
  });
  it('names the platform\'s poses', () => {
    expect(plan().poses.map(poseWords)).toEqual(['at rest', 'pitch 10°, roll −2.5°']);
  });
  it('has frustums that reach the field at the stand-off', () => {
    // The scanner 300 mm above, looking down: half a turn about x.
    const { apex, corners } = frustum(plan().views[0], report().scanner, 1);
    expect(apex).toEqual([0, 0, 300]);
    corners[0].forEach((value, k) => expect(value).toBeCloseTo([-175, 155, 0][k], 9));
  });
});

describe('what is measured', () => {
  it('is a share, none where nothing is told', () => {
    expect(completeShare(report().rounds[0])).toBeCloseTo(2 / 3);
    expect(completeShare(report().rounds[1])).toBeNull();
  });
  it('has areas in the unit that keeps them short', () => {
    expect([3.6e6, 13200, 45].map(areaText)).toEqual(['3.60 m²', '132 cm²', '45 mm²']);
  });
  it('colours each piece of the surface by the nearest sample on its side', () => {
    const mesh: Mesh = meshOfSolid({ vertices: packed(new Float32Array([0, 0, 0, 10, 0, 0, 0, 10, 0])), triangles: 'AAAAAAEAAAACAAAA' });
    const samples = { count: 3, places: new Float32Array([1, 1, 0, 8, 1, 0, 1, 1, 0.1]), normals: new Int8Array([0, 0, 127, 0, 0, 127, 0, 0, -127]), areas: new Float32Array([25, 25, 25]) };
    const painted = paintedSurface(mesh, samples);
    const area = painted.sample.reduce((sum, _, t) => {
      const [a, b, c] = [0, 3, 6].map((k) => [painted.positions[9 * t + k], painted.positions[9 * t + k + 1]]);
      return sum + Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
    }, 0);
    expect(area).toBeCloseTo(50, 4);
    expect(painted.sample.includes(2)).toBe(false);  // lies nearer, but faces the other way
    painted.sample.forEach((sample, t) => {
      const x = (painted.positions[9 * t] + painted.positions[9 * t + 3] + painted.positions[9 * t + 6]) / 3;
      if (sample >= 0) expect(sample).toBe(x < 4.5 ? 0 : 1);
    });
  });
});

describe('names at a plot\'s side', () => {
  it('stay where they are when there is room', () => {
    expect(apart([10, 50, 100], 14)).toEqual([10, 50, 100]);
  });
  it('move apart about their middle when there is none, also in a chain', () => {
    expect(apart([100, 100, 100], 10)).toEqual([90, 100, 110]);
    expect(apart([100, 102, 91], 10)).toEqual([97.66666666666667, 107.66666666666667, 87.66666666666667].map((value) => expect.closeTo(value, 9)));
  });
});
