// SPDX-License-Identifier: Apache-2.0
import { csv } from '../data/csv';
import { count, decimals, percent, significant } from '../data/format';
import type { CellTable } from '../data/cell_report';
import { areaText, completeShare, poseWords } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import type { ScanSelection } from '../data/scan_selection';
import type { Shared } from '../data/selection';
import { download, h } from '../dom';

type Cells = (string | number | HTMLElement | null)[];

function row(cells: Cells, numeric: (k: number) => boolean, active: boolean): HTMLElement {
  return h('tr', { class: active ? 'active' : '' }, ...cells.map((cell, k) =>
    h(k === 0 ? 'th' : 'td', { class: numeric(k) ? 'number' : '', ...(k === 0 ? { scope: 'row' } : {}) }, cell instanceof HTMLElement ? cell : String(cell ?? '–'))));
}

function table(title: string, id: string, heads: string[], numeric: (k: number) => boolean, body: HTMLElement, save: () => string, note = ''): HTMLElement {
  return h('section', { class: 'panel', 'aria-labelledby': `${id}-title` },
    h('div', { class: 'bar-row' }, h('h2', { id: `${id}-title` }, title), h('span', { class: 'exports' }, h('button', { type: 'button', title: 'Save the table', onclick: () => download(`${id}.csv`, new Blob([save()], { type: 'text/csv' })) }, 'CSV'))),
    note !== '' && h('p', { class: 'note' }, note),
    h('div', { class: 'scroll tall', tabindex: 0, role: 'region', 'aria-label': title }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ...heads.map((head, k) => h('th', { scope: 'col', class: numeric(k) ? 'number' : '' }, head)))), body)));
}

function chooser(text: string, title: string, pressed: boolean, choose: () => void): HTMLElement {
  return h('button', { type: 'button', class: 'link', title, 'aria-pressed': String(pressed), onclick: choose }, text);
}

/// What each round brought: views, what is measured, how well. A round's name shows it.
export function roundTable(report: ScanReport, shared: Shared<ScanSelection>): HTMLElement {
  const body = h('tbody');
  const show = () => body.replaceChildren(...report.rounds.map((round, i) => {
    const { plan, completeness, deviation, cloud } = round;
    const share = completeShare(round);
    const whole = deviation?.whole;
    return row([
      chooser(`${i + 1}  ${round.name}`, 'Show this round', i === shared.now.frame, () => shared.set({ frame: i, view: null, hole: null })),
      plan ? plan.in_words : null, share === null ? null : `${percent(share)} %`,
      completeness ? (completeness.holes.length === 0 ? 'none' : `${completeness.holes.length} (${areaText(completeness.holes.reduce((sum, hole) => sum + hole.area_mm2, 0))})`) : null,
      cloud ? count(cloud.points) : null, whole?.rms_mm == null ? null : significant(whole.rms_mm, 3), whole?.in_tolerance == null ? null : `${percent(whole.in_tolerance)} %`,
    ], (k) => k > 1, i === shared.now.frame);
  }));
  shared.watch((now, before) => now.frame !== before.frame && show());
  show();
  const heads = ['Round', 'Plan', 'Measured', 'Holes', 'Points', 'RMS (mm)', 'In tolerance'];
  return h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Rounds' }, h('table', { class: 'data rounds' },
    h('thead', {}, h('tr', {}, ...heads.map((head, k) => h('th', { scope: 'col', class: k > 1 ? 'number' : '' }, head)))), body));
}

