// SPDX-License-Identifier: Apache-2.0
import type { LayoutReport } from '../data/layout';
import { firstSelection, type LayoutSelection } from '../data/layout_selection';
import { Shared, type Place } from '../data/selection';
import { h } from '../dom';
import { historyFigures, motionFigures } from '../plots/layout_figures';
import { chosenPanel } from '../tables/chosen';
import { layoutTable } from '../tables/layouts';
import { optionSection } from '../tables/options';
import { summarySection } from '../tables/summary';
import type { PageContent } from './frame';
import { chartPanel, figurePanel, layoutPanel } from './layout_workspace';

const kReading = [
  'Targets, surface and work points are told in the frame of the body that carries the targets; the view shows them before the tracker (left camera: x right, y down, z forward) in one pose of the motion.',
  'The predicted error is √tr Σ of a work point, Σ from the Cramér–Rao bound of the pose by the targets that both cameras see there; "worst" is the largest over the motion and the work points.',
  '"After one loss" leaves out, in each pose, the target whose loss is worst. A pose with fewer than four targets left is not trusted.',
  'The identifiability margin is the smallest RMS at which four or more targets fit a wrong labelling: a tracker whose noise comes near it can take the layout for itself turned round.',
  'A layout is on the front when no other is at least as good in every objective and better in one. The knee is where giving up a little of one objective begins to cost much of another; it is advice, not law.',
];

const kKeys = '← → step through the motion, with Shift ten, Space plays; in the chart ← → go from layout to layout. Point into a plot to see that pose; drag in a plot to look closer, double-click for all of it.';

/// The page about layouts of targets.
export function layoutPage(report: LayoutReport): PageContent {
  const options = optionSection(report.options, report.rig, kReading);
  const summary = summarySection(report.summary, report.remarks, 'What to beware of', 'Nothing.');
  if (report.layouts.length === 0) return { sections: [summary, options], keys: 'none', refresh: () => {}, beforePrint: () => {} };
  const shared = new Shared<LayoutSelection>(firstSelection(report));
  const space = layoutPanel(report, shared);
  const charts = chartPanel(report, shared);
  const motion = figurePanel('Over the motion', 'motion', shared, () => motionFigures(report, shared.now), (now, before) => now.layout !== before.layout || now.against !== before.against);
  const search = report.history.length > 1
    ? figurePanel<Place>('The search', 'search', new Shared<Place>({ frame: report.history.length - 1, range: null }), () => historyFigures(report), () => false) : null;
  const refreshed = [space, charts, motion, ...(search ? [search] : [])];
  return {
    sections: [
      summary, h('div', { class: 'workspace', id: 'cell' }, space.element, h('div', { class: 'beside' }, charts.element, chosenPanel(report, shared))),
      layoutTable(report, shared), motion.element, search?.element ?? null, options,
    ],
    keys: kKeys,
    refresh: () => refreshed.forEach((part) => part.refresh()),
    beforePrint: () => space.still(),
  };
}
