// SPDX-License-Identifier: Apache-2.0
// A small report about layouts: eight on the front, the present one, and one that breaks a constraint.
const kPoses = 60;

function turned(rotations) {
  return rotations.reduce(([aw, ax, ay, az], [axis, angle]) => {
    const q = [Math.cos(angle / 2), 0, 0, 0];
    q[1 + axis] = Math.sin(angle / 2);
    const [bw, bx, by, bz] = q;
    return [aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw];
  }, [1, 0, 0, 0]);
}

function motion() {
  const time_s = Array.from({ length: kPoses }, (_, i) => i / 10);
  // x right, y down, z forward; the platform's z looks up and back to the cameras.
  const pose = time_s.map((t) => [0, 150, 2150, ...turned([[0, (150 * Math.PI) / 180], [2, 0.26 * Math.sin(1.1 * t)], [1, 0.26 * Math.sin(1.7 * t + 0.7)], [0, 0.2 * Math.sin(2.3 * t + 2)]])]);
  return { time_s, pose };
}

function layout(count, i, extra = {}) {
  const targets = Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * (k + 0.21 * Math.sin(3 * k + i))) / count;
    const radius = 520 + 70 * Math.sin(5 * k + 2 * i);
    return { id: `P${k + 1}`, position_mm: [radius * Math.cos(angle), radius * Math.sin(angle), k % 3 === 0 ? 120 : 40], normal: [0.34 * Math.cos(angle), 0.34 * Math.sin(angle), 0.94], diameter_mm: 12 };
  });
  const seen = targets.map((_, k) => Array.from({ length: kPoses }, (_u, p) => (Math.sin(p / 9 + 2 * k) > 0.93 ? '1' : Math.sin(p / 9 + 2 * k) < -0.985 ? '0' : '3')).join(''));
  const worst = 0.11 / Math.sqrt(count) + 0.002 * Math.sin(7 * i);
  const error_mm = Array.from({ length: kPoses }, (_, p) => worst * (0.8 + 0.2 * Math.sin(p / 6 + i)));
  const lost = worst * (1 + 3 / count);
  return {
    name: `${count} targets`, origin: 'found', reference: false, targets, seen, error_mm, error_lost_mm: error_mm.map((v) => v * (1 + 3 / count)), fails: [],
    values: [count, lost, 0.9 + 0.55 * ((i * 3) % 5) + 0.05 * count, Math.min(count, 3 + Math.floor(count * 0.75)), worst, 262 + 11 * i, 34 + i],
    notes: ['Worst after a loss at pose 41 (4.1 s) at the work point flange when P2 is lost.'], ...extra,
  };
}

export function layouts() {
  const found = [4, 5, 6, 7, 8, 9, 10, 12].map((count, i) => layout(count, i));
  const present = layout(6, 9, { name: 'present', origin: 'the cell', reference: true });
  present.values = [6, 0.094, 0.27, 4, 0.061, 204, 11];
  const broken = layout(4, 11, { name: '</script><b>Table 1 S1</b>', origin: 'the paper', reference: true, fails: ['visible: 3, at least 5 asked (2 missing)'] });
  broken.values = [4, null, 0.12, 3, 0.079, 231, 9];
  broken.error_lost_mm = broken.error_lost_mm.map(() => null);
  const lens = { fx: 3200, fy: 3200, skew: 0, cx: 1023.5, cy: 767.5, distortion: [], width_px: 2048, height_px: 1536 };
  const measure = (name, label, unit, better, objective = false) => ({ name, label, unit, better, objective });
  return {
    schema: 'asterism-layout-report/1', title: 'Layouts of the platform', subtitle: 'engine casing: 25 000 candidates in 250 generations, 9.1 s',
    summary: [
      { label: 'Front', value: '8', unit: 'layouts', note: 'of 112 found; each best in its own way', verdict: 'good' },
      { label: 'Knee', value: '7 targets', unit: '', note: 'two more targets would win 9 %', verdict: 'plain' },
      { label: 'Present layout', value: '0.094', unit: 'mm', note: 'worst error after any one loss; the knee has 0.055 mm', verdict: 'attention' },
    ],
    remarks: ['The present layout can be taken for itself turned by 180° within 0.27 mm.'],
    body: 'platform', rig: { left: lens, right: lens, right_from_left: [-1000, 0, 0, ...turned([[1, 0.43]])] },
    volume: { pose: [500, 0, 0, ...turned([[1, -0.21]])], near_mm: 1400, far_mm: 3000, near_size_mm: [1200, 900], far_size_mm: [2700, 2000], m3: 4.9 },
    patches: [
      { name: 'rim', kind: 'ring', centre_mm: [0, 0, 40], inner_radius_mm: 430, outer_radius_mm: 620, from_deg: 0, to_deg: 360 },
      { name: 'wall', kind: 'side', base_mm: [0, 0, -160], radius_mm: 620, height_mm: 200, from_deg: 20, to_deg: 160 },
      { name: 'tray', kind: 'plate', pose: [0, -720, 60, 1, 0, 0, 0], width_mm: 300, height_mm: 120 },
    ],
    keep_outs: [
      { name: 'lifting eye', shape: 'frustum', pose: [430, 300, 40, 1, 0, 0, 0], bottom_radius_mm: 60, top_radius_mm: 60, height_mm: 120 },
      { name: 'clamp', shape: 'box', pose: [-480, -260, 80, 1, 0, 0, 0], size_mm: [140, 90, 120] },
    ],
    obstacles: [
      { name: 'casing', shape: 'frustum', pose: [0, 0, 40, 1, 0, 0, 0], bottom_radius_mm: 400, top_radius_mm: 330, height_mm: 260 },
      { name: 'pipe', shape: 'capsule', pose: [0, 0, 0, 1, 0, 0, 0], from_mm: [-300, 100, 360], to_mm: [300, -100, 360], radius_mm: 15 },
    ],
    points: [{ name: 'flange', position_mm: [0, 0, 320] }, { name: 'foot', position_mm: [260, 120, 60] }],
    motion: motion(),
    measures: [
      measure('targets', 'targets', '', 'less', true), measure('worst-error-1-lost', 'worst error after any one loss', 'mm', 'less', true),
      measure('identifiability', 'identifiability margin', 'mm', 'more', true), measure('visible', 'fewest targets visible', '', 'more', true),
      measure('worst-error', 'worst error', 'mm', 'less'), measure('spacing', 'smallest spacing', 'mm', 'none'), measure('thickness', 'thickness', 'mm', 'none'),
    ],
    layouts: [...found, present, broken], knee: 3, why: 'Seven targets: an eighth wins 6 % in error, leaving one out costs 17 %.',
    history: Array.from({ length: 80 }, (_, i) => ({ generation: i, evaluations: 100 * (i + 1), hypervolume: 1 - Math.exp(-i / 14), feasible_share: Math.min(1, 0.2 + i / 30), seconds: i / 20 })),
    options: { population: 100, generations: 80 },
  };
}
