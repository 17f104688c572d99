// SPDX-License-Identifier: Apache-2.0
import type { Mesh } from '../data/mesh';
import type { Vec3 } from '../data/parts';
import { drawnWords, poseWords, type Unpacked } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import { modesOf, shadesOf, type CloudShade, type Comparison, type ScanMode, type ScanSelection } from '../data/scan_selection';
import type { Shared } from '../data/selection';
import { choice, h, picker } from '../dom';
import { coverageAsCsv, coverageNote, coveragePlot, drawnFigure } from '../plots/coverage';
import { deviationAsCsv, deviationNote, deviationPlot } from '../plots/deviation_plot';
import { bodyColour } from '../plots/figures';
import { limitBars, limitsAsCsv } from '../plots/limit_bars';
import { shadeOf, type Shade } from '../plots/shades';
import { tourAsCsv, tourChart, tourNote } from '../plots/tour_chart';
import type { SolidLook } from '../scene/cell_solids';
import { scanScales } from '../scene/scan_scales';
import { scanScene, type ScanLayer, type ScanSceneView, type ScanViewPoint } from '../scene/scan_scene';
import { roundTable } from '../tables/scans';
import { scanPointer } from './scan_measuring';
import { spacePanel, type SpacePanel } from './space';

const kViews: ScanViewPoint[] = ['part', 'front', 'side', 'above', 'below'];
const kFlicker_ms = 900;
const kShadeWords: Record<CloudShade, string> = { deviation: 'deviation', scan: 'scan', sigma: 'standard deviation', points: 'number of points', incidence: 'incidence', plain: 'plain' };

export interface ScanPanel extends SpacePanel<ScanSceneView> { lookAtHole: (hole: number) => void }

/// Plan, cloud and completeness in 3-D, round after round; two rounds side by side or in turn.
export function scanPanel(report: ScanReport, data: Unpacked, mesh: Mesh | null, shared: Shared<ScanSelection>): ScanPanel {
  const scales = scanScales(report, data, mesh);
  const known = new Map<CloudShade, Shade | null>();
  const scaleOf = (shade: CloudShade) => {
    if (!known.has(shade)) known.set(shade, shadeOf(report, report.rounds.map((_, i) => data.cloudOf(i)), shade));
    return known.get(shade)!;
  };
  const pointer = scanPointer(report, data, shared);
  const key = h('p', { class: 'scene-key' });
  const layers: { layer: ScanLayer; text: string; shown: boolean }[] = [
    { layer: 'views', text: 'views', shown: true }, { layer: 'tour', text: 'tour', shown: true }, { layer: 'samples', text: 'surface samples', shown: true }, { layer: 'numbers', text: 'numbers', shown: true },
  ];
  const panel = spacePanel<ScanLayer, ScanViewPoint, ScanSceneView>(() => pairOf(() => scanScene(report, data, mesh, scales, scaleOf, shared.now), shared, pointer.attach), {
    words: 'Plan, cloud and completeness', views: kViews, layers, above: controls(report, shared, (look) => panel.scene?.setLook(look)), below: [key, pointer.element],
  });
  const show = () => {
    panel.scene?.show(shared.now);
    panel.element.dataset.mode = shared.now.mode;
    key.replaceChildren(...keyOf(report, shared.now));
  };
  shared.watch(show);
  requestAnimationFrame(show);
  const lookAtHole = (i: number) => {
    shared.set({ mode: 'completeness', hole: i });
    const told = report.rounds[shared.now.frame].completeness!;
    const hole = told.holes[i];
    const samples = data.samplesAt(told.samples);
    if (!samples || !hole.normal) return;
    const own = Array.from(data.samplesOfHole(hole), (s): Vec3 => [samples.places[3 * s], samples.places[3 * s + 1], samples.places[3 * s + 2]]);
    const about = 0.25 * scales.span;
    panel.scene?.lookAt(own.flatMap((at): Vec3[] => [[-1, -1, -1], [1, 1, 1]].map((sign) => at.map((value, k) => value + sign[k] * about) as Vec3)), hole.normal);
  };
  return { ...panel, lookAtHole };
}

