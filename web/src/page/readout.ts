// SPDX-License-Identifier: Apache-2.0
import { kNormal95 } from '../data/bands';
import { posesOf, statusOf } from '../data/errors';
import { decimals, significant } from '../data/format';
import { apply, motionOf, pointCovariance, rotationCovariance, sigmas } from '../data/pose';
import { kDegPerRad, rotationVector } from '../data/quaternion';
import type { BodyTrack, TrackingReport } from '../data/report';
import type { Selection, Shared } from '../data/selection';
import type { Status } from '../data/status';
import { h } from '../dom';
import { bodyColour } from '../plots/figures';
import { statusBadge } from '../plots/status_strip';

const kHeads = ['Body', 'Status', 'Targets', 'RMS (px)', 'x', 'y', 'z (mm)', 'rx', 'ry', 'rz (deg)'];

/// The frame in numbers: status, pose of the named point with ±95 %, by body.
export function readout(report: TrackingReport, shared: Shared): HTMLElement {
  const body = h('tbody');
  const show = () => body.replaceChildren(...report.bodies.map((track, i) => line(track, i, shared)));
  shared.watch(show);
  show();
  return h('div', { class: 'scroll readout', tabindex: 0, role: 'region', 'aria-label': 'The current frame in numbers' }, h('table', { class: 'data' },
    h('thead', {}, h('tr', {}, ...kHeads.map((head, i) => h('th', { scope: 'col', class: i > 1 ? 'number' : '' }, head)))), body));
}

function line(track: BodyTrack, index: number, shared: Shared): HTMLElement {
  const { frame, source, body }: Selection = shared.now;
  const row = posesOf(track, source)[frame];
  const status = statusOf(track, source)[frame] as Status;
  const pick = h('button', { type: 'button', class: 'link body-name', style: `--key: var(${bodyColour(index)})`, 'aria-pressed': String(index === body), onclick: () => shared.set({ body: index }) }, track.name);
  const cells = row ? poseCells(row, track) : [h('td', { colspan: 6, class: 'none' }, 'no pose is given')];
  return h('tr', { class: index === body ? 'active' : '' }, h('th', { scope: 'row' }, pick), h('td', {}, statusBadge(status)),
    h('td', { class: 'number' }, `${track.targets_used[frame]}/${track.targets.length}`),
    h('td', { class: 'number' }, significant(track.rms_px[frame])), ...cells);
}

function poseCells(row: number[], track: BodyTrack): HTMLElement[] {
  const motion = motionOf(row);
  const place = apply(motion, track.point.position_mm);
  const turn = rotationVector(motion.rotation);
  const of = (values: number[], sigma: number[], places: number) => values.map((value, k) =>
    h('td', { class: 'number' }, decimals(value, places), h('small', {}, `±${significant(kNormal95 * sigma[k], 2)}`)));
  return [...of(place, sigmas(pointCovariance(row)), 3),
    ...of(turn.map((v) => v * kDegPerRad), sigmas(rotationCovariance(row)).map((v) => v * kDegPerRad), 4)];
}
