// SPDX-License-Identifier: Apache-2.0
// A report of plan, scans and cloud made up here: a conical casing, scanned from outside with the platform at rest and
// then from above with the platform turned. Nothing of it is measured; it has what the page must show.

/// Small enough and the same everywhere (Park and Miller's generator).
function randomStream(seed) {
  let state = seed;
  const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
  return { uniform: next, normal: () => Math.sqrt(-2 * Math.log(next() || 1e-9)) * Math.cos(2 * Math.PI * next()) };
}

const bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString('base64');

/// IEEE half floats; what is none is NaN.
function half(value) {
  if (!Number.isFinite(value)) return 0x7e00;
  const [bits] = new Uint32Array(new Float32Array([value]).buffer);
  const exponent = ((bits >> 23) & 0xff) - 112;
  if (exponent <= 0) return (bits >> 16) & 0x8000;
  return ((bits >> 16) & 0x8000) | (exponent << 10) | ((bits >> 13) & 0x3ff);
}

function bits(flags) {
  const packed = new Uint8Array(Math.ceil(flags.length / 8));
  flags.forEach((flag, i) => flag && (packed[i >> 3] |= 1 << (i & 7)));
  return bytes(packed);
}

const kSlope = 0.1208;
const kHeight = 600;
const kWall = 22;
const radius = (z) => 451 + kSlope * z;

/// Places of the casing's skin evenly by area, with normals: outer wall, inner wall, upper and lower rim.
function places(count, random) {
  const parts = [
    { area: 2 * Math.PI * 487 * kHeight, of: (a, t) => outward(a, t * kHeight, 0) },
    { area: 2 * Math.PI * 465 * kHeight, of: (a, t) => outward(a, t * kHeight, kWall) },
    { area: 2 * Math.PI * radius(kHeight) * kWall, of: (a, t) => rim(a, radius(kHeight) - t * kWall, kHeight, 1) },
    { area: 2 * Math.PI * radius(0) * kWall, of: (a, t) => rim(a, radius(0) - t * kWall, 0, -1) },
  ];
  const whole = parts.reduce((sum, part) => sum + part.area, 0);
  // Evenly by steps of the plastic number's powers (Roberts' R2 sequence), begun anywhere.
  return parts.flatMap((part, face) => {
    const [a0, t0] = [random.uniform(), random.uniform()];
    return Array.from({ length: Math.round((count * part.area) / whole) }, (_, i) => {
      const a = 2 * Math.PI * ((a0 + 0.7548776662466927 * i) % 1);
      return { ...part.of(a, (t0 + 0.5698402909980532 * i) % 1), a, face, area: whole / count };
    });
  });
}

function outward(a, z, inside) {
  const r = radius(z) - inside;
  const [c, s, n] = [Math.cos(a), Math.sin(a), Math.hypot(1, kSlope)];
  const sign = inside > 0 ? -1 : 1;
  return { at: [r * c, r * s, z], normal: [(sign * c) / n, (sign * s) / n, (-sign * kSlope) / n], z };
}

function rim(a, r, z, up) {
  return { at: [r * Math.cos(a), r * Math.sin(a), z], normal: [0, 0, up], z };
}

function mesh(sides) {
  const profile = [[radius(0) - kWall, 0], [radius(0), 0], [radius(kHeight), kHeight], [radius(kHeight) - kWall, kHeight]];
  const [vertices, triangles] = [[], []];
  for (let i = 0; i < sides; ++i) for (const [r, z] of profile) vertices.push(r * Math.cos((2 * Math.PI * i) / sides), r * Math.sin((2 * Math.PI * i) / sides), z);
  const at = (i, k) => 4 * (i % sides) + (k % 4);
  for (let i = 0; i < sides; ++i) for (let k = 0; k < 4; ++k) triangles.push(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1));
  return { name: 'casing', role: 'workpiece', carrier: -1, vertices: bytes(new Float32Array(vertices)), triangles: bytes(new Uint32Array(triangles)), error_mm: [] };
}

