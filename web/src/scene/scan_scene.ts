// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import { percent } from '../data/format';
import type { Mesh } from '../data/mesh';
import type { Vec3 } from '../data/parts';
import { apply, motionOf } from '../data/pose';
import { areaText, completeShare, coveredBy, type Samples, type Unpacked } from '../data/scan';
import type { ScanReport } from '../data/scan_report';
import type { CloudShade, ScanSelection } from '../data/scan_selection';
import { colour } from '../dom';
import { bodyColour } from '../plots/figures';
import { tintsOf, type Shade } from '../plots/shades';
import { drawColourBar, drawMeasure, ground, written } from './cell_overlay';
import { solidView, type SolidLook } from './cell_solids';
import { cloudPoints, type CloudPoints } from './cloud_points';
import type { Label } from './labels';
import type { SamplePaint } from './sample_discs';
import { samplePaint } from './sample_paint';
import type { ScanScales } from './scan_scales';
import { stageOf, type Stage, type Vec2 } from './stage';
import { planView, type PlanView } from './view_frustums';

export type ScanLayer = 'views' | 'tour' | 'samples' | 'numbers';
export type ScanViewPoint = 'part' | 'front' | 'side' | 'above' | 'below';

/// What is under the cursor: a point of the cloud, or a sample of the surface.
export interface ScanSpot { point: number | null; sample: number | null }

export interface ScanSceneView extends Pick<Stage, 'element' | 'refresh' | 'still' | 'png' | 'onClick' | 'onHover' | 'onTurn' | 'standing' | 'stand'> {
  show: (selection: ScanSelection) => void;
  setLayer: (layer: ScanLayer, visible: boolean) => void;
  setLook: (look: SolidLook) => void;
  look: (from: ScanViewPoint) => void;
  lookAt: (places: Vec3[], normal: Vec3) => void;
  spotAt: (cursor: Vec2) => ScanSpot;
  viewAt: (cursor: Vec2) => number | null;
  mark: (hovered: Vec3 | null, measured: Vec3[], text: string) => void;
}

const kDirections: Record<ScanViewPoint, Vec3> = { part: [0.62, -0.66, 0.42], front: [0, -1, 0], side: [1, 0, 0], above: [0, -1e-3, 1], below: [0, -1e-3, -1] };
const kGrasp = 13;       // px from a frustum's axis that still means it
const kNamedHoles = 12;  // the largest have a number in the view