/// One view, or two that turn together; the second is made when it is first asked for.
function pairOf(make: () => ScanSceneView, shared: Shared<ScanSelection>, attach: (scene: ScanSceneView) => void): ScanSceneView {
  const first = make();
  attach(first);
  let second: ScanSceneView | null = null;
  let asked: ((scene: ScanSceneView) => void)[] = [];
  const element = h('div', { class: 'scenes' }, first.element);
  const both = (act: (scene: ScanSceneView) => void) => {
    act(first);
    if (second) act(second);
    else asked.push(act);
  };
  const follow = (leader: ScanSceneView, other: ScanSceneView) => {
    leader.onTurn(() => {
      const [own, theirs] = [leader.standing(), other.standing()];
      if (own.position.some((value, k) => Math.abs(value - theirs.position[k]) > 1e-6) || own.target.some((value, k) => Math.abs(value - theirs.target[k]) > 1e-6)) other.stand(own.target, own.position);
    });
  };
  let other = false;
  let timer = 0;
  const show = (now: ScanSelection) => {
    const beside = now.comparison === 'side by side';
    element.classList.toggle('pair', beside);
    if (beside && !second) {
      second = make();
      element.append(second.element);
      asked.forEach((act) => act(second!));
      asked = [];
      follow(first, second);
      follow(second, first);
      const { target, position } = first.standing();
      second.refresh();
      second.stand(target, position);
    }
    if (second) second.element.hidden = !beside;
    window.clearInterval(timer);
    if (now.comparison === 'flicker') {
      timer = window.setInterval(() => {
        other = !other;
        first.show({ ...now, frame: other ? now.against : now.frame, view: other ? null : now.view, hole: other ? null : now.hole });
      }, kFlicker_ms);
    }
    other = false;
    first.show(now);
    if (beside) second?.show({ ...now, frame: now.against, view: null, hole: null });
  };
  return {
    ...first, element, show,
    setLayer: (layer, visible) => both((scene) => scene.setLayer(layer, visible)),
    setLook: (look) => both((scene) => scene.setLook(look)),
    mark: first.mark,
    refresh: () => {
      first.refresh();
      if (shared.now.comparison === 'side by side') second?.refresh();
    },
    still: () => {
      first.still();
      second?.still();
    },
  };
}

function controls(report: ScanReport, shared: Shared<ScanSelection>, setLook: (look: SolidLook) => void): HTMLElement {
  const rounds = report.rounds.map((round, i) => ({ value: i, text: `${i + 1}  ${round.name}` }));
  const step = choice('Round', rounds, shared.now.frame, (frame) => shared.set({ frame, view: null, hole: null }));
  const mode = choice<ScanMode>('Show', modesOf(report).map((value) => ({ value, text: value })), shared.now.mode, (value) => shared.set({ mode: value }));
  const shade = picker('Colours', shadesOf(report).map((value) => ({ value, text: kShadeWords[value] })), shared.now.shade, (value) => shared.set({ shade: value as CloudShade }));
  const surface = choice<SolidLook>('Surface', (['shaded', 'see-through', 'hidden'] as const).map((value) => ({ value, text: value })), 'shaded', (look) => {
    setLook(look);
    surface.show(look);
  });
  const compare = choice<Comparison>('Compare', (['off', 'flicker', 'side by side'] as const).map((value) => ({ value, text: value })), 'off', (value) => shared.set({ comparison: value, against: otherThan(shared.now.frame, shared.now.against, report.rounds.length) }));
  const against = picker('with', rounds.map(({ value, text }) => ({ value: String(value), text })), String(shared.now.against), (value) => shared.set({ against: Number(value) }));
  const show = (now: ScanSelection) => {
    step.show(now.frame);
    mode.show(now.mode);
    compare.show(now.comparison);
    against.show(String(now.against));
    against.element.hidden = now.comparison === 'off' || report.rounds.length < 3;
    shade.element.hidden = now.mode !== 'cloud';
  };
  shared.watch(show);
  show(shared.now);
  return h('div', { class: 'scan-controls' },
    h('div', { class: 'bar-row' }, rounds.length > 0 ? step.element : null, mode.element, shade.element),
    h('div', { class: 'bar-row' }, report.surface ? surface.element : null, rounds.length > 1 ? compare.element : null, rounds.length > 1 ? against.element : null));
}

