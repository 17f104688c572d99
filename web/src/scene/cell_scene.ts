// SPDX-License-Identifier: Apache-2.0
import * as THREE from 'three';
import type { CellReport } from '../data/cell_report';
import type { CellSelection } from '../data/cell_selection';
import { significant } from '../data/format';
import { mapRange, type Mesh } from '../data/mesh';
import type { Vec3 } from '../data/parts';
import { apply, type Covariance } from '../data/pose';
import { seenCode } from '../data/sight';
import { carrierMotion, distance, namedSpots, placeOf, spotAt, type Spot } from '../data/spots';
import { kSeenColours } from '../plots/sight_strip';
import { drawColourBar, drawMeasure } from './cell_overlay';
import { carried, type CellScales } from './cell_scales';
import { solidView, type SolidLook } from './cell_solids';
import { errorEllipsoid, placeEllipsoid } from './error_ellipsoid';
import { frameAxes } from './frame_axes';
import { segments } from './ink';
import type { Label } from './labels';
import { kSeen, placeAt, pointMark, seenBy, targetMarks } from './marks';
import { rigView } from './rig';
import { kDirections } from './scene';
import { sightRays } from './sight_rays';
import { stageOf, type Stage } from './stage';
import { volumeEdges } from './volume';

export type CellLayer = 'fixtures' | 'obstacles' | 'volume' | 'fields' | 'sight lines' | 'frames' | 'ellipsoids' | 'names';
export type CellViewPoint = 'cell' | 'part' | 'left camera' | 'right camera' | 'above' | 'side';

export interface CellSceneView extends Pick<Stage, 'element' | 'refresh' | 'still' | 'png' | 'onClick'> {
  show: (selection: CellSelection) => void;
  setLayer: (layer: CellLayer, visible: boolean) => void;
  setLook: (look: SolidLook) => void;         // of the part; of what stands about it too when see-through
  look: (from: CellViewPoint) => void;
  pick: (x: number, y: number) => Spot | null;  // a named place near by, else where the ray meets a surface
  measure: (spots: Spot[]) => void;
}

const kSnap = 11;  // px
const kFromAbove: Vec3 = [-0.42, -0.62, -0.5];  // so that tracker and part, side by side, fill the view

