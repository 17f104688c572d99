// SPDX-License-Identifier: Apache-2.0
import { count } from '../data/format';
import { measureText, objectivesOf, type LayoutReport } from '../data/layout';
import type { LayoutSelection } from '../data/layout_selection';
import type { Place, Shared } from '../data/selection';
import { h, picker } from '../dom';
import type { Figure } from '../plots/figures';
import { layoutWords } from '../plots/layout_marks';
import { parallelView } from '../plots/parallel';
import { plotView, type PlotView } from '../plots/plot';
import { scatterView } from '../plots/scatter';
import { layoutScales, layoutScene, type LayoutLayer, type LayoutScales, type LayoutSceneView, type LayoutViewPoint } from '../scene/layout_scene';
import { spacePanel, type SpacePanel } from './space';
import { timeline } from './timeline';

const kViews: LayoutViewPoint[] = ['targets', 'onto the surface', 'cell', 'left camera', 'side'];

/// The layout before the tracker, with its own choice of layout and of the pose in the motion.
export function layoutPanel(report: LayoutReport, shared: Shared<LayoutSelection>): SpacePanel<LayoutSceneView> {
  const scales = layoutScales(report);
  const options = report.layouts.map((_, i) => ({ value: String(i), text: layoutWords(report, i) }));
  const layout = picker('Layout', options, String(shared.now.layout), (value) => shared.set({ layout: Number(value) }));
  const against = picker('against', [{ value: '', text: 'none' }, ...options], String(shared.now.against ?? ''), (value) => shared.set({ against: value === '' ? null : Number(value) }));
  const step = (by: number) => shared.set({ layout: Math.min(report.layouts.length - 1, Math.max(0, shared.now.layout + by)) });
  const button = (text: string, title: string, by: number) => h('button', { type: 'button', 'aria-label': title, title, onclick: () => step(by) }, text);
  const layers: { layer: LayoutLayer; text: string; shown: boolean; there: boolean }[] = [
    { layer: 'surface', text: 'where targets may stand', shown: true, there: report.patches.length > 0 },
    { layer: 'keep-outs', text: 'where not', shown: true, there: report.keep_outs.length > 0 },
    { layer: 'obstacles', text: 'part and obstacles', shown: true, there: report.obstacles.length > 0 },
    { layer: 'volume', text: 'working volume', shown: true, there: report.volume !== null },
    { layer: 'present', text: 'the one compared with', shown: true, there: report.layouts.length > 1 },
    { layer: 'fields', text: 'fields of view', shown: false, there: true },
    { layer: 'sight lines', text: 'sight lines', shown: false, there: true },
    { layer: 'names', text: 'names', shown: true, there: true },
  ];
  const panel = spacePanel<LayoutLayer, LayoutViewPoint, LayoutSceneView>(() => layoutScene(report, scales, shared.now), {
    words: 'The layout before the tracker', views: kViews, layers: layers.filter((layer) => layer.there),
    above: h('div', { class: 'bar-row' }, layout.element, button('‹', 'The layout before', -1), button('›', 'The next layout', 1), report.layouts.length > 1 ? against.element : null),
    below: [sceneKey(report, scales), ...(report.motion.pose.length > 1 ? [timeline({ frame: report.motion.time_s.map((_, i) => i), time_s: report.motion.time_s }, shared, 'pose')] : [])],
  });
  const show = () => {
    layout.show(String(shared.now.layout));
    against.show(String(shared.now.against ?? ''));
    panel.scene?.show(shared.now);
  };
  shared.watch(show);
  requestAnimationFrame(show);
  return panel;
}

function sceneKey(report: LayoutReport, scales: LayoutScales): HTMLElement {
  const mark = (kind: string, text: string) => h('span', { class: `mark ${kind}` }, h('i'), text);
  const area = (colour: string, text: string) => h('span', { class: 'key block', style: `--key: var(${colour}); --tall: 1` }, h('i'), text);
  return h('p', { class: 'scene-key' },
    mark('both blue', 'seen by both cameras'), mark('one blue', 'by one'), mark('hidden', 'by none'),
    report.layouts.length > 1 && mark('other', 'of the layout compared with'),
    report.patches.length > 0 && area('--body-3', 'may stand'), report.keep_outs.length > 0 && area('--flag', 'must not'),
    h('span', {}, scales.discs > 1 ? `targets × ${scales.discs}` : 'targets to scale'), h('span', {}, `grid ${count(scales.grid.step)} mm`));
}

/// The charts of all layouts, linked with one another.
export function chartPanel(report: LayoutReport, shared: Shared<LayoutSelection>): { element: HTMLElement; refresh: () => void } {
  const options = report.measures.map((measure, i) => ({ value: String(i), text: measureText(measure) }));
  const x = picker('across', options, String(shared.now.x), (value) => shared.set({ x: Number(value) }));
  const y = picker('up', options, String(shared.now.y), (value) => shared.set({ y: Number(value) }));
  const shade = picker('colour', [{ value: '', text: 'none' }, ...options], String(shared.now.shade ?? ''), (value) => shared.set({ shade: value === '' ? null : Number(value) }));
  shared.watch((now) => {
    x.show(String(now.x));
    y.show(String(now.y));
    shade.show(String(now.shade ?? ''));
  });
  const views = [scatterView(report, shared), ...(objectivesOf(report).length > 2 ? [parallelView(report, shared)] : [])];
  const refresh = () => views.forEach((view) => view.refresh());
  const element = h('section', { class: 'panel plots', 'aria-label': 'Charts of the layouts' }, h('div', { class: 'bar-row controls' }, x.element, y.element, shade.element), ...views.map((view) => view.element));
  new ResizeObserver(refresh).observe(element);
  return { element, refresh };
}

/// Figures along one axis, built anew when `again` says so.
export function figurePanel<S extends Place>(title: string, id: string, shared: Shared<S>, figures: () => Figure[], again: (now: S, before: S) => boolean): { element: HTMLElement; refresh: () => void } {
  const holder = h('div', { class: 'figure-pair' });
  let views: PlotView[] = [];
  const build = () => {
    views.forEach((view) => view.destroy());
    views = figures().map((figure) => plotView(figure, shared));
    holder.replaceChildren(...views.map((view) => view.element));
  };
  const refresh = () => views.forEach((view) => {
    view.resize();
    view.redraw();
  });
  shared.watch((now, before) => {
    if (again(now, before)) build();
    if (now.range !== before.range) views.forEach((view) => view.setRange(now.range));
  });
  build();
  const element = h('section', { class: 'panel', 'aria-labelledby': id }, h('h2', { id }, title), holder);
  new ResizeObserver(refresh).observe(element);
  return { element, refresh };
}
