// SPDX-License-Identifier: Apache-2.0
// A small report about a cell in motion: a conical casing on a tilting platform, a scanner that goes round it, a
// column that stands in the way. Lengths mm; the tracker looks along z, y is down.

const kDeg = Math.PI / 180;
const add = (a, b) => a.map((v, k) => v + b[k]);
const subtract = (a, b) => a.map((v, k) => v - b[k]);
const scale = (a, s) => a.map((v) => v * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => scale(a, 1 / Math.hypot(...a));

/// Turns about axes 0, 1, 2 one after the other, each about the axis as the earlier ones left it.
export function turned(...turns) {
  return turns.reduce(([aw, ax, ay, az], [axis, angle]) => {
    const q = [Math.cos(angle / 2), 0, 0, 0];
    q[1 + axis] = Math.sin(angle / 2);
    const [bw, bx, by, bz] = q;
    return [aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw];
  }, [1, 0, 0, 0]);
}
function rotate([w, ...v], p) {
  const t = scale(cross(v, p), 2);
  return add(add(p, scale(t, w)), cross(v, t));
}
export const moved = (pose, p) => add(rotate(pose.slice(3), p), pose.slice(0, 3));
const back = (pose, p) => rotate([pose[3], -pose[4], -pose[5], -pose[6]], subtract(p, pose.slice(0, 3)));

/// A closed profile (radius, height) turned about z, its long sides divided.
function lathe(profile, sides, longest) {
  const rings = profile.flatMap(([r, z], i) => {
    const [s, y] = profile[(i + 1) % profile.length];
    const steps = Math.max(1, Math.ceil(Math.hypot(s - r, y - z) / longest));
    return Array.from({ length: steps }, (_, k) => [r + ((s - r) * k) / steps, z + ((y - z) * k) / steps]);
  });
  const vertices = rings.flatMap(([r, z]) => Array.from({ length: sides }, (_, k) => [r * Math.cos((2 * Math.PI * k) / sides), r * Math.sin((2 * Math.PI * k) / sides), z]));
  const triangles = rings.flatMap((_, i) => Array.from({ length: sides }, (_u, k) => {
    const [a, b] = [i * sides, ((i + 1) % rings.length) * sides];
    const n = (k + 1) % sides;
    return [[a + k, a + n, b + n], [a + k, b + n, b + k]];
  }).flat());
  return { vertices, triangles };
}
function joined(...meshes) {
  const vertices = [];
  const triangles = [];
  for (const mesh of meshes) {
    triangles.push(...mesh.triangles.map((t) => t.map((i) => i + vertices.length)));
    vertices.push(...mesh.vertices);
  }
  return { vertices, triangles };
}
const placed = (mesh, pose) => ({ ...mesh, vertices: mesh.vertices.map((p) => moved(pose, p)) });
function box([x, y, z]) {
  const vertices = [0, 1, 2, 3, 4, 5, 6, 7].map((c) => [(c & 1 ? x : -x) / 2, (c & 2 ? y : -y) / 2, (c & 4 ? z : -z) / 2]);
  return { vertices, triangles: [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]] };
}

/// The paper's part: outer radius 453.2 + 0.1208 z, flanges of 40 mm, bosses half way up.
function casing(sides, longest) {
  const wall = lathe([[493.2, 0], [493.2, 20], [455.6, 20], [518.4, 540], [560.8, 540], [560.8, 560], [508.8, 560], [441.2, 0]], sides, longest);
  const bosses = Array.from({ length: 8 }, (_, k) => placed(lathe([[0.01, 0], [35, 0], [35, 34], [0.01, 34]], Math.max(12, sides / 6), 100), [...[Math.cos, Math.sin].map((f) => 484 * f((k * Math.PI) / 4)), 280, ...turned([2, (k * Math.PI) / 4], [1, Math.PI / 2])]));
  return joined(wall, ...bosses);
}

/// Whether a ray from `from` meets the mesh before it has come to `to`.
function blocked({ vertices, triangles }, from, to) {
  const along = subtract(to, from);
  return triangles.some(([a, b, c]) => {
    const [u, v] = [subtract(vertices[b], vertices[a]), subtract(vertices[c], vertices[a])];
    const p = cross(along, v);
    const d = dot(u, p);
    if (Math.abs(d) < 1e-9) return false;
    const t = subtract(from, vertices[a]);
    const x = dot(t, p) / d;
    const q = cross(t, u);
    const y = dot(along, q) / d;
    const z = dot(v, q) / d;
    return x >= 0 && y >= 0 && x + y <= 1 && z > 1e-3 && z < 1 - 1e-3;
  });
}