/// Plan, cloud or completeness of one round on the part; z is up.
export function scanScene(report: ScanReport, data: Unpacked, mesh: Mesh | null, scales: ScanScales, shadeOf: (shade: CloudShade) => Shade | null, first: ScanSelection): ScanSceneView {
  const layers: Record<ScanLayer, boolean> = { views: true, tour: true, samples: true, numbers: true };
  let now = first;
  let marked: { hovered: Vec3 | null; measured: Vec3[]; text: string } = { hovered: null, measured: [], text: '' };
  const round = () => report.rounds[now.frame];
  const stage = stageOf('Three-dimensional view of the part with the planned views, the cloud or what is measured', scales.radius,
    () => (layers.numbers ? labelsOf(report, data, now, stage.standing().position) : []), (context, width, height) => overlay(context, width, height), [0, 0, 1]);
  const { scene, inks } = stage;
  const surface = report.surface && mesh ? solidView(report.surface, mesh, null, inks) : null;
  if (surface) scene.add(surface.object);
  const plans = new Map<number, PlanView | null>();
  const clouds = new Map<number, { view: CloudPoints; painted: string } | null>();
  const paints = new Map<number, SamplePaint | null>();

  const once = <T>(made: Map<number, T>, key: number, make: () => T): T => {
    if (!made.has(key)) made.set(key, make());
    return made.get(key)!;
  };
  const planOf = (i: number) => once(plans, i, () => {
    const { plan } = report.rounds[i];
    const view = plan && planView(plan, report.scanner, inks);
    if (view) scene.add(view.views, view.tour);
    return view;
  });
  const cloudOf = (i: number) => once(clouds, i, () => {
    const cloud = data.cloudOf(i);
    if (!cloud) return null;
    const view = cloudPoints(cloud);
    scene.add(view.object);
    return { view, painted: '' };
  });
  const paintOf = (list: number) => once(paints, list, () => {
    const samples = data.samplesAt(list);
    const made = samples && samplePaint(samples, mesh, 0.0015 * scales.span);
    if (made) scene.add(made.object);
    return made;
  });

  const overlay = (context: CanvasRenderingContext2D, _: number, height: number) => {
    const scale = now.mode === 'cloud' && round()?.cloud ? shadeOf(now.shade) : null;
    if (scale) drawColourBar(context, height, [scale.low, scale.high], scale.title, scale.marks, (part) => scale.colour(scale.low + part * (scale.high - scale.low)));
    caption(context, report.rounds.length > 0 ? `${now.frame + 1}  ${round().name}` : '', factsOf(report, now));
    const places = marked.measured.map((place) => stage.project(place));
    drawMeasure(context, places, marked.text);
    const at = marked.hovered && stage.project(marked.hovered);
    if (!at) return;
    context.lineWidth = 2;
    context.strokeStyle = colour('--ink');
    context.beginPath();
    context.arc(at[0], at[1], 7, 0, 2 * Math.PI);
    context.stroke();
  };
  const showSamples = () => {
    const told = now.mode === 'plan' ? round().plan : now.mode === 'completeness' ? round().completeness : null;
    const own = layers.samples && told ? paintOf(told.samples) : null;
    paints.forEach((one) => one && (one.object.visible = one === own));
    own?.paint(sampleColours(report, now, data));
  };
  const showCloud = () => {
    const own = now.mode === 'cloud' ? cloudOf(now.frame) : null;
    clouds.forEach((one) => one && (one.view.object.visible = one === own));
    if (!own) return;
    const how = `${now.shade} ${colour('--cloud')}`;
    if (own.painted !== how) own.view.paint(tintsOf(data.cloudOf(now.frame)!, now.shade, shadeOf(now.shade), colour('--cloud')), now.shade === 'plain' || now.shade === 'scan');
    own.painted = how;
    own.view.resize(stage);
  };
  const showPlan = () => {
    const own = now.mode === 'plan' ? planOf(now.frame) : null;
    plans.forEach((one) => {
      if (!one) return;
      one.views.visible = one === own && layers.views;
      one.tour.visible = one === own && layers.tour;
    });
    own?.choose(now.view);
  };
  const redraw = () => {
    if (!round()) return;
    showPlan();
    showSamples();
    showCloud();
    inks.refresh(stage.element.clientWidth, stage.element.clientHeight);
    stage.request();
  };

  let from: ScanViewPoint = 'part';
  const look = (next: ScanViewPoint) => {
    from = next;
    stage.see(from === 'part' && now.mode === 'plan' ? [...scales.part, ...scales.views] : scales.part, kDirections[from]);
  };
  const surfaceHit = ([x, y]: Vec2) => (surface && surface.object.visible ? stage.rayAt(x, y).intersectObject(surface.mesh, false)[0] : undefined);
  const spotAt = (cursor: Vec2): ScanSpot => {
    const hit = surfaceHit(cursor);
    if (now.mode === 'cloud') return { point: cloudOf(now.frame)?.view.pick(stage, cursor, hit ? hit.distance + 0.01 * scales.span : Infinity) ?? null, sample: null };
    const told = now.mode === 'plan' ? round()?.plan : round()?.completeness;
    const samples = told && data.samplesAt(told.samples);
    return { point: null, sample: samples && hit ? nearestSample(samples.places, samples.areas, hit.point) : null };
  };
  const viewAt = ([x, y]: Vec2): number | null => {
    const eye = new THREE.Vector3(...stage.standing().position);
    const near = (round()?.plan?.views ?? []).map((view, i) => {
      const motion = motionOf(view.pose);
      const [a, b] = [stage.project(motion.translation), stage.project(apply(motion, [0, 0, 0.3 * report.scanner.stand_off_mm]))];
      return { i, off: a && b ? toSegment([x, y], a, b) : Infinity, far: eye.distanceTo(new THREE.Vector3(...motion.translation)) };
    }).filter(({ off }) => off < kGrasp).sort((a, b) => a.far - b.far)[0];
    return layers.views && near ? near.i : null;
  };
  const again = <T>(change: (value: T) => void) => (value: T) => {
    change(value);
    redraw();
  };
  return {
    ...stage, look, spotAt, viewAt,
    refresh: () => {
      stage.refresh();
      redraw();
    },
    lookAt: (places, normal) => stage.see(places, Math.abs(normal[2]) > 0.98 ? [normal[0], normal[1] - 0.2, normal[2]] : normal),
    show: again<ScanSelection>((next) => {
      const other = next.mode !== now.mode;
      now = next;
      if (other && stage.isFitted()) look(from);
    }),
    setLayer: (layer, visible) => again<boolean>((value) => (layers[layer] = value))(visible),
    setLook: again<SolidLook>((next) => surface?.show(next)),
    mark: (hovered, measured, text) => {
      marked = { hovered, measured, text };
      stage.request();
    },
  };
}

/// Which round it is and what it is worth, at the left top.
function caption(context: CanvasRenderingContext2D, title: string, facts: string): void {
  const lines = [{ text: title, font: '600 13px system-ui, sans-serif', y: 22, ink: '--ink' }, { text: facts, font: '12px system-ui, sans-serif', y: 40, ink: '--muted' }];
  const wide = Math.max(...lines.map(({ text, font }) => {
    context.font = font;
    return context.measureText(text).width;
  }));
  ground(context, 6, 6, wide + 16, facts ? 42 : 24);
  context.textAlign = 'left';
  for (const { text, font, y, ink } of lines) {
    context.font = font;
    written(context, text, 14, y, colour(ink));
  }
}

