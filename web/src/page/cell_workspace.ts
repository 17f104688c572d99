// SPDX-License-Identifier: Apache-2.0
import { cellAsCsv } from '../data/cell_errors';
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { count, times } from '../data/format';
import { mapRange, type Mesh } from '../data/mesh';
import type { Shared } from '../data/selection';
import { choice, download, h, picker } from '../dom';
import { cellAxis, cellFigures } from '../plots/cell_figures';
import { plotView, type PlotView } from '../plots/plot';
import { kSeenColours, sightStrip } from '../plots/sight_strip';
import { statusStrip } from '../plots/status_strip';
import { cellScales, type CellScales } from '../scene/cell_scales';
import { cellScene, type CellLayer, type CellSceneView, type CellViewPoint } from '../scene/cell_scene';
import { kSolidLooks, type SolidLook } from '../scene/cell_solids';
import { cellReadout } from './cell_readout';
import { measuringTool } from './measuring';
import { spacePanel, type SpacePanel } from './space';
import { timeline } from './timeline';

const kFew = 4;  // named points that are offered side by side; more are in a list
const kViews: CellViewPoint[] = ['cell', 'part', 'left camera', 'right camera', 'above', 'side'];

/// The cell in 3-D with its time slider, the moment in numbers, and the tool that measures.
export function cellPanel(report: CellReport, meshes: Mesh[], shared: Shared<CellSelection>): SpacePanel<CellSceneView> {
  const scales = cellScales(report, meshes);
  const has = (role: string) => report.solids.some((solid) => solid.role === role);
  const layers: { layer: CellLayer; text: string; shown: boolean; there: boolean }[] = [
    { layer: 'sight lines', text: 'sight lines', shown: true, there: true },
    { layer: 'ellipsoids', text: 'error ellipsoids', shown: true, there: report.points.length > 0 },
    { layer: 'frames', text: 'frames', shown: true, there: report.axes.length > 0 },
    { layer: 'fixtures', text: 'fixtures', shown: true, there: has('fixture') },
    { layer: 'obstacles', text: 'obstacles', shown: true, there: has('obstacle') },
    { layer: 'volume', text: 'working volume', shown: false, there: report.volume !== null },
    { layer: 'fields', text: 'fields of view', shown: false, there: true },
    { layer: 'names', text: 'names', shown: true, there: true },
  ];
  const looks = kSolidLooks.filter((look) => look !== 'error map' || mapRange(report.solids) !== null);
  const part = choice<SolidLook>('Part', looks.map((look) => ({ value: look, text: look })), 'shaded', (look) => {
    panel.scene?.setLook(look);
    part.show(look);
    key.classList.toggle('with-map', look === 'error map');
  });
  const key = sceneKey(report, scales);
  const tool = measuringTool(report, shared, () => panel.scene);
  const panel = spacePanel<CellLayer, CellViewPoint, CellSceneView>(() => cellScene(report, meshes, scales, shared.now), {
    words: 'The cell in motion', views: kViews, layers: layers.filter((layer) => layer.there),
    above: report.solids.length > 0 ? h('div', { class: 'bar-row' }, part.element) : undefined,
    below: [key, timeline({ frame: report.time_s.map((_, i) => i), time_s: report.time_s }, shared), tool.element, cellReadout(report, shared)],
  });
  tool.begin();
  const show = () => panel.scene?.show(shared.now);
  shared.watch(show);
  requestAnimationFrame(show);
  return panel;
}

/// What marks and lines mean, by form and colour, and by how much things are exaggerated.
function sceneKey(report: CellReport, scales: CellScales): HTMLElement {
  const mark = (kind: 'both' | 'one' | 'hidden', text: string) => h('span', { class: `mark ${kind} seen`, style: `--key: var(${kSeenColours[kind]})` }, h('i'), text);
  const line = (kind: string, colour: string, text: string) => h('span', { class: `key ${kind}`, style: `--key: var(${colour})` }, h('i'), text);
  return h('p', { class: 'scene-key' },
    mark('both', 'target seen by both cameras'), mark('one', 'by one'), mark('hidden', 'by none'),
    line('', '--sight', 'line of sight'), line('dashed', '--seen-none', 'not seen: ends at what hides it'),
    report.points.length > 0 && h('span', {}, `95 % ellipsoids × ${times(scales.ellipsoids)}`),
    h('span', {}, scales.discs > 1 ? `targets × ${scales.discs}` : 'targets to scale'), h('span', {}, `grid ${count(scales.grid.step)} mm`),
    h('span', { class: 'map-words' }, 'error map: worst predicted error over the motion; grey: not told'));
}

/// Status, visibility and errors over the motion, linked with the view.
export function cellPlots(report: CellReport, shared: Shared<CellSelection>): { element: HTMLElement; refresh: () => void } {
  const axis = cellAxis(report).values;
  const status = report.status ? statusStrip(`Status of ${report.bodies[report.body].name}`, [{ label: report.bodies[report.body].name, letters: report.status }], axis, shared) : null;
  const [sight, holder] = [h('div'), h('div', { class: 'figures' })];
  let strip = sightStrip(report, shared.now.body, axis, shared);
  let views: PlotView[] = [];
  const build = () => {
    views.forEach((view) => view.destroy());
    views = cellFigures(report, shared.now).map((figure) => plotView(figure, shared));
    holder.replaceChildren(...views.map((view) => view.element));
    if (shared.now.range) views.forEach((view) => view.setRange(shared.now.range));
  };
  const refresh = () => {
    status?.redraw();
    strip.redraw();
    views.forEach((view) => {
      view.resize();
      view.redraw();
    });
  };
  shared.watch((now, before) => {
    if (now.point !== before.point || now.scale !== before.scale) build();
    if (now.body !== before.body) {
      strip = sightStrip(report, now.body, axis, shared);
      sight.replaceChildren(strip.element);
      strip.redraw();
    }
    if (now.range !== before.range) views.forEach((view) => view.setRange(now.range));
  });
  build();
  sight.append(strip.element);
  const element = h('section', { class: 'panel plots', 'aria-label': 'Plots over time' }, plotControls(report, shared), status?.element ?? null, sight, holder);
  new ResizeObserver(refresh).observe(element);
  return { element, refresh };
}

function plotControls(report: CellReport, shared: Shared<CellSelection>): HTMLElement {
  const points = report.points.map((one, i) => ({ value: String(i), text: one.name }));
  const point = (points.length > kFew ? picker : choice<string>)('Error at', points, String(shared.now.point), (value) => shared.set({ point: Number(value) }));
  const scale = choice<CellSelection['scale']>('Scale', [{ value: 'linear', text: 'linear' }, { value: 'log', text: 'log' }], shared.now.scale, (value) => shared.set({ scale: value }));
  const body = choice('Sight of', report.bodies.map((one, i) => ({ value: i, text: one.name })), shared.now.body, (value) => shared.set({ body: value }));
  const all = h('button', { type: 'button', hidden: true, onclick: () => shared.set({ range: null }) }, 'whole time');
  shared.watch((now) => {
    point.show(String(now.point));
    scale.show(now.scale);
    body.show(now.body);
    all.hidden = now.range === null;
  });
  const save = () => download('cell.csv', new Blob([cellAsCsv(report)], { type: 'text/csv' }));
  return h('div', { class: 'bar-row controls' },
    report.bodies.length > 1 && body.element, report.points.length > 1 && point.element, report.points.length > 0 && scale.element, all,
    h('span', { class: 'exports' }, h('button', { type: 'button', title: 'Save every frame with poses, errors and why targets are not seen', onclick: save }, 'all as CSV')));
}
