// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { formOf, inkOf, spanOf, wrapped } from '../plots/layout_marks';
import { historyFigures, motionFigures } from '../plots/layout_figures';
import { ramp } from '../plots/ramp';
import { layoutScales } from '../scene/layout_scene';
import { bordersOf, sheetsOfPatch, sheetsOfSolid } from '../scene/solids';
import { bodyAsToml } from '../tables/chosen';
import { tableAsCsv } from '../tables/layouts';
import { bestIn, countSeen, frontOf, sacrifices, type Layout, type LayoutReport } from './layout';
import { firstSelection } from './layout_selection';
import { parseReport } from './parse';
import type { MotionRow, Vec3 } from './parts';

function layout(name: string, values: (number | null)[], more: Partial<Layout> = {}): Layout {
  const targets = [0, 1, 2, 3].map((k) => ({ id: `P${k + 1}`, position_mm: [100 * k, 10 * k * k, 0] as Vec3, normal: [0, 0, 1] as Vec3, diameter_mm: 12 }));
  return { name, origin: 'found', reference: false, targets, values, fails: [], seen: ['33', '31', '30', '32'], error_mm: [0.01, null], error_lost_mm: [0.02, null], notes: [], ...more };
}

function report(): LayoutReport {
  const lens = { fx: 1000, fy: 1000, skew: 0, cx: 320, cy: 240, distortion: [], width_px: 640, height_px: 480 };
  const still: MotionRow = [0, 0, 2000, 1, 0, 0, 0];
  return {
    schema: 'asterism-layout-report/1', title: 't', subtitle: '', summary: [], remarks: [], body: 'platform "A"', options: null,
    rig: { left: lens, right: lens, right_from_left: [-400, 0, 0, 1, 0, 0, 0] }, volume: null, patches: [], keep_outs: [], obstacles: [],
    points: [{ name: 'flange', position_mm: [0, 0, 300] }], motion: { time_s: [0, 1], pose: [still, still] },
    measures: [
      { name: 'targets', label: 'targets', unit: '', better: 'less', objective: true },
      { name: 'margin', label: 'margin', unit: 'mm', better: 'more', objective: true },
      { name: 'spacing', label: 'spacing', unit: 'mm', better: 'none', objective: false },
    ],
    layouts: [
      layout('a', [4, 1, 100]), layout('b', [6, 3, 120]), layout('c', [6, 2, 130]),
      layout('present', [3, 9, 90], { reference: true }), layout('broken', [2, 99, null], { reference: true, fails: ['margin too small'] }),
    ],
    knee: 1, why: 'because', history: [{ generation: 0, evaluations: 10, hypervolume: 0.5, feasible_share: 0.5, seconds: 0.1 }],
  };
}

describe('the front', () => {
  it('leaves out what another beats in both measures, whichever end is better', () => {
    expect(frontOf(report(), [0, 1, 2], 0, 1)).toEqual([0, 1]);
    expect(frontOf(report(), [2, 1, 0], 1, 0)).toEqual([1, 0]);
    expect(frontOf(report(), [], 0, 1)).toEqual([]);
  });
  it('holds the best of those found; a given one counts only where none was found', () => {
    expect(bestIn(report(), 0)).toBe(0);
    expect(bestIn(report(), 1)).toBe(1);
    const given = { ...report(), layouts: report().layouts.slice(3) };
    expect(bestIn(given, 1)).toBe(0);
  });
  it('says what is given up, in the unit and as a share of the best', () => {
    const [targets, margin] = sacrifices(report(), 2);
    expect(targets).toMatchObject({ best: 0, lost: 2, share: 0.5 });
    expect(margin).toMatchObject({ best: 1, lost: 1 });
    expect(margin.share).toBeCloseTo(1 / 3, 12);
    expect(sacrifices(report(), 3)[0].lost).toBe(-1);
  });
});