const lens = { fx: 1900, fy: 1900, skew: 0, cx: 1023.5, cy: 767.5, distortion: [], width_px: 2048, height_px: 1536 };
// Two cameras a metre apart, each turned in by kIn.
const kIn = 0.19;
const kEyes = [[0, 0, 0], [1000 * Math.cos(kIn), 0, 1000 * Math.sin(kIn)]];
const right_from_left = [...scale(rotate(turned([1, 2 * kIn]), kEyes[1]), -1), ...turned([1, 2 * kIn])];

/// Why camera `side` does not see a target at `place` with normal `facing` (tracker's frame); '.' when it does.
function sightOf(side, place, facing, solids, poses, own) {
  const p = side === 0 ? place : moved(right_from_left, place);
  const u = [lens.cx + (lens.fx * p[0]) / p[2], lens.cy + (lens.fy * p[1]) / p[2]];
  if (p[2] <= 0) return 'B';
  if (place[2] < 1500 || place[2] > 3400) return 'V';
  if (u[0] < 0 || u[1] < 0 || u[0] > 2048 || u[1] > 1536) return 'I';
  if (dot(unit(subtract(kEyes[side], place)), facing) < Math.cos(60 * kDeg)) return 'O';
  const hiding = solids.findIndex(({ mesh, carrier }) => {
    const pose = carrier < 0 ? [0, 0, 0, 1, 0, 0, 0] : poses[carrier];
    return blocked(mesh, back(pose, add(place, scale(facing, 2))), back(pose, kEyes[side]));
  });
  return hiding < 0 ? '.' : String.fromCharCode(97 + hiding);
}

/// The same numbers every time, evenly between 0 and 1.
function numbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function base64(array) {
  return Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString('base64');
}

const kPoints = [{ name: 'top flange', position_mm: [0, -560.8, 560] }, { name: 'boss', position_mm: [518, 0, 280] }, { name: 'O_p', position_mm: [0, 0, 0] }];

