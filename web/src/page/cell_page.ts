// SPDX-License-Identifier: Apache-2.0
import type { CellReport } from '../data/cell_report';
import { firstCellSelection, type CellSelection } from '../data/cell_selection';
import { meshOfSolid } from '../data/mesh';
import { Shared } from '../data/selection';
import { h } from '../dom';
import { chartView } from '../plots/chart';
import { heatView } from '../plots/heat';
import { tableSection } from '../tables/generic';
import { optionSection } from '../tables/options';
import { summarySection } from '../tables/summary';
import { cellPanel, cellPlots } from './cell_workspace';
import type { PageContent } from './frame';

const kReading = [
  'Frame "tracker" (O_c): the left camera; x right, y down, z forward. O_p: platform, O_g: workpiece, O_s: scanner, O_1: the targets\' own frame. Lengths in mm, angles in degrees.',
  'In the table of the moment, rx ry rz is the turn since the first frame as a rotation vector, along the body\'s own axes.',
  'A target counts as seen by a camera when it lies in the image and in the working volume, faces the camera squarely enough, is large enough and apart from its neighbours there, and its disc is free of everything that could hide it.',
  'The predicted error is √tr Σ of a point, Σ from the pose by the targets that both cameras see; below the 95 % bound its length stays with that probability. "Measured" was simulated, tracked and compared with the truth.',
  'The ellipsoid holds its point with probability 95 %; it is enlarged by the factor written under the view. Discs of targets may be enlarged too; what hides them was computed with their true size.',
  'The error map shows the largest predicted error over the whole motion at each place of the surface, not of one moment.',
  'Distances are measured between places that move with what carries them; a place on a surface is as exact as the surface that is drawn.',
];

const kKeys = '← → step a frame, with Shift ten, Space plays, Esc clears what was measured. Point into a plot or a strip to see that moment; drag in a plot to look closer, double-click for the whole time.';

/// The page about a cell in motion.
export function cellPage(report: CellReport): PageContent {
  const shared = new Shared<CellSelection>(firstCellSelection(report));
  const meshes = report.solids.map(meshOfSolid);
  const there = report.time_s.length > 0;
  const space = there ? cellPanel(report, meshes, shared) : null;
  const plots = there ? cellPlots(report, shared) : null;
  const charts = report.charts.map(chartView);
  const chartPanel = h('section', { class: 'panel', 'aria-label': 'Charts' }, h('div', { class: 'figure-pair' }, ...charts.map((chart) => chart.element)));
  const refreshCharts = () => charts.forEach((chart) => chart.refresh());
  new ResizeObserver(refreshCharts).observe(chartPanel);
  return {
    sections: [
      summarySection(report.summary, report.remarks, 'What to beware of', there ? 'Nothing.' : 'There are no frames.'),
      space && plots && h('div', { class: 'workspace', id: 'cell' }, space.element, plots.element),
      report.heats.length > 0 ? h('section', { class: 'panel', 'aria-labelledby': 'heats' }, h('h2', { id: 'heats' }, 'Over the platform\'s tilt'), h('div', { class: 'figure-pair heats' }, ...report.heats.map(heatView))) : null,
      ...report.tables.map(tableSection), charts.length > 0 ? chartPanel : null,
      optionSection(report.options, report.rig, kReading),
    ],
    keys: kKeys,
    refresh: () => {
      space?.refresh();
      plots?.refresh();
      refreshCharts();
    },
    beforePrint: () => space?.still(),
  };
}