function factsOf(report: ScanReport, now: ScanSelection): string {
  const round = report.rounds[now.frame];
  if (!round) return 'There are no rounds.';
  if (now.mode === 'plan') return round.plan ? round.plan.in_words : 'nothing was planned';
  const share = completeShare(round);
  const holes = round.completeness?.holes.length ?? 0;
  return share === null ? (round.cloud ? '' : 'there is no cloud yet') : `${percent(share)} % measured, ${holes === 0 ? 'no holes' : holes === 1 ? 'one hole' : `${holes} holes`}`;
}

/// What the samples' colours tell: planned or not, seen by the chosen view; measured or not, of the chosen hole.
function sampleColours(report: ScanReport, now: ScanSelection, data: Unpacked): (sample: number) => string | null {
  const { plan, completeness } = report.rounds[now.frame];
  const [measured, missing, lit] = [colour('--measured'), colour('--missing'), colour('--lit')];
  if (now.mode === 'plan' && plan) {
    const covered = coveredBy(plan, data);
    const view = now.view === null ? undefined : plan.views[now.view];
    const own = view && data.bits(view.measures);
    return (i) => (own?.[i] ? lit : covered[i] ? (own ? null : measured) : missing);
  }
  if (!completeness) return () => null;
  const bits = data.bits(completeness.measured);
  const hole = now.hole === null ? undefined : completeness.holes[now.hole];
  const own = new Set(hole ? data.samplesOfHole(hole) : []);
  return (i) => (own.has(i) ? lit : bits[i] ? measured : missing);
}

function labelsOf(report: ScanReport, data: Unpacked, now: ScanSelection, eye: Vec3): Label[] {
  const round = report.rounds[now.frame];
  if (!round) return [];
  const towards = (at: Vec3, direction: Vec3) => direction.reduce((sum, value, k) => sum + value * (eye[k] - at[k]), 0) > 0;
  if (now.mode === 'plan') {
    return (round.plan?.views ?? []).map((view, i): Label => {
      const motion = motionOf(view.pose);
      const at = motion.translation;
      const ahead = apply(motion, [0, 0, 1]).map((value, k) => value - at[k]) as Vec3;
      const before = !towards(at, ahead);  // it looks away from the eye: the part does not hide it
      return { text: String(i + 1), at, colour: i === now.view ? '--ink' : before ? bodyColour(view.platform) : '--muted', strong: before || i === now.view };
    });
  }
  const told = now.mode === 'completeness' ? round.completeness : null;
  const samples = told && data.samplesAt(told.samples);
  return (samples ? told.holes.slice(0, kNamedHoles) : []).flatMap((hole, i): Label[] => {
    const at = namedAt(samples!, data.samplesOfHole(hole), eye);
    return at ? [{ text: i === now.hole ? `${i + 1}: ${areaText(hole.area_mm2)}` : String(i + 1), at, colour: '--ink', strong: true }] : [];
  });
}

/// Where a hole is named: in the middle of what of it faces the eye, upon it even when it goes round the part.
function namedAt({ places, normals }: Samples, own: Uint32Array, eye: Vec3): Vec3 | null {
  const facing = own.filter((i) => [0, 1, 2].reduce((sum, k) => sum + normals[3 * i + k] * (eye[k] - places[3 * i + k]), 0) > 0);
  if (facing.length === 0) return null;
  const middle = [0, 1, 2].map((k) => facing.reduce((sum, i) => sum + places[3 * i + k], 0) / facing.length);
  let [best, least] = [facing[0], Infinity];
  for (const i of facing) {
    const off = (places[3 * i] - middle[0]) ** 2 + (places[3 * i + 1] - middle[1]) ** 2 + (places[3 * i + 2] - middle[2]) ** 2;
    if (off < least) [best, least] = [i, off];
  }
  return [places[3 * best], places[3 * best + 1], places[3 * best + 2]];
}

/// The sample about whose area a place lies.
function nearestSample(places: Float32Array, areas: Float32Array, at: THREE.Vector3): number | null {
  let [best, least] = [-1, Infinity];
  for (let i = 0; i < areas.length; ++i) {
    const off = (places[3 * i] - at.x) ** 2 + (places[3 * i + 1] - at.y) ** 2 + (places[3 * i + 2] - at.z) ** 2;
    if (off < least) [best, least] = [i, off];
  }
  return best >= 0 && least < 4 * areas[best] ? best : null;
}

function toSegment([x, y]: Vec2, a: Vec2, b: Vec2): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const part = Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - a[0] - part * dx, y - a[1] - part * dy);
}
