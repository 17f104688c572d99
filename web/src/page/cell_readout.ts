// SPDX-License-Identifier: Apache-2.0
import { bound95 } from '../data/cell_errors';
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { decimals, significant } from '../data/format';
import { motionOf } from '../data/pose';
import { conjugate, kDegPerRad, product, rotationVector } from '../data/quaternion';
import type { Shared } from '../data/selection';
import { seenCode } from '../data/sight';
import type { Status } from '../data/status';
import { h } from '../dom';
import { statusBadge } from '../plots/status_strip';

/// The moment in numbers: where each body is, how many of its targets are seen; what the error is at each point.
export function cellReadout(report: CellReport, shared: Shared<CellSelection>): HTMLElement {
  const bounds = report.points.map(bound95);
  const [bodies, points] = [h('tbody'), h('tbody')];
  const show = () => {
    bodies.replaceChildren(...report.bodies.map((_, b) => bodyLine(report, b, shared)));
    points.replaceChildren(...report.points.map((_, p) => pointLine(report, p, bounds[p][shared.now.frame], shared)));
  };
  shared.watch((now, before) => (now.frame !== before.frame || now.point !== before.point || now.body !== before.body) && show());
  show();
  const table = (heads: string[], plain: number, body: HTMLElement) => h('table', { class: 'data' },
    h('thead', {}, h('tr', {}, ...heads.map((head, i) => h('th', { scope: 'col', class: i >= plain ? 'number' : '' }, head)))), body);
  return h('div', { class: 'scroll readout', tabindex: 0, role: 'region', 'aria-label': 'The present moment in numbers' },
    table(['Body', ...(report.status ? ['Status'] : []), 'Seen by both', 'x', 'y', 'z (mm)', 'rx', 'ry', 'rz (deg)'], report.status ? 2 : 1, bodies),
    report.points.length > 0 && table(['Point', 'predicted (mm)', '95 % below', ...(report.points.some((point) => point.measured_mm.length > 0) ? ['measured'] : [])], 1, points));
}

function bodyLine(report: CellReport, b: number, shared: Shared<CellSelection>): HTMLElement {
  const { frame, body } = shared.now;
  const { name, pose, sight, targets } = report.bodies[b];
  const motion = motionOf(pose[frame]);
  const turn = rotationVector(product(conjugate(motionOf(pose[0]).rotation), motion.rotation));
  const both = sight.filter((sides) => seenCode(sides, frame) === '3').length;
  const number = (text: string, flagged = false) => h('td', { class: flagged ? 'number flagged' : 'number' }, text);
  const status = b === report.body && report.status ? statusBadge(report.status[frame] as Status) : null;
  return h('tr', { class: b === body ? 'active' : '' },
    h('th', { scope: 'row' }, h('button', { type: 'button', class: 'link', 'aria-pressed': String(b === body), title: 'Show its lines of sight', onclick: () => shared.set({ body: b }) }, name)),
    report.status !== '' && h('td', {}, status), number(`${both}/${targets.length}`, both < 4),
    ...motion.translation.map((value) => number(decimals(value, 2))), ...turn.map((value) => number(decimals(value * kDegPerRad, 3))));
}

function pointLine(report: CellReport, p: number, bound: number | null, shared: Shared<CellSelection>): HTMLElement {
  const { frame, point: chosen } = shared.now;
  const point = report.points[p];
  const number = (value: number | null | undefined) => h('td', { class: value != null && value > report.tolerance_mm ? 'number flagged' : 'number' }, value === null ? 'not determined' : significant(value, 3));
  return h('tr', { class: p === chosen ? 'active' : '' },
    h('th', { scope: 'row' }, h('button', { type: 'button', class: 'link', 'aria-pressed': String(p === chosen), title: 'Plot its error', onclick: () => shared.set({ point: p }) }, point.name)),
    number(point.predicted_mm[frame]), number(bound), point.measured_mm.length > 0 && number(point.measured_mm[frame]));
}
