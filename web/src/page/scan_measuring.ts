// SPDX-License-Identifier: Apache-2.0
import { decimals, significant } from '../data/format';
import type { Vec3 } from '../data/parts';
import { areaText, pointAt, pointWords, type Unpacked } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import type { ScanSelection } from '../data/scan_selection';
import type { Shared } from '../data/selection';
import { h } from '../dom';
import type { ScanSceneView, ScanSpot } from '../scene/scan_scene';

/// What lies under the cursor, in words; two clicks on points of the cloud tell their distance; a click on a view or
/// a hole chooses it.
export function scanPointer(report: ScanReport, data: Unpacked, shared: Shared<ScanSelection>): { element: HTMLElement; attach: (scene: ScanSceneView) => void } {
  const words = h('p', { class: 'pointed', 'aria-live': 'polite' });
  const answer = h('p', { class: 'measured' });
  let places: Vec3[] = [];
  let scenes: ScanSceneView[] = [];
  let hovered: Vec3 | null = null;

  const mark = () => {
    const text = places.length === 2 ? `${significant(lengthOf(places), 5)} mm` : '';
    scenes.forEach((scene) => scene.mark(hovered, places, text));
  };
  const tell = () => {
    answer.replaceChildren(...(places.length === 2 ? [h('b', { class: 'length' }, `${decimals(lengthOf(places), 2)} mm`),
      ` from A to B; ${['dx', 'dy', 'dz'].map((name, k) => `${name} ${decimals(places[1][k] - places[0][k], 2)}`).join(', ')} mm. Esc clears.`] : []));
    mark();
  };
  const forget = () => {
    places = [];
    tell();
  };
  const hover = (scene: ScanSceneView, at: [number, number] | null) => {
    const spot = at ? scene.spotAt(at) : { point: null, sample: null };
    const cloud = data.cloudOf(shared.now.frame);
    hovered = spot.point !== null && cloud ? pointAt(cloud, spot.point) : null;
    words.textContent = spotWords(report, data, shared.now, spot) || hint(shared.now);
    mark();
  };
  const click = (scene: ScanSceneView, at: [number, number]) => {
    const { mode, frame, view } = shared.now;
    if (mode === 'plan') {
      const found = scene.viewAt(at);
      shared.set({ view: found === view ? null : found });
      return;
    }
    const spot = scene.spotAt(at);
    if (mode === 'completeness') {
      shared.set({ hole: spot.sample === null ? null : holeOf(report, data, frame, spot.sample) });
      return;
    }
    const cloud = data.cloudOf(frame);
    if (spot.point === null || !cloud) return;
    places = places.length === 2 ? [pointAt(cloud, spot.point)] : [...places, pointAt(cloud, spot.point)];
    tell();
  };
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    if (places.length > 0) forget();
    else shared.set({ view: null, hole: null });
  });
  shared.watch((now, before) => {
    if (now.mode !== before.mode) forget();
    if (now.mode !== before.mode || now.frame !== before.frame || now.view !== before.view || now.hole !== before.hole) words.textContent = chosenWords(report, now) || hint(now);
  });
  words.textContent = hint(shared.now);
  return {
    element: h('div', { class: 'pointer-words' }, words, answer),
    attach: (scene) => {
      scenes = [...scenes, scene];
      let waiting = false;
      scene.onHover((at) => {
        // Looking up a point among a hundred thousand once a frame is enough.
        if (waiting && at) return;
        waiting = true;
        requestAnimationFrame(() => {
          waiting = false;
          hover(scene, at);
        });
      });
      scene.onClick((x, y) => click(scene, [x, y]));
    },
  };
}

function lengthOf([a, b]: Vec3[]): number {
  return Math.hypot(...a.map((value, k) => b[k] - value));
}

function holeOf(report: ScanReport, data: Unpacked, frame: number, sample: number): number | null {
  const found = report.rounds[frame]?.completeness?.holes.findIndex((hole) => data.samplesOfHole(hole).includes(sample)) ?? -1;
  return found < 0 ? null : found;
}

function hint({ mode }: ScanSelection): string {
  return {
    plan: 'Click a view to see what it measures; point at the surface to read which views see it.', cloud: 'Point at the cloud to read a point; click two points to measure between them.',
    completeness: 'Point at the surface to read whether it is measured; click a hole to choose it.',
  }[mode];
}

/// The chosen view or hole in words.
function chosenWords(report: ScanReport, { mode, frame, view, hole }: ScanSelection): string {
  const missing = mode === 'completeness' && hole !== null ? report.rounds[frame]?.completeness?.holes[hole] : undefined;
  if (missing) return `Hole ${hole! + 1}: ${areaText(missing.area_mm2)}, ${decimals(missing.across_mm, 0)} mm across, about x ${decimals(missing.centre?.[0], 0)}  y ${decimals(missing.centre?.[1], 0)}  z ${decimals(missing.centre?.[2], 0)} mm`;
  const one = mode === 'plan' && view !== null ? report.rounds[frame]?.plan?.views[view] : undefined;
  if (!one) return '';
  return `View ${view! + 1}: mean incidence ${decimals(one.mean_incidence_deg, 1)}°, ${one.worst_sigma_mm === null ? 'σ not determined' : `worst σ ${significant(one.worst_sigma_mm, 3)} mm`}, the tracker sees ${one.scanner_targets} targets of the scanner and ${one.platform_targets} of the platform, starts at ${decimals(one.starts_s, 1)} s`;
}

function spotWords(report: ScanReport, data: Unpacked, now: ScanSelection, { point, sample }: ScanSpot): string {
  const { plan, completeness } = report.rounds[now.frame] ?? {};
  const cloud = data.cloudOf(now.frame);
  if (point !== null && cloud) return pointWords(cloud, point);
  if (sample === null) return chosenWords(report, now);
  if (now.mode === 'plan' && plan) {
    const by = plan.views.flatMap((view, i) => (data.bits(view.measures)[sample] ? [i + 1] : []));
    const before = data.bits(plan.covered_before)[sample] ? 'measured before' : '';
    return [by.length === 0 ? (before ? '' : 'no view measures this place') : by.length === 1 ? `measured by view ${by[0]}` : `measured by ${by.length} views: ${by.join(', ')}`, before].filter(Boolean).join('; ');
  }
  if (now.mode !== 'completeness' || !completeness) return '';
  const hole = holeOf(report, data, now.frame, sample);
  return data.bits(completeness.measured)[sample] ? 'measured' : hole === null ? 'not measured' : `not measured: hole ${hole + 1}`;
}
