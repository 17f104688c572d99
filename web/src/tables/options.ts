// SPDX-License-Identifier: Apache-2.0
import { significant } from '../data/format';
import { motionOf } from '../data/pose';
import { kDegPerRad, rotationVector } from '../data/quaternion';
import type { Lens, TrackingReport } from '../data/report';
import { h } from '../dom';
import { flattened } from './flatten';

/// The effective options, one a line, nested names joined by dots.
export function optionSection(report: TrackingReport): HTMLElement {
  const rows = flattened(report.options).map(([name, value]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', { class: 'number' }, value)));
  return h('section', { class: 'panel' },
    h('details', {}, h('summary', {}, h('h2', {}, 'Effective options')),
      rows.length > 0 ? h('table', { class: 'data narrow' }, h('tbody', {}, ...rows)) : h('p', {}, 'None were stored.')),
    h('details', {}, h('summary', {}, h('h2', {}, 'Rig')), rigTable(report)),
    h('details', {}, h('summary', {}, h('h2', {}, 'How to read this')), conventions()));
}

function rigTable({ rig }: TrackingReport): HTMLElement {
  const { translation, rotation } = motionOf(rig.right_from_left);
  const turn = rotationVector(rotation).map((value) => significant(value * kDegPerRad, 5)).join(', ');
  const row = (name: string, unit: string, ...values: string[]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', { class: 'unit' }, unit), ...values.map((value) => h('td', { class: 'number' }, value)));
  const both = (name: string, unit: string, value: (lens: Lens) => string) => row(name, unit, value(rig.left), value(rig.right));
  return h('div', { class: 'scroll' }, h('table', { class: 'data narrow' },
    h('thead', {}, h('tr', {}, ...['', 'Unit', 'Left', 'Right'].map((head, i) => h('th', { scope: 'col', class: i > 1 ? 'number' : '' }, head)))),
    h('tbody', {},
      both('Image', 'px', (lens) => `${lens.width_px} × ${lens.height_px}`),
      both('Focal length x, y', 'px', (lens) => `${significant(lens.fx, 7)}, ${significant(lens.fy, 7)}`),
      both('Principal point', 'px', (lens) => `${significant(lens.cx, 7)}, ${significant(lens.cy, 7)}`),
      both('Distortion (OpenCV)', '', (lens) => lens.distortion.map((c) => significant(c, 5)).join(', ') || 'none'),
      row('Baseline', 'mm', significant(Math.hypot(...translation), 7)),
      row('Right from left, T', 'mm', translation.map((value) => significant(value, 6)).join(', ')),
      row('Right from left, R', 'deg', turn))));
}

function conventions(): HTMLElement {
  const items = [
    'Frame "tracker": the left camera; x right, y down, z forward. Lengths in mm, angles in degrees, time in s, images in px.',
    'A pose is tracker_from_body. Accuracy is told at the named point of each body: at the end of a lever arm a small turn is a large shift.',
    'Error is measured less true, along the tracker\'s axes; rotations as a rotation vector.',
    'The 95 % band is what the tracker stated by itself, without knowing the truth: ±1.96 σ along an axis; for the size of an error the bound that its length stays below with probability 95 %.',
    'The ellipsoid holds the named point with probability 95 %; it is enlarged by the factor written under the view.',
    '"measured" uses one frame alone; "filtered" carries knowledge from earlier frames on. A predicted pose was not measured and is drawn dashed; an ambiguous or lost one is not drawn.',
  ];
  return h('ul', { class: 'reading' }, ...items.map((item) => h('li', {}, item)));
}
