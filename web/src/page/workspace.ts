// SPDX-License-Identifier: Apache-2.0
import { everythingAsCsv } from '../data/csv';
import { count, times } from '../data/format';
import type { TrackingReport } from '../data/report';
import { axisOf, type Component, type Shared, type Source } from '../data/selection';
import { choice, download, h } from '../dom';
import { figuresOf } from '../plots/figures';
import { plotView, type PlotView } from '../plots/plot';
import { statusStrip, type StatusRow } from '../plots/status_strip';
import { scalesOf, type Scales } from '../scene/scales';
import { sceneView, type Layer, type SceneView, type ViewPoint } from '../scene/scene';
import { readout } from './readout';
import { spacePanel, type SpacePanel } from './space';
import { timeline } from './timeline';

const kLayers: Layer[] = ['fields', 'trajectory', 'ellipsoids', 'sight lines', 'names'];
const kViews: ViewPoint[] = ['cell', 'bodies', 'left camera', 'above', 'side'];

export interface Workspace {
  element: HTMLElement;
  refresh: () => void;
  beforePrint: () => void;
}

/// The 3-D view on the left, the linked plots on the right.
export function workspace(report: TrackingReport, shared: Shared): Workspace {
  const space = cellPanel(report, shared);
  const plots = plotPanel(report, shared);
  return {
    element: h('div', { class: 'workspace', id: 'cell' }, space.element, plots.element),
    refresh: () => {
      space.refresh();
      plots.refresh();
    },
    beforePrint: () => space.still(),
  };
}

function cellPanel(report: TrackingReport, shared: Shared): SpacePanel<SceneView> {
  const scales = scalesOf(report);
  const panel = spacePanel<Layer, ViewPoint, SceneView>(() => sceneView(report, scales, shared.now), {
    words: 'Cell in motion', views: kViews,
    layers: kLayers.map((layer) => ({ layer, text: layer === 'fields' ? 'fields of view' : layer, shown: layer !== 'sight lines' })),
    below: [sceneKey(scales), timeline(report.frames, shared), readout(report, shared)],
  });
  const show = () => panel.scene?.show(shared.now);
  shared.watch(show);
  requestAnimationFrame(show);
  return panel;
}

/// What the marks mean and by how much they are exaggerated.
function sceneKey(scales: Scales): HTMLElement {
  const mark = (kind: string, text: string) => h('span', { class: `mark ${kind}` }, h('i'), text);
  return h('p', { class: 'scene-key' },
    mark('both', 'target seen by both cameras'), mark('one', 'by one'), mark('hidden', 'hidden'), mark('predicted', 'predicted, not measured'),
    h('span', {}, `95 % ellipsoid of the named point × ${times(scales.ellipsoids)}`),
    h('span', {}, scales.discs > 1 ? `targets × ${scales.discs}` : 'targets to scale'),
    h('span', {}, `grid ${count(scales.grid.step)} mm`));
}

function plotPanel(report: TrackingReport, shared: Shared): { element: HTMLElement; refresh: () => void } {
  const strip = statusStrip('Status by body', report.bodies.flatMap((body): StatusRow[] => [
    { label: body.name, letters: body.status },
    ...(body.filtered_status && body.filtered_status !== body.status ? [{ label: 'filtered', letters: body.filtered_status }] : []),
  ]), axisOf(report.frames).values, shared);
  const holder = h('div', { class: 'figures' });
  let views: PlotView[] = [];
  const build = () => {
    views.forEach((view) => view.destroy());
    views = figuresOf(report, shared.now).map((figure) => plotView(figure, shared));
    holder.replaceChildren(...views.map((view) => view.element));
    if (shared.now.range) views.forEach((view) => view.setRange(shared.now.range));
  };
  const refresh = () => {
    strip.redraw();
    views.forEach((view) => {
      view.resize();
      view.redraw();
    });
  };
  shared.watch((now, before) => {
    if (now.body !== before.body || now.component !== before.component || now.source !== before.source) build();
    if (now.range !== before.range) views.forEach((view) => view.setRange(now.range));
  });
  build();
  const element = h('section', { class: 'panel plots', 'aria-label': 'Plots over time' }, plotControls(report, shared), strip.element, holder);
  new ResizeObserver(refresh).observe(element);
  return { element, refresh };
}

function plotControls(report: TrackingReport, shared: Shared): HTMLElement {
  const bodies = choice('Body', report.bodies.map((body, i) => ({ value: i, text: body.name })), shared.now.body, (body) => shared.set({ body }));
  const components: { value: Component; text: string }[] = [{ value: 'size', text: 'size' }, { value: 'x', text: 'x' }, { value: 'y', text: 'y' }, { value: 'z', text: 'z' }];
  const component = choice('Error', components, shared.now.component, (value) => shared.set({ component: value }));
  const sources: { value: Source; text: string }[] = [{ value: 'measured', text: 'measured' }, { value: 'filtered', text: 'filtered' }];
  const source = choice('Pose', sources, shared.now.source, (value) => shared.set({ source: value }));
  const all = h('button', { type: 'button', onclick: () => shared.set({ range: null }) }, 'whole time');
  all.hidden = true;
  shared.watch((now) => {
    bodies.show(now.body);
    component.show(now.component);
    source.show(now.source);
    all.hidden = now.range === null;
  });
  const save = () => download('tracking.csv', new Blob([everythingAsCsv(report)], { type: 'text/csv' }));
  return h('div', { class: 'bar-row controls' },
    report.bodies.length > 1 && bodies.element, report.bodies.some((body) => body.filtered) && source.element, component.element, all,
    h('span', { class: 'exports' }, h('button', { type: 'button', title: 'Save every frame, body and error', onclick: save }, 'all as CSV')));
}