/// The cell in motion: what each camera sees of the targets, and what that is worth on the part.
export function cellScene(report: CellReport, meshes: Mesh[], scales: CellScales, first: CellSelection): CellSceneView {
  const layers: Record<CellLayer, boolean> = { fixtures: true, obstacles: true, volume: false, fields: false, 'sight lines': true, frames: true, ellipsoids: true, names: true };
  let [now, solidLook, measured] = [first, 'shaded' as SolidLook, [] as Spot[]];
  const range = mapRange(report.solids);
  const stage = stageOf('Three-dimensional view of the cell: cameras, targets, part and lines of sight', scales.radius, () => (layers.names ? [...rig.labels, ...labelsOf(report, now, layers)] : []), (context, _, height) => {
    if (solidLook === 'error map' && range) drawColourBar(context, height, range, 'worst predicted error (mm)', [{ label: 'tolerance', value: report.tolerance_mm }]);
    const text = measured.length === 2 ? `${significant(distance(report, measured[0], measured[1], now.frame).length, 5)} mm` : '';
    drawMeasure(context, measured.map((spot) => stage.project(placeOf(report, spot, now.frame))), text);
  });
  const { scene, inks } = stage;
  const rig = rigView(report.rig, scales, inks);
  const volume = report.volume ? segments(volumeEdges(report.volume), inks.line('--body-4', 1.4, 0.8)) : new THREE.Group();
  const carriers = [-1, ...report.bodies.map((_, i) => i)].map(() => new THREE.Group());
  const solids = report.solids.map((solid, i) => {
    const view = solidView(solid, meshes[i], range, inks);
    carriers[solid.carrier + 1].add(view.object);
    return view;
  });
  const marks = report.bodies.map((body, b) => body.targets.map((target) => targetMarks(target.normal, 0.5 * scales.discs * (target.diameter_mm ?? (0.02 * scales.span) / scales.discs), lifted(target.position_mm, target.normal, 0.004 * scales.span), kSeenColours, inks, carriers[b + 1])));
  const frames = new THREE.Group();
  const axes = report.axes.map((one) => {
    const view = frameAxes(one, 0.16 * scales.span, inks);
    carriers[one.carrier + 1].add(view);
    return view;
  });
  const ellipsoids = report.points.map(() => errorEllipsoid(inks.solid('--body-5', 0.6)));
  for (const point of report.points) carriers[report.body + 1].add(pointMark(point.position_mm, 0.018 * scales.span, inks));
  const [rayInk, brokenInk] = [inks.line('--sight', 1.3, 0.8), inks.line('--seen-none', 1.4, 0.9, 0.02 * scales.span)];
  let rays = [segments([], rayInk), segments([], brokenInk)];
  scene.add(rig.group, volume, frames, ...carriers, ...ellipsoids, ...rays);

  const meet = (solid: number, from: Vec3, to: Vec3): Vec3 | null => {
    const start = new THREE.Vector3(...from);
    const way = new THREE.Vector3(...to).sub(start);
    const hit = solids[solid] && new THREE.Raycaster(start, way.clone().normalize(), 0, way.length()).intersectObject(solids[solid].mesh, false)[0];
    return hit ? (hit.point.toArray() as Vec3) : null;
  };
  const showSolids = () => solids.forEach((view, i) => {
    const { role } = report.solids[i];
    const off = (role === 'fixture' && !layers.fixtures) || (role === 'obstacle' && !layers.obstacles);
    view.show(off ? 'hidden' : role === 'workpiece' || solidLook === 'see-through' ? solidLook : 'shaded');
  });
  const showRays = () => {
    for (const old of rays) {
      old.removeFromParent();
      old.geometry.dispose();
    }
    const eyes: [Vec3, Vec3] = [[0, 0, 0], scales.right];
    const pieces = layers['sight lines'] ? sightRays(report, now.body, now.frame, eyes, meet) : { seen: [], broken: [] };
    rays = [segments(pieces.seen, rayInk), segments(pieces.broken, brokenInk)];
    rays.forEach((lines, i) => (lines.visible = [pieces.seen, pieces.broken][i].length > 0));
    scene.add(...rays);
  };
  const redraw = () => {
    carriers.forEach((group, i) => placeAt(group, carrierMotion(report, i - 1, now.frame)));
    scene.updateMatrixWorld(true);
    marks.forEach((targets, b) => targets.forEach((mark, i) => {
      const seen = seenBy(seenCode(report.bodies[b].sight[i], now.frame));
      for (const kind of kSeen) mark[kind].visible = kind === seen;
    }));
    report.points.forEach((point, p) => {
      const covariance = point.covariance_mm2[now.frame];
      ellipsoids[p].visible = layers.ellipsoids && Boolean(covariance);
      if (covariance) placeEllipsoid(ellipsoids[p], covariance as Covariance, placeOf(report, { name: '', carrier: report.body, at: point.position_mm }, now.frame), scales.ellipsoids);
    });
    showSolids();
    showRays();
    axes.forEach((view) => (view.visible = layers.frames));
    volume.visible = layers.volume;
    rig.fields.visible = layers.fields;
    stage.request();
  };

  const look = (from: CellViewPoint) => {
    const part = carried(report, meshes, report.body).map((point) => apply(carrierMotion(report, report.body, now.frame), point));
    if (from === 'left camera' || from === 'right camera') stage.stand(middle(part), from === 'left camera' ? [0, 0, 0] : scales.right);
    else if (from === 'part') stage.see(part, [-0.35, -0.5, -0.8]);
    else stage.see([...scales.places, [0, 0, 0], scales.right], from === 'cell' ? kFromAbove : kDirections[from]);
  };
  const spots = namedSpots(report);
  const pick = (x: number, y: number): Spot | null => {
    const caster = stage.rayAt(x, y);
    const shown = solids.filter((view) => view.object.visible);
    const hit = caster.intersectObjects(shown.map((view) => view.mesh), false)[0];
    const reach = (hit?.distance ?? Infinity) + 0.05 * scales.span;
    const near = spots.map((spot) => ({ spot, at: placeOf(report, spot, now.frame) })).map(({ spot, at }) => {
      const pixel = stage.project(at);
      return { spot, off: pixel ? Math.hypot(pixel[0] - x, pixel[1] - y) : Infinity, far: caster.ray.origin.distanceTo(new THREE.Vector3(...at)) };
    }).filter(({ off, far }) => off < kSnap && far < reach).sort((a, b) => a.off - b.off)[0];
    if (near) return near.spot;
    if (!hit) return null;
    const solid = solids.findIndex((view) => view.mesh === hit.object);
    return spotAt(report, report.solids[solid].name, report.solids[solid].carrier, hit.point.toArray() as Vec3, now.frame);
  };
  const again = <T>(change: (value: T) => void) => (value: T) => {
    change(value);
    redraw();
  };
  return {
    ...stage, look, pick,
    show: again<CellSelection>((next) => (now = next)),
    setLayer: (layer, visible) => again<boolean>((value) => (layers[layer] = value))(visible),
    setLook: again<SolidLook>((next) => (solidLook = next)),
    measure: again<Spot[]>((next) => (measured = next)),
  };
}

function middle(points: Vec3[]): Vec3 {
  return [0, 1, 2].map((k) => points.reduce((sum, point) => sum + point[k], 0) / Math.max(1, points.length)) as Vec3;
}

/// A little off the skin that carries a target, so that its enlarged disc is not cut by it.
function lifted(at: Vec3, normal: Vec3 | undefined, by: number): Vec3 {
  return at.map((value, k) => value + by * (normal?.[k] ?? 0)) as Vec3;
}

function labelsOf(report: CellReport, { frame, body }: CellSelection, layers: Record<CellLayer, boolean>): Label[] {
  const at = (carrier: number, point: Vec3) => placeOf(report, { name: '', carrier, at: point }, frame);
  return [
    ...report.points.map((point): Label => ({ text: point.name, at: at(report.body, point.position_mm), colour: '--body-5', strong: true })),
    ...(layers.frames ? report.axes.map((axes): Label => ({ text: axes.name, at: at(axes.carrier, [axes.pose[0], axes.pose[1], axes.pose[2]]), colour: '--ink', below: true })) : []),
    ...report.bodies.flatMap((one, b) => (b === body ? one.targets.map((target): Label => ({ text: target.id, at: at(b, target.position_mm), colour: '--ink' })) : [])),
  ];
}
