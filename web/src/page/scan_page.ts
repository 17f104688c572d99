// SPDX-License-Identifier: Apache-2.0
import { meshOfSolid } from '../data/mesh';
import { Unpacked } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import { firstScanSelection, type ScanSelection } from '../data/scan_selection';
import { Shared } from '../data/selection';
import { h } from '../dom';
import { chartView } from '../plots/chart';
import { tableSection } from '../tables/generic';
import { optionSection } from '../tables/options';
import { deviationTable, holeTable, viewTable } from '../tables/scans';
import { summarySection } from '../tables/summary';
import type { PageContent } from './frame';
import { otherThan, scanPanel, scanPlots } from './scan_workspace';

const kReading = [
  'Everything is told in the frame "workpiece" (O_g). A scanner\'s frame: origin midway between projector and camera, x from the projector to the camera, z towards the part. Lengths in mm, angles in degrees.',
  'A place counts as measurable from a view when it lies in range and in the field, is seen squarely enough and freely by projector and camera, the scanner touches nothing, the tracker sees at least four targets of the scanner and of the platform, and the predicted uncertainty is below the tolerance.',
  'Coverage is told against three denominators: the whole surface; what any view at all could measure; what this cell allows, with its tracker, platform and limits. The bound says how few views any plan of these candidates needs at least.',
  'A place is measured when enough points of the cloud lie near it, close to the surface and facing the same way. Holes are such places missing that hang together.',
  'Deviation is the signed distance from the nominal surface, outside positive. The dashed curve is what the points\' own uncertainty alone would give: what is wider is the part, or the alignment.',
  'Only so many points are drawn as the view says; all figures were computed from all of them. Each drawn point is a point of the cloud, placed within a few hundredths of a millimetre.',
];

const kKeys = '← → go from round to round, with Shift from view to view, Esc lets go of what was chosen or measured. Click a view, a block of the tour or a hole to choose it; click two points of the cloud to measure between them.';

/// The page about where to scan, and the cloud that came of it.
export function scanPage(report: ScanReport): PageContent {
  const shared = new Shared<ScanSelection>(firstScanSelection(report));
  const data = new Unpacked(report);
  const remarks = [...new Set([...report.remarks, ...report.rounds.flatMap((round) => round.plan?.remarks ?? [])])];
  const summary = summarySection(report.summary, remarks, 'What to beware of', report.rounds.length > 0 ? 'Nothing.' : 'There are no rounds.');
  const options = optionSection(report.options, null, kReading, report.scanner);
  const charts = report.charts.map(chartView);
  const chartPanel = h('section', { class: 'panel', 'aria-label': 'Charts' }, h('div', { class: 'figure-pair' }, ...charts.map((chart) => chart.element)));
  const refreshCharts = () => charts.forEach((chart) => chart.refresh());
  new ResizeObserver(refreshCharts).observe(chartPanel);
  const more = [...report.tables.map(tableSection), charts.length > 0 ? chartPanel : null, options];
  if (report.rounds.length === 0) return { links: report.links, sections: [summary, ...more], keys: 'none', refresh: refreshCharts, beforePrint: () => {} };

  const space = scanPanel(report, data, report.surface && meshOfSolid(report.surface), shared);
  const plots = scanPlots(report, shared);
  const tables = h('div', { class: 'round-tables' });
  const made = new Map<number, HTMLElement[]>();
  const tablesOf = (frame: number) => {
    const deviation = deviationTable(report, frame);
    return [viewTable(report, shared, frame), holeTable(report, shared, frame, space.lookAtHole), deviation && tableSection(deviation)].filter((table): table is HTMLElement => table !== null);
  };
  const build = () => {
    const { frame } = shared.now;
    if (!made.has(frame)) made.set(frame, tablesOf(frame));
    tables.replaceChildren(...made.get(frame)!);
  };
  shared.watch((now, before) => now.frame !== before.frame && build());
  build();
  document.addEventListener('keydown', (event) => step(event, report, shared));
  return {
    links: report.links,
    sections: [summary, h('div', { class: 'workspace', id: 'scans' }, space.element, plots.element), tables, ...more],
    keys: kKeys,
    refresh: () => {
      space.refresh();
      plots.refresh();
      refreshCharts();
    },
    beforePrint: () => space.still(),
  };
}

/// The arrow keys: from round to round, with Shift from view to view.
function step(event: KeyboardEvent, report: ScanReport, shared: Shared<ScanSelection>): void {
  const by = event.key === 'ArrowLeft' ? -1 : event.key === 'ArrowRight' ? 1 : 0;
  const at = event.target as HTMLElement;
  if (by === 0 || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || at.tagName === 'SELECT') return;
  event.preventDefault();
  const { frame, view, against } = shared.now;
  if (!event.shiftKey) {
    const next = Math.min(report.rounds.length - 1, Math.max(0, frame + by));
    if (next !== frame) shared.set({ frame: next, view: null, hole: null, against: otherThan(next, against, report.rounds.length) });
    return;
  }
  const views = report.rounds[frame].plan?.views.length ?? 0;
  if (views > 0) shared.set({ mode: 'plan', view: view === null ? (by > 0 ? 0 : views - 1) : Math.min(views - 1, Math.max(0, view + by)) });
}