const minus = (a, b) => a.map((v, k) => v - b[k]);
const dot = (a, b) => a.reduce((sum, v, k) => sum + v * b[k], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((v) => v / Math.hypot(...a));

/// A scanner before a place of the skin: x along the wall, z towards it.
function viewAt(target, outward_, platform) {
  const z = outward_.map((v) => -v);
  const x = unit(cross([0, 0, 1], z));
  const y = cross(z, x);
  const m = [0, 1, 2].map((k) => [x[k], y[k], z[k]]);
  const w = Math.sqrt(Math.max(1e-9, 1 + m[0][0] + m[1][1] + m[2][2])) / 2;
  const q = [w, (m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w)];
  return { at: target.map((v, k) => v + 300 * outward_[k]), axes: [x, y, z], q, platform };
}

function measures(view, place) {
  const way = minus(place.at, view.at);
  const [x, y, z] = view.axes.map((axis) => dot(axis, way));
  return z > 200 && z < 400 && Math.abs(x) < (175 * z) / 300 && Math.abs(y) < (155 * z) / 300 && -dot(unit(way), place.normal) > 0.5;
}

function rounds(samples) {
  const outer = [0, 1].flatMap((ring) => Array.from({ length: 9 }, (_, i) => {
    const a = (2 * Math.PI * (ring === 0 ? i : 8.5 - i)) / 9;
    const wall = outward(a, ring === 0 ? 150 : 450, 0);
    return viewAt(wall.at, wall.normal, 0);
  })).filter((_, i) => i !== 4 && i !== 13);  // two are left out, so that there are holes
  const above = [...[4, 13].map((i) => {
    const a = (2 * Math.PI * (i === 4 ? 4 : 4.5)) / 9;
    const wall = outward(a, i === 4 ? 150 : 450, 0);
    return viewAt(wall.at, wall.normal, 0);
  }), ...Array.from({ length: 8 }, (_, i) => {
    const a = (2 * Math.PI * i) / 8;
    return viewAt([(radius(540) - kWall) * Math.cos(a), (radius(540) - kWall) * Math.sin(a), 520], unit([-0.62 * Math.cos(a), -0.62 * Math.sin(a), 0.78]), i < 4 ? 1 : 2);
  })];
  return [outer, above].map((views) => views.map((view) => ({ ...view, seen: samples.map((place) => measures(view, place)) })));
}

/// Lists of samples that hang together.
function components(samples, missing) {
  const near = 3.2 * Math.sqrt(samples[0].area / Math.PI);
  const left = new Set(samples.flatMap((_, i) => (missing[i] ? [i] : [])));
  const found = [];
  while (left.size > 0) {
    const [first] = left;
    left.delete(first);
    const own = [first];
    for (let k = 0; k < own.length; ++k) {
      for (const i of left) {
        if (Math.hypot(...minus(samples[i].at, samples[own[k]].at)) > near || dot(samples[i].normal, samples[own[k]].normal) < 0.3) continue;
        left.delete(i);
        own.push(i);
      }
    }
    found.push(own.sort((a, b) => a - b));
  }
  return found.sort((a, b) => b.length - a.length);
}

function hole(samples, own) {
  const mean = (of) => [0, 1, 2].map((k) => own.reduce((sum, i) => sum + of(samples[i])[k], 0) / own.length);
  const centre = mean((one) => one.at);
  return {
    area_mm2: own.reduce((sum, i) => sum + samples[i].area, 0), centre, normal: unit(mean((one) => one.normal).map((v) => v || 1e-3)),
    across_mm: 2 * Math.max(...own.map((i) => Math.hypot(...minus(samples[i].at, centre)))), samples: bytes(new Uint32Array(own)),
  };
}

function planOf(views, samples, before, optimal) {
  const covered = [...before];
  const area = (flags) => flags.reduce((sum, flag, i) => sum + (flag ? samples[i].area : 0), 0);
  const surface = area(samples.map(() => true));
  let time = 2.5;
  const told = views.map((view, i) => {
    const turns = i > 0 && views[i - 1].platform !== view.platform;
    time += i === 0 ? 0 : 5 + (turns ? 12.5 : 1.9);
    const added = view.seen.map((flag, k) => flag && !covered[k]);
    added.forEach((flag, k) => flag && (covered[k] = true));
    return {
      pose: [...view.at, ...view.q], platform: view.platform, measures: bits(view.seen), adds_mm2: area(added), mean_incidence_deg: 16.4 + (i % 5), beyond_good_incidence: 0.04 + 0.01 * (i % 4),
      worst_sigma_mm: i === 2 ? null : 0.072 + 0.004 * (i % 6), scanner_targets: 6 - (i % 3), platform_targets: 5 + (i % 2), starts_s: time,
    };
  });
  const poses = [...new Set(views.map((view) => view.platform))].sort().map((p) => ({ yaw_deg: 0, pitch_deg: [0, 12, -12][p], roll_deg: p === 0 ? 0 : 4.5 }));
  return {
    plan: {
      samples: 0, poses, views: told, bound: optimal ? views.length : views.length - 1, optimal, greedy_views: views.length + 4, candidates: 24000, in_words: optimal ? `${views.length} views, optimal` : `${views.length} views, bound ${views.length - 1}`,
      surface_mm2: surface, reachable_mm2: 0.981 * surface, coverable_mm2: 0.972 * surface, covered_before_mm2: area(before), covered_mm2: area(covered),
      limits: [['range', 0], ['field', 0], ['incidence', 21000], ['sight', 88000], ['clearance', 41000], ['floor', 5200], ['scanner targets', 132000], ['platform targets', 61000], ['uncertainty', 0]].map(([limit, area_mm2]) => ({ limit, area_mm2 })),
      covered_before: bits(before), tour_s: time + 5, nearest_neighbour_s: 1.17 * (time + 5), remarks: ['the underside is never covered: turn the part over'],
    },
    covered,
  };
}

/// Points on what the views see; on one side the wall is dented, and a few belong to nothing.
function cloudOf(views, count, total, random) {
  const all = places(4 * count, random).map((place) => ({ ...place, scan: views.findIndex((view) => measures(view, place)) })).filter((place) => place.scan >= 0).slice(-4 * count);
  const kept = all.filter((_, i) => i % Math.max(1, Math.ceil(all.length / count)) === 0);
  const field = { deviation_mm: [], sigma_mm: [], points: [], scans: [], scan: [], incidence_deg: [] };
  const at = kept.map((place, i) => {
    const cosine = -dot(unit(minus(place.at, views[place.scan].at)), place.normal);
    const sigma = 0.022 + 0.02 / cosine;
    const dent = place.face === 0 ? -0.34 * Math.exp(-((((place.a - 5.45) * 470) ** 2) + ((place.z - 330) ** 2)) / (2 * 85 ** 2)) + 0.22 * Math.exp(-((((place.a - 4.5) * 470) ** 2) + ((place.z - 180) ** 2)) / (2 * 60 ** 2)) : 0;
    const stray = i % 997 === 0;
    const off = dent + sigma * random.normal() + (stray ? 7 : 0);
    field.deviation_mm.push(stray ? NaN : off);
    field.sigma_mm.push(sigma);
    field.points.push(3 + Math.floor(9 * random.uniform()));
    field.scans.push(1 + (i % 3));
    field.scan.push(place.scan);
    field.incidence_deg.push((Math.acos(Math.min(1, cosine)) * 180) / Math.PI);
    return place.at.map((v, k) => v + off * place.normal[k]);
  });
  const low = [0, 1, 2].map((k) => at.reduce((least, p) => Math.min(least, p[k]), Infinity));
  const longest = Math.max(...[0, 1, 2].map((k) => at.reduce((most, p) => Math.max(most, p[k]), -Infinity) - low[k]));
  const whole = (name) => ['points', 'scans', 'scan'].includes(name);
  const voxel = Math.sqrt((3.6e6 * 0.6) / Math.max(1, kept.length));
  return {
    values: field.deviation_mm,
    cloud: {
      points: total, drawn: kept.length, voxel_mm: voxel, low_mm: low, step_mm: longest / 65535, places: bytes(new Uint16Array(at.flatMap((p) => p.map((v, k) => Math.round((65535 * (v - low[k])) / longest))))),
      normals: bytes(new Int8Array(kept.flatMap((place) => place.normal.map((v) => Math.round(127 * v))))),
      fields: Object.entries(field).map(([name, values]) => ({ name, whole: whole(name), values: bytes(new Uint16Array(values.map(whole(name) ? (v) => v : half))) })),
    },
  };
}

function summaryOf(region, values, tolerance) {
  const known = values.filter(Number.isFinite).sort((a, b) => a - b);
  const share = (of) => known.filter(of).length / Math.max(1, known.length);
  const mean = known.reduce((sum, v) => sum + v, 0) / Math.max(1, known.length);
  const rms = Math.sqrt(known.reduce((sum, v) => sum + v * v, 0) / Math.max(1, known.length));
  const at = (p) => known[Math.floor(p * (known.length - 1))] ?? null;
  return {
    region, points: known.length, beyond: values.length - known.length, mean_mm: mean, rms_mm: rms, sigma_mm: rms, p05_mm: at(0.05), median_mm: at(0.5), p95_mm: at(0.95), lowest_mm: at(0), highest_mm: at(1),
    in_tolerance: share((v) => Math.abs(v) <= tolerance), below: share((v) => v < -tolerance), above: share((v) => v > tolerance), predicted_rms_mm: 0.045,
  };
}

function deviationOf(values, tolerance) {
  const bin_mm = 1 / 61;
  const histogram = Array(61).fill(0);
  values.filter((v) => Math.abs(v) < 0.5).forEach((v) => ++histogram[Math.floor((v + 0.5) / bin_mm)]);
  const half_ = Math.floor(values.length / 2);
  return { whole: summaryOf('', values, tolerance), regions: [summaryOf('outer wall', values.slice(0, half_), tolerance), summaryOf('rims', values.slice(half_), tolerance)], bin_mm, histogram };
}

/// `points` are drawn a round, of `total`.
export function scans({ points, samples: sampleCount, sides, total }) {
  const random = randomStream(7);
  const samples = places(sampleCount, random);
  const [first, second] = rounds(samples);
  const one = planOf(first, samples, samples.map(() => false), true);
  const two = planOf(second, samples, one.covered, false);
  const tolerance_mm = 0.1;
  const roundOf = (name, { plan, covered }, views, of) => {
    const { cloud, values } = cloudOf(views, points, of, random);
    const measured = covered.map((flag, i) => flag && (i * 7919) % 97 > 0);
    const area = (flags) => flags.reduce((sum, flag, i) => sum + (flag ? samples[i].area : 0), 0);
    return {
      name, plan, cloud, deviation: deviationOf(values, tolerance_mm),
      completeness: { samples: 0, measured: bits(measured), surface_mm2: plan.surface_mm2, measured_mm2: area(measured), holes: components(samples, measured.map((flag) => !flag)).filter((own) => own.length > 1).map((own) => hole(samples, own)) },
    };
  };
  return {
    schema: 'asterism-scan-report/1', title: 'Conical casing: where to scan, and one true cloud', subtitle: 'made up to look at the page; turning platform, 18 + 10 views', links: [{ text: 'the cell in motion', href: 'verify/report.html' }], remarks: ['The clouds are made up.'],
    summary: [
      { label: 'Views', value: '26', unit: 'views', note: 'The paper takes 72; both see the outer wall.', verdict: 'good' },
      { label: 'Measured', value: '63.1', unit: '% of the surface', note: 'Area share with at least three points within 5 mm.', verdict: 'attention' },
      { label: 'Deviation', value: '0.061', unit: 'mm RMS', note: 'Signed distance to the nominal surface; predicted 0.045 mm.', verdict: 'plain' },
    ],
    scanner: { stand_off_mm: 300, near_mm: 200, far_mm: 400, field_width_mm: 350, field_height_mm: 310, baseline_mm: 160, max_incidence_deg: 60, good_incidence_deg: 45 },
    surface: mesh(sides),
    sample_lists: [{ places: bytes(new Float32Array(samples.flatMap((place) => place.at))), normals: bytes(new Int8Array(samples.flatMap((place) => place.normal.map((v) => Math.round(127 * v))))), areas_mm2: bytes(new Float32Array(samples.map((place) => place.area))) }],
    rounds: [roundOf('platform at rest', one, first, total), roundOf('</script><b>platform turned', two, [...first, ...second], 1.6 * total)],
    tolerance_mm, view_s: 5, turn_s: 10,
    tables: [{ id: 'paper', title: 'Against the paper', note: '', columns: ['Figure', 'Paper', 'Here'], rows: [['views', 72, 26], ['turns', null, 2]], verdicts: ['good', 'plain'] }],
    charts: [], options: { plan: { share: 0.99 } },
  };
}
