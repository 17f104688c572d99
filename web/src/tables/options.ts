// SPDX-License-Identifier: Apache-2.0
import { significant } from '../data/format';
import { motionOf } from '../data/pose';
import { kDegPerRad, rotationVector } from '../data/quaternion';
import type { Lens, Rig } from '../data/parts';
import { h } from '../dom';
import { flattened } from './flatten';

/// The effective options, one a line, nested names joined by dots; the rig and the scanner where the page is about them;
/// how to read the page.
export function optionSection(options: unknown, rig: Rig | null, reading: string[], scanner: unknown = null): HTMLElement {
  const lines = (value: unknown) => flattened(value).map(([name, text]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', { class: 'number' }, text)));
  const rows = lines(options);
  return h('section', { class: 'panel' },
    h('details', {}, h('summary', {}, h('h2', {}, 'Effective options')),
      rows.length > 0 ? h('table', { class: 'data narrow' }, h('tbody', {}, ...rows)) : h('p', {}, 'None were stored.')),
    rig && h('details', {}, h('summary', {}, h('h2', {}, 'Rig')), rigTable(rig)),
    scanner !== null && h('details', {}, h('summary', {}, h('h2', {}, 'Scanner')), h('table', { class: 'data narrow' }, h('tbody', {}, ...lines(scanner)))),
    h('details', {}, h('summary', {}, h('h2', {}, 'How to read this')), h('ul', { class: 'reading' }, ...reading.map((item) => h('li', {}, item)))));
}

function rigTable(rig: Rig): HTMLElement {
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
