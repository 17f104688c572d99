// SPDX-License-Identifier: Apache-2.0
import { rotationErrors, summarise, translationErrors, type ErrorSummary } from '../data/errors';
import { count, percent, significant } from '../data/format';
import { h } from '../dom';
import type { TrackingReport } from '../data/report';

/// Errors against truth by body, source and kind; nothing without truth.
export function errorSection(report: TrackingReport): HTMLElement | null {
  if (!report.bodies.some((body) => body.truth)) return null;
  const rows = report.bodies.flatMap((body) => (body.filtered ? (['measured', 'filtered'] as const) : (['measured'] as const)).flatMap((source) => [
    line(body.name, source, `translation of ${body.point.name}`, 'mm', summarise(translationErrors(body, source, 'size'))),
    line(body.name, source, 'rotation', 'deg', summarise(rotationErrors(body, source, 'size'))),
  ]));
  const heads = ['Body', 'Pose', 'Error of', 'Unit', 'Frames', 'Mean', 'RMS', '95 % of errors below', 'Largest', 'Stated 95 % bound (median)', 'Inside the bound'];
  return h('section', { 'aria-labelledby': 'errors', class: 'panel' },
    h('h2', { id: 'errors' }, 'Error against truth'),
    h('p', { class: 'note' }, 'Size of the error. An honest uncertainty holds about 95 % of the errors inside its stated bound; far more means it was overstated.'),
    h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Error against truth' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ...heads.map((head, i) => h('th', { scope: 'col', class: i > 3 ? 'number' : '' }, head)))),
      h('tbody', {}, ...rows))));
}

function line(body: string, source: string, what: string, unit: string, s: ErrorSummary): HTMLElement {
  const cell = (text: string) => h('td', { class: 'number' }, text);
  return h('tr', {}, h('th', { scope: 'row' }, body), h('td', {}, source), h('td', {}, what), h('td', { class: 'unit' }, unit),
    cell(count(s.frames)), ...[s.mean, s.rms, s.p95, s.max, s.band].map((value) => cell(significant(value))),
    cell(s.inside === null ? '–' : `${percent(s.inside)} %`));
}