/// The views of the round's plan in the order of the tour; a number lights what that view measures.
export function viewTable(report: ScanReport, shared: Shared<ScanSelection>, frame: number): HTMLElement | null {
  const plan = report.rounds[frame]?.plan;
  if (!plan || plan.views.length === 0) return null;
  const heads = ['View', 'Platform', 'Starts (s)', 'Adds', 'Adds (%)', 'Incidence (deg)', 'Beyond good', 'Worst σ (mm)', 'Scanner targets', 'Platform targets'];
  const body = h('tbody');
  const show = () => body.replaceChildren(...plan.views.map((view, i) => row([
    chooser(String(i + 1), 'Show what it measures', i === shared.now.view, () => shared.set({ mode: 'plan', view: i === shared.now.view ? null : i })),
    poseWords(plan.poses[view.platform]), decimals(view.starts_s, 1), areaText(view.adds_mm2), decimals(100 * view.adds_mm2 / plan.surface_mm2, 2), decimals(view.mean_incidence_deg, 1),
    `${percent(view.beyond_good_incidence)} %`, significant(view.worst_sigma_mm, 3), view.scanner_targets, view.platform_targets,
  ], (k) => k > 1, i === shared.now.view)));
  shared.watch((now, before) => now.view !== before.view && show());
  show();
  return table(`Views of round ${frame + 1}`, `views-${frame + 1}`, heads, (k) => k > 1, body,
    () => csv(['view', 'platform', 'starts_s', 'adds_mm2', 'mean_incidence_deg', 'beyond_good_incidence', 'worst_sigma_mm', 'scanner_targets', 'platform_targets', 'x_mm', 'y_mm', 'z_mm', 'qw', 'qx', 'qy', 'qz'],
      plan.views.map((view, i) => [i + 1, poseWords(plan.poses[view.platform]), view.starts_s, view.adds_mm2, view.mean_incidence_deg, view.beyond_good_incidence, view.worst_sigma_mm, view.scanner_targets, view.platform_targets, ...view.pose])),
    'In the order of the tour. "Adds" is the surface that no view before it measures; "beyond good" the share of what it measures that it sees more obliquely than is good; σ is predicted, along the normal.');
}

/// What is still missing after the round; a number shows the place.
export function holeTable(report: ScanReport, shared: Shared<ScanSelection>, frame: number, look: (hole: number) => void): HTMLElement | null {
  const told = report.rounds[frame]?.completeness;
  if (!told || told.holes.length === 0) return null;
  const body = h('tbody');
  const show = () => body.replaceChildren(...told.holes.map((hole, i) => {
    const line = row([
      chooser(String(i + 1), 'Show this hole', i === shared.now.hole, () => look(i)), areaText(hole.area_mm2), decimals(100 * hole.area_mm2 / told.surface_mm2, 2), decimals(hole.across_mm, 0),
      (hole.centre ?? []).map((value) => decimals(value, 0)).join(', '), (hole.normal ?? []).map((value) => decimals(value, 2)).join(', '),
    ], (k) => k > 0, i === shared.now.hole);
    line.addEventListener('pointerenter', () => shared.now.mode === 'completeness' && shared.set({ hole: i }));
    return line;
  }));
  shared.watch((now, before) => now.hole !== before.hole && body.childNodes.forEach((line, i) => {
    (line as HTMLElement).classList.toggle('active', i === now.hole);
    (line as HTMLElement).querySelector('button')!.setAttribute('aria-pressed', String(i === now.hole));
  }));
  show();
  return table(`Holes after round ${frame + 1}`, `holes-${frame + 1}`, ['Hole', 'Area', 'of the surface (%)', 'Across (mm)', 'Centre (mm)', 'Normal'], (k) => k > 0, body,
    () => csv(['hole', 'area_mm2', 'across_mm', 'x_mm', 'y_mm', 'z_mm', 'nx', 'ny', 'nz'], told.holes.map((hole, i) => [i + 1, hole.area_mm2, hole.across_mm, ...(hole.centre ?? [null, null, null]), ...(hole.normal ?? [null, null, null])])),
    'Parts of the surface that are not measured and hang together, largest first.');
}

/// The deviations by region of the part, as a table like others.
export function deviationTable(report: ScanReport, frame: number): CellTable | null {
  const told = report.rounds[frame]?.deviation;
  if (!told || told.whole.points === 0) return null;
  const share = (value: number | null) => (value === null ? null : Number((100 * value).toFixed(2)));
  const rows = [told.whole, ...told.regions].map((one) => [one.region || 'whole', one.points, one.mean_mm, one.rms_mm, one.predicted_rms_mm || null, one.p05_mm, one.median_mm, one.p95_mm, one.lowest_mm, one.highest_mm, share(one.in_tolerance), share(one.below), share(one.above), one.beyond]);
  return {
    id: `deviation-${frame + 1}`, title: `Deviation after round ${frame + 1}`, note: `Signed distance from the nominal surface, outside positive; tolerance ±${significant(report.tolerance_mm, 3)} mm. "Left out" lies too far off to belong to the surface.`,
    columns: ['Region', 'Points', 'Mean (mm)', 'RMS (mm)', 'Predicted (mm)', '5 %', 'Median', '95 %', 'Lowest', 'Highest', 'In tolerance (%)', 'Below (%)', 'Above (%)', 'Left out'], rows, verdicts: [],
  };
}