describe('a page about layouts', () => {
  it('is read by its schema', () => {
    expect(parseReport(JSON.stringify(report())).title).toBe('t');
  });
  it('opens at the knee, against the first given layout, with the objectives on the axes', () => {
    expect(firstSelection(report())).toMatchObject({ layout: 1, against: 3, x: 0, y: 1, shade: null });
    expect(firstSelection({ ...report(), knee: null, layouts: [layout('a', [4, 1, 100])] })).toMatchObject({ layout: 0, against: null });
  });
  it('counts the targets that both cameras see', () => {
    expect(countSeen(report().layouts[0])).toEqual([4, 1]);
    expect(motionFigures(report(), firstSelection(report()))[1].traces[1].values).toEqual([0.02, null]);
    expect(historyFigures(report())[1].traces[0].values).toEqual([50]);
  });
  it('tells found, given and failing layouts by form', () => {
    expect([0, 3, 4].map((i) => formOf(report(), i))).toEqual(['disc', 'diamond', 'cross']);
    expect(inkOf(report(), { ...firstSelection(report()), shade: 1 }, 0)).toBe(ramp(0));
  });
  it('does not let a far layout that was given press those found together', () => {
    expect(spanOf(report(), 1)).toEqual([1, 3]);
    expect(spanOf(report(), 0)).toEqual([2, 6]);
    expect(spanOf({ ...report(), layouts: [] }, 0)).toEqual([0, 1]);
  });
  it('gives all measures as CSV and a layout as bodies.toml', () => {
    const lines = tableAsCsv(report()).trim().split('\n');
    expect(lines[0]).toBe('layout,origin,knee,targets,margin_mm,spacing_mm,fails');
    expect(lines[5]).toBe('broken,found,0,2,99,,margin too small');
    expect(bodyAsToml(report().body, report().layouts[0])).toContain('name = "platform \\"A\\""\n\n[[body.target]]\nid = "P1"\nposition_mm = [0, 0, 0]');
  });
  it('breaks long labels between words', () => {
    expect(wrapped('worst error after loss (mm)', 12)).toEqual(['worst error', 'after loss', '(mm)']);
  });
});

describe('surfaces', () => {
  const still: MotionRow = [0, 0, 10, 1, 0, 0, 0];
  it('are closed where they go all the way round: no seam is drawn', () => {
    const side = sheetsOfPatch({ name: 's', kind: 'side', base_mm: [0, 0, 5], radius_mm: 10, height_mm: 4, from_deg: 0, to_deg: 360 });
    expect(bordersOf(side).length).toBe(2 * 2 * 64);
    const part = sheetsOfPatch({ name: 's', kind: 'side', base_mm: [0, 0, 5], radius_mm: 10, height_mm: 4, from_deg: 0, to_deg: 90 });
    expect(bordersOf(part).length).toBe(2 * 2 * 16 + 2 * 2);
    for (const [x, y, z] of part.flat(2)) {
      expect(Math.hypot(x, y)).toBeCloseTo(10, 9);
      expect([5, 9]).toContain(z);
    }
  });
  it('of solids lie where the solid does', () => {
    const box = sheetsOfSolid({ name: 'b', shape: 'box', pose: still, size_mm: [2, 4, 6] }).flat(2);
    expect([Math.min(...box.map((p) => p[2])), Math.max(...box.map((p) => p[2]))]).toEqual([7, 13]);
    const capsule = sheetsOfSolid({ name: 'c', shape: 'capsule', pose: still, from_mm: [0, 0, 0], to_mm: [10, 0, 0], radius_mm: 2 }).flat(2);
    expect(Math.min(...capsule.map((p) => p[0]))).toBeCloseTo(-2, 9);
    expect(Math.max(...capsule.map((p) => p[0]))).toBeCloseTo(12, 9);
    for (const [x, y, z] of capsule) expect(Math.hypot(Math.min(0, x) + Math.max(0, x - 10), y, z - 10)).toBeCloseTo(2, 9);
  });
  it('and targets set the scale of the view', () => {
    const scales = layoutScales(report());
    expect(scales.span).toBe(300);
    expect(scales.places.length).toBe(16);
  });
});
