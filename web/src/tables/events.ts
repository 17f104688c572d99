// SPDX-License-Identifier: Apache-2.0
import { count, decimals } from '../data/format';
import type { TrackingReport } from '../data/report';
import type { Shared } from '../data/selection';
import { runs, type Run } from '../data/status';
import { h } from '../dom';
import { statusBadge } from '../plots/status_strip';

interface Event {
  body: number;
  run: Run;
}

const kShown = 200;

/// Every stretch of frames in which a body was not plainly OK, longest matter first; a click goes there.
export function eventSection(report: TrackingReport, shared: Shared): HTMLElement {
  const events = report.bodies.flatMap((body, i) => runs(body.status).filter((run) => run.status !== 'O').map((run): Event => ({ body: i, run })));
  events.sort((a, b) => a.run.first - b.run.first);
  const { frame, time_s } = report.frames;
  const rows = events.slice(0, kShown).map(({ body, run }) => h('tr', {},
    h('td', { class: 'number' }, h('button', {
      type: 'button', class: 'link', title: 'Show this frame',
      onclick: () => {
        shared.set({ body, frame: run.first });
        document.getElementById('cell')?.scrollIntoView({ block: 'start' });
      },
    }, decimals(time_s[run.first], 3))),
    h('td', { class: 'number' }, run.first === run.last ? String(frame[run.first]) : `${frame[run.first]} – ${frame[run.last]}`),
    h('td', { class: 'number' }, count(run.last - run.first + 1)),
    h('th', { scope: 'row' }, report.bodies[body].name),
    h('td', {}, statusBadge(run.status))));
  return h('section', { 'aria-labelledby': 'events', class: 'panel' },
    h('h2', { id: 'events' }, 'Events'),
    events.length === 0
      ? h('p', {}, 'Every body was OK in every frame.')
      : h('div', { class: 'scroll tall', tabindex: 0, role: 'region', 'aria-label': 'Events' }, h('table', { class: 'data narrow' },
        h('thead', {}, h('tr', {}, ...['From (s)', 'Frames', 'Count', 'Body', 'Status'].map((head, i) => h('th', { scope: 'col', class: i < 3 ? 'number' : '' }, head)))),
        h('tbody', {}, ...rows))),
    events.length > kShown && h('p', { class: 'note' }, `The first ${kShown} of ${count(events.length)}; all frames are in the CSV.`));
}