/// The round that is compared with, another than the one that is shown.
export function otherThan(frame: number, against: number, rounds: number): number {
  return against !== frame ? against : frame + 1 < rounds ? frame + 1 : Math.max(0, frame - 1);
}

/// What colours mean and how much is drawn.
function keyOf(report: ScanReport, now: ScanSelection): HTMLElement[] {
  const round = report.rounds[now.frame];
  if (!round) return [];
  const area = (colour: string, text: string) => h('span', { class: 'key block', style: `--key: var(${colour}); --tall: 1` }, h('i'), text);
  if (now.mode === 'cloud') return [h('span', {}, drawnWords(round)), ...(now.shade === 'scan' ? [h('span', {}, 'neighbouring scan numbers have other colours, eight in turn')] : []), ...(now.shade === 'deviation' ? [h('span', {}, 'grey: belongs to no surface')] : [])];
  if (now.mode === 'completeness') return [area('--measured', 'measured'), area('--missing', 'not measured'), area('--lit', 'the chosen hole')];
  const poses = (round.plan?.poses ?? []).map((pose, p) => h('span', { class: 'key', style: `--key: var(${bodyColour(p)})` }, h('i'), `platform ${poseWords(pose)}`));
  return [...poses, h('span', { class: 'key dashed', style: '--key: var(--tour)' }, h('i'), 'the platform turns'), ...(now.view === null ? [area('--measured', 'to be measured')] : [area('--lit', `measured by view ${now.view + 1}`)]), area('--missing', 'by no view')];
}

/// The rounds in numbers, and the chosen one's plan and deviations as figures.
export function scanPlots(report: ScanReport, shared: Shared<ScanSelection>): { element: HTMLElement; refresh: () => void } {
  const plan = () => report.rounds[shared.now.frame]?.plan ?? null;
  const deviation = () => report.rounds[shared.now.frame]?.deviation ?? null;
  const choose = (view: number) => shared.set({ mode: 'plan', view: view === shared.now.view ? null : view });
  const drawPlan = (draw: (own: NonNullable<ReturnType<typeof plan>>, width: number) => SVGSVGElement) => (width: number) => {
    const own = plan();
    return own && own.views.length > 0 ? draw(own, width) : null;
  };
  const figures = [
    drawnFigure('coverage', 'Coverage against number of views', drawPlan((own, width) => coveragePlot(own, width, shared.now.view, choose)), () => coverageNote(plan()!), () => coverageAsCsv(plan()!)),
    drawnFigure('tour', 'The tour', drawPlan((own, width) => tourChart(own, report, width, shared.now.view, choose)), () => tourNote(plan()!), () => tourAsCsv(plan()!, report)),
    drawnFigure('deviation', 'Deviation from the nominal surface', (width) => deviation() && deviationPlot(deviation()!, report.tolerance_mm, width), () => deviationNote(deviation()!, report.tolerance_mm), () => deviationAsCsv(deviation()!)),
    drawnFigure('limits', 'What each limit costs', (width) => (plan() && plan()!.limits.length > 0 ? limitBars(plan()!, width) : null), () => 'How much more of the surface could be measured without this limit, all others kept.', () => limitsAsCsv(plan()!)),
  ];
  const element = h('section', { class: 'panel plots', 'aria-label': 'Plots of the round' }, roundTable(report, shared), ...figures.map((figure) => figure.element));
  const refresh = () => figures.forEach((figure) => figure.refresh());
  shared.watch((now, before) => (now.frame !== before.frame || now.view !== before.view) && refresh());
  new ResizeObserver(refresh).observe(element);
  return { element, refresh };
}
