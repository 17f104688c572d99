// SPDX-License-Identifier: Apache-2.0
import { decimals, percent, significant } from '../data/format';
import type { TrackingReport } from '../data/report';
import { present, quantile } from '../data/statistics';
import { summariseTarget, type CameraResidual, type TargetSummary } from '../data/targets';
import { h } from '../dom';

const kHeads = ['Target', 'Diameter (mm)', 'Seen (share of measured frames)', 'Both (%)', 'Left only (%)', 'Right only (%)', 'Hidden (%)',
  'Residual left, RMS (px)', 'mean x, y (px)', 'Residual right, RMS (px)', 'mean x, y (px)'];

/// Each target: how often which camera saw it, and its residuals.
export function targetSection(report: TrackingReport): HTMLElement {
  const all = report.bodies.map((body) => body.sightings.map((sightings) => summariseTarget(body, sightings)));
  const usual = quantile(present(all.flat().flatMap((t) => [t.leftResidual.rms, t.rightResidual.rms])), 0.5);
  return h('section', { 'aria-labelledby': 'targets', class: 'panel' },
    h('h2', { id: 'targets' }, 'Targets'),
    h('p', { class: 'note' }, 'Residuals: measured less computed centre, RMS per axis. ',
      h('span', { class: 'flagged' }, 'Marked'), ' where above twice the median of all: a target that moved, a wrong coordinate or a disturbed image. A mean far from zero points to the coordinates or the rig.'),
    h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Targets' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ...kHeads.map((head, i) => h('th', { scope: 'col', class: i === 1 || i > 2 ? 'number' : '' }, head)))),
      ...report.bodies.map((body, b) => h('tbody', {},
        h('tr', { class: 'group' }, h('th', { scope: 'colgroup', colspan: kHeads.length }, body.name)),
        ...body.targets.map((target, i) => line(target.id, target.diameter_mm, all[b][i], usual)))))));
}

function line(id: string, diameter: number | undefined, t: TargetSummary, usual: number | null): HTMLElement {
  const cell = (text: string, flagged = false) => h('td', { class: flagged ? 'number flagged' : 'number' }, text);
  const residual = ({ rms, mean }: CameraResidual) => [
    cell(significant(rms), usual !== null && rms !== null && rms > 2 * usual),
    cell(mean ? `${decimals(mean[0], 4)}, ${decimals(mean[1], 4)}` : '–'),
  ];
  const bar = h('span', { class: 'bar', role: 'img', 'aria-label': `both ${percent(t.both)} %, left only ${percent(t.left)} %, right only ${percent(t.right)} %, hidden ${percent(t.hidden)} %` },
    ...(['both', 'left', 'right'] as const).map((kind) => h('i', { class: kind, style: `width:${t[kind] * 100}%` })));
  return h('tr', {}, h('th', { scope: 'row' }, id), cell(diameter === undefined ? '–' : significant(diameter, 4)), h('td', {}, bar),
    ...[t.both, t.left, t.right, t.hidden].map((part) => cell(percent(part))), ...residual(t.leftResidual), ...residual(t.rightResidual));
}