function charts(next) {
  const speeds = [1, 3, 10, 30, 60, 90, 120, 180];
  const curve = (name, per, dashed = false) => ({ name, x: speeds, y: speeds.map((v) => 0.031 + per * v), low: speeds.map((v) => 0.026 + 0.9 * per * v), high: speeds.map((v) => 0.036 + 1.1 * per * v), dashed });
  const runs = [5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
  return [
    { id: 'speed', title: 'Error at the top flange over angular speed', note: 'exposure 1 ms, 50 frames a second', x_label: 'angular speed (deg/s)', y_label: 'RMS error (mm)', log_x: true, log_y: true, curves: [curve('raw', 0.0021), curve('filtered', 0.0007, true)], limits: [{ name: 'tolerance', value: 0.25 }, { name: 'nominal', value: 0.025 }] },
    { id: 'runs', title: 'What a number of runs can tell apart', note: 'difference of two layouts that a paired test finds in 80 of 100 tries', x_label: 'runs', y_label: 'difference (mm)', log_x: true, log_y: true, curves: [{ name: 'S1 against S2', x: runs, y: runs.map((n) => 0.19 / Math.sqrt(n) * (1 + 0.02 * next())), low: [], high: [], dashed: false }], limits: [] },
    { id: 'budget', title: 'Error at the worst point over the motion', note: '', x_label: 'time (s)', y_label: 'error (mm)', log_x: false, log_y: false, curves: [{ name: 'detection', x: [0, 1, 2, 3], y: [0.03, 0.035, null, 0.03], low: [], high: [], dashed: false }, { name: 'calibration', x: [0, 1, 2, 3], y: [0.012, 0.014, 0.013, 0.012], low: [], high: [], dashed: false }], limits: [{ name: 'tolerance', value: 0.25 }] },
  ];
}

function tables() {
  return [
    { id: 'table-13', title: 'Fifty disturbances, as in Table 13', note: 'Rotation and translation error of three layouts; 95 % intervals by t.', columns: ['Layout', 'Rotation, mean (deg)', 'max (deg)', 'Translation, mean (mm)', 'max (mm)', '95 % interval (mm)'],
      rows: [['S1', 0.0366, 0.0902, 0.0972, 0.273, '0.089 – 0.105'], ['S2', 0.0351, 0.0843, 0.0991, 0.262, '0.091 – 0.107'], ['S3', 0.0349, 0.0847, 0.0987, 0.259, '0.091 – 0.107']], verdicts: [] },
    { id: 'robustness', title: 'Faults and what becomes of the pose', note: 'Share of frames.', columns: ['Fault', 'Kept (%)', 'Flagged (%)', 'Lost (%)', 'Silently wrong (%)', 'Worst error (mm)'],
      rows: [['none', 100, 0, 0, 0, 0.061], ['any one target lost', 98.4, 1.6, 0, 0, 0.082], ['any two targets lost', 91.7, 7.1, 1.2, 0, 0.124], ['5 % random loss', 99.2, 0.8, 0, 0, 0.071], ['target knocked 1 mm aside (P3 named)', 100, 0, 0, 0, 0.066], ['ghosts, 20 an image', 97.5, 2.5, 0, 0, 0.063], ['</script><b>backlight</b>', 62, 21, 17, 0, null]],
      verdicts: ['good', 'good', 'attention', 'good', 'good', 'good', 'bad'] },
  ];
}

/// `sides` of the casing's polygon and the longest edge along its wall set how fine it is.
export function cell({ frames = 60, sides = 36, longest = 150, tilts = 13 } = {}) {
  const next = numbers(7);
  const time_s = Array.from({ length: frames }, (_, i) => (i * 6) / frames);
  const platformAt = (t) => [0, 190, 2780, ...turned([0, 138 * kDeg], [0, 15 * kDeg * Math.sin(1.05 * t)], [1, 15 * kDeg * Math.sin(2.1 * t)], [2, 4 * kDeg * Math.sin(1.57 * t)])];
  const scannerAt = (t) => moved(platformAt(0), [860 * Math.cos(0.7 * t - 0.4), 860 * Math.sin(0.7 * t - 0.4), 400]).concat(turned([0, 138 * kDeg], [2, 0.7 * t - 0.4 + Math.PI / 2], [0, -0.5]));
  const poses = [time_s.map(platformAt), time_s.map(scannerAt)];

  const target = (id, position_mm, normal) => ({ id, position_mm, normal: unit(normal), diameter_mm: 12 });
  const ring = (count, from, radius, z, lean) => Array.from({ length: count }, (_, k) => {
    const a = from + (2 * Math.PI * k) / count;
    return [[radius * Math.cos(a), radius * Math.sin(a), z], [lean * Math.cos(a), lean * Math.sin(a), 1]];
  });
  const platformTargets = [...ring(6, 0.35, 700, 46, 0.36), ...ring(4, 0.9, 535, 562, 0.1)].map(([p, n], i) => target(`P${i + 1}`, p, n));
  const scannerTargets = [[-60, 0, 78], [60, 10, 78], [0, -70, 78], [0, 60, 90], [50, -60, 78]].map((p, i) => target(`S${i + 1}`, p, [0.1 * (i - 2), -0.5, 1]));

  const solids = [
    { name: 'casing', role: 'workpiece', carrier: 0, mesh: casing(sides, longest) },
    { name: 'platform', role: 'fixture', carrier: 0, mesh: joined(lathe([[0.01, -70], [780, -70], [780, -10], [0.01, -10]], sides, 500), ...ring(6, 0.35, 700, 10, 0).map(([p]) => placed(box([70, 70, 60]), [...p, 1, 0, 0, 0]))) },
    { name: 'scanner', role: 'obstacle', carrier: 1, mesh: box([160, 220, 130]) },
    { name: 'column', role: 'obstacle', carrier: -1, mesh: placed(box([110, 900, 110]), [560, 620, 1950, 1, 0, 0, 0]) },
  ];
  const seenBy = (targets, body) => targets.map((one) => [0, 1].map((side) => time_s.map((_, i) =>
    sightOf(side, moved(poses[body][i], one.position_mm), rotate(poses[body][i].slice(3), one.normal), solids, poses.map((p) => p[i]), body)).join('')));
  const bodies = [
    { name: 'platform', targets: platformTargets, pose: poses[0], sight: seenBy(platformTargets, 0) },
    { name: 'scanner', targets: scannerTargets, pose: poses[1], sight: seenBy(scannerTargets, 1) },
  ];
  const visible = time_s.map((_, i) => bodies[0].sight.filter(([l, r]) => l[i] === '.' && r[i] === '.').length);
  const coverage = time_s.map((_, i) => Math.max(0, dot(rotate(poses[0][i].slice(3), [0, 0, 1]), unit(scale(poses[0][i].slice(0, 3), -1)))));

  /// Along the line of sight a stereo pair is about three times as unsure; turns act at the end of the lever.
  const sigma = (p, count) => {
    const lever = Math.hypot(...subtract(p, [0, 0, 300])) / 600;
    const lateral = (0.011 + 0.019 * lever) * Math.sqrt(7 / Math.max(count, 1));
    return [lateral, lateral, 2.6 * lateral];
  };
  const points = kPoints.map(({ name, position_mm }) => {
    const sigmas = visible.map((count) => (count < 3 ? null : sigma(position_mm, count)));
    const normal = () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
    return {
      name, position_mm, predicted_mm: sigmas.map((s) => s && Math.hypot(...s)),
      covariance_mm2: sigmas.map((s) => s && [s[0] ** 2, 0, 0.3 * s[0] * s[2], s[1] ** 2, 0.2 * s[1] * s[2], s[2] ** 2]),
      measured_mm: sigmas.map((s) => s && Math.hypot(...s.map((v) => v * normal()))), without_mm: [],
    };
  });
  const grid = Array.from({ length: tilts }, (_, i) => -15 + (30 * i) / (tilts - 1));
  const heat = (title, value_label, value) => ({ title, x_label: 'roll (deg)', y_label: 'pitch (deg)', value_label, x: grid, y: grid, value: grid.map((pitch) => grid.map((roll) => value(roll, pitch))) });
  const count = (roll, pitch) => Math.round(6.4 + 2.2 * Math.cos((roll - 6) / 9) - 2.4 * Math.abs(Math.sin((pitch + 3) / 14)) + Math.sin(roll / 3) * 0.6);
  return {
    schema: 'asterism-cell-report/1', title: 'Engine casing on the tilting platform', subtitle: 'examples/cells/engine_casing.toml · 120 frames, 20 Hz · seed 1',
    summary: [
      { label: 'Verdict', value: 'holds', unit: '', note: 'largest predicted error 0.139 mm at the top flange; 0.25 mm allowed', verdict: 'good' },
      { label: 'Targets seen by both cameras', value: `${Math.min(...visible)} – ${Math.max(...visible)}`, unit: '', note: 'at least four are needed to be sure of a pose', verdict: Math.min(...visible) < 4 ? 'attention' : 'good' },
      { label: 'Honest doubt', value: '0.97', unit: 'NEES / 6', note: 'band 0.94 – 1.06: the model holds', verdict: 'good' },
      { label: 'With the platform\'s read-out alone', value: '0.309', unit: 'mm mean', note: 'a stated error model, an assumption', verdict: 'plain' },
    ],
    remarks: ['"Without targets" is the platform\'s own read-out with a stated error model: rotation 3 × 0.0345 deg, translation 3 × 0.185 mm. It is an assumption, not a measurement.'],
    rig: { left: lens, right: lens, right_from_left }, volume: { pose: [...scale(kEyes[1], 0.5), ...turned([1, -kIn])], near_mm: 1500, far_mm: 3400, near_size_mm: [1200, 950], far_size_mm: [2900, 2200], m3: 6.6 },
    time_s, bodies,
    solids: solids.map(({ mesh, ...rest }) => ({
      ...rest, vertices: base64(new Float32Array(mesh.vertices.flat())), triangles: base64(new Uint32Array(mesh.triangles.flat())),
      error_mm: rest.role === 'workpiece' ? mesh.vertices.map((p) => (Math.hypot(...p) < 100 ? null : Math.hypot(...sigma(p, Math.max(3, Math.min(...visible)))) * (1 + 0.1 * Math.sin(p[0] / 150)))) : [],
    })),
    axes: [
      { name: 'O_c tracker', carrier: -1, pose: [0, 0, 0, 1, 0, 0, 0] }, { name: 'O_p platform', carrier: 0, pose: [0, 0, 0, 1, 0, 0, 0] },
      { name: 'O_g workpiece', carrier: 0, pose: [0, 0, 280, ...turned([2, 0.4])] }, { name: 'O_s scanner', carrier: 1, pose: [0, 0, 0, 1, 0, 0, 0] },
      { name: 'O_1 targets', carrier: 0, pose: [0, 0, 253, 1, 0, 0, 0] },
    ],
    body: 0, visible, coverage, points,
    predicted_rotation_deg: visible.map((n) => (n < 3 ? null : 0.0045 * Math.sqrt(8 / n))), measured_rotation_deg: visible.map((n) => (n < 3 ? null : 0.0045 * Math.sqrt(8 / n) * (0.4 + 0.9 * next()))),
    status: visible.map((n) => (n >= 4 ? 'O' : n === 3 ? 'P' : 'L')).join(''),
    without_mm: time_s.map(() => 0.2 + 0.2 * next() + (next() > 0.95 ? 0.3 : 0)), without_deg: time_s.map(() => 0.03 + 0.05 * next()),
    tolerance_mm: 0.25, nominal_mm: 0.025,
    heats: [heat('Targets seen by both cameras', 'targets', count), heat('Predicted error at the top flange', 'error (mm)', (roll, pitch) => (count(roll, pitch) < 4 ? null : 0.061 * Math.sqrt(8 / count(roll, pitch)) * (1 + 0.004 * Math.abs(roll))))],
    tables: tables(), charts: charts(next), options: { verification: { tolerance_mm: 0.25 }, tracking: { filter: { coast_s: 0.2 } } },
  };
}
